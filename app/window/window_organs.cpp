// What the window shows of a body, and of several organs: which is pressed, and how each is seen.

#include "app/import/organ_level.h"
#include "app/import/organ_look.h"
#include "app/import/organ_names.h"
#include "app/input/organ_plan.h"
#include "app/organs/organ_list.h"
#include "app/panels/tissue_panel.h"
#include "app/scene/scene_entries.h"
#include "app/shell/change.h"
#include "app/shell/dock.h"
#include "app/window/window.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/view/appearance.h"

#include <QDockWidget>

#include <algorithm>

namespace palp
{

void Window::showBody()
{
  session_.noteSeen(cameraPlace()); // which is of the body before
  endReview();
  setWindowTitle(tr("Palp — %1").arg(QString::fromStdString(session_.body().name)));
  orientation_.setPatient(isPatient(session_.body()));
  shown_ = {};
  marked_.clear();
  showInside();
  makeOrganList();
  showOrgans();
  realism_.isOn() ? setRealistic(true) : void(); // as large as this body
  panel_->setScene(tissueInUse());
  fittedTo_ = std::pair(0, 0);
  queued_.clear();
  dropMap();
  openSupports();
  closeCheck();
}

// what lies in the body, but what is hidden there: by the panel in words, and where one sees
// through
void Window::showInside()
{
  const SceneBody& body = session_.body();
  const std::span<const PlacedNodule> nodules = body.shownNodules();
  const bool hasMap = body.stiffness ||
    std::ranges::any_of(body.organs, [](const SceneBody& one) { return bool(one.stiffness); });
  QStringList inside;
  !nodules.empty() ? void(inside << QString::fromStdString(counted(nodules.size(), "nodule")))
                   : void();
  hasMap ? void(inside << tr("a map of stiffness")) : void();
  panel_->setInside(inside.join(", "));
  findChild<QAction*>("noNodulesAction")->setEnabled(!nodules.empty());
  std::vector<Balls::Ball> balls = marked_;
  if (marked_.empty() && view_.look().isTranslucent)
  {
    balls = ballsOf(nodules);
  }
  balls_.show(balls);
  isStale_ = true;
}

// anew for other organs; none is shown for one body
void Window::makeOrganList()
{
  const bool hasOrgans = !session_.organs().empty();
  if (organs_ == nullptr && hasOrgans)
  {
    organs_ = new OrganList;
    addDock(this, Qt::RightDockWidgetArea, tr("Organs"), organs_);
    connect(organs_, &OrganList::changed, this, &Window::changeOrgans);
    connect(organs_, &OrganList::chosenChanged, this,
      [this]
      {
        panel_->setScene(tissueInUse());
        showModel();
        openSupports();
      });
  }
  if (organs_ != nullptr)
  {
    organs_->show({});
    organs_->show(session_.organs());
    organs_->parentWidget()->setVisible(hasOrgans);
  }
}

// labels of an image, each an organ as palp import makes it, with the tool and the law in use
bool Window::openLabels(const MeshSource& image, std::vector<FileOrgan> labels)
{
  std::vector<std::string> files; // that are not made
  nameFiles(labels, files, {});
  std::vector<std::string> names(labels.size());
  std::ranges::transform(labels, names.begin(), &FileOrgan::name);
  const std::vector<OrganLook> looks = looksOf(names);
  const Scene& scene = session_.scene();
  PressOptions press;
  press.tissue = optionsOf(scene.law, session_.recording().rated);
  press.contact = scene.rule;
  press.damping = scene.damping;
  std::vector<MeshSource> meshes;
  std::vector<OrganPlan> organs;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    MeshSource& mesh = meshes.emplace_back(image);
    mesh.part.labels.assign(1, labels[i].label);
    OrganPlan& organ = organs.emplace_back(OrganPlan{ .name = names[i],
      .color = parseColor(labels[i].color.empty() ? looks[i].color : labels[i].color),
      .press = press });
    const auto role = std::ranges::find(kOrganRoles, looks[i].role);
    organ.role = static_cast<OrganRole>(role - kOrganRoles.begin());
    looks[i].tissue != nullptr ? organ.press.tissue.take(looks[i].tissue) : void();
  }
  return openBody({ .meshes = meshes, .organs = organs });
}

// as the session has them: in the list, below the pointer, in the picture
void Window::showOrgans()
{
  const Scene& scene = session_.scene();
  std::vector<std::shared_ptr<const Surface>> felt{ scene.surface };
  for (const Scene& organ : scene.others)
  {
    felt.push_back(organ.surface);
  }
  if (felt != felt_)
  {
    felt_ = felt;
    pointer_.setSurfaces(std::move(felt));
  }
  if (organs_)
  {
    organs_->show(session_.organs());
  }
  showPictured();
}

// a mouse that presses an organ chooses it, too
void Window::chooseTouched()
{
  if (organs_ && !review_ && session_.isLed() && shown_.contact.touching())
  {
    organs_->choose(session_.recording().organName(shown_.organ));
    panel_->setScene(tissueInUse());
  }
}

// false where they are refused
bool Window::useOrgans(const std::vector<OrganPlan>& organs)
{
  bool isUsed = false;
  attempt(
    [&]
    {
      if (!std::ranges::equal(organs, session_.organs(), {}, &OrganPlan::name, &OrganPlan::name))
      {
        throw Error(ErrorCode::BadValue, "those organs are no longer open");
      }
      endReview();
      const std::uint64_t before = session_.scene().version;
      isUsed = useFelt(session_.feltWith(organs));
      session_.scene().version != before ? clearCharts() : void();
      sayWhatIsKept();
    });
  showOrgans();
  panel_->setScene(tissueInUse());
  return isUsed;
}

void Window::changeOrgans(const std::vector<OrganPlan>& organs)
{
  const std::vector<OrganPlan> before = session_.organs();
  if (useOrgans(organs))
  {
    keepUndo(before);
  }
}

void Window::keepUndo(const std::vector<OrganPlan>& before)
{
  const auto use = [this](const std::vector<OrganPlan>& organs)
  { return [this, organs] { useOrgans(organs); }; };
  undo_.push(new Change(tr("change of organs"), use(before), use(session_.organs())));
}

// in the chart: of the organ in the panel
void Window::showModel()
{
  charts_ && !review_ ? charts_->setLaw(tissueInUse().law) : void();
}

// that of the organ that is chosen, with the tool
Scene Window::tissueInUse() const
{
  Scene scene = session_.scene();
  if (!session_.organs().empty())
  {
    const PressOptions& press = session_.organs()[organs_->chosen()].press;
    scene.law = press.tissue.law();
    scene.damping = press.damping;
  }
  return scene;
}

const Scene& Window::organShown() const
{
  return organOf(review_ ? pictured().recording.scene : session_.scene(), shown_.organ);
}

const Calibration& Window::calibrationShown() const
{
  return organOf(review_ ? pictured().calibration : session_.calibration(), shown_.organ);
}

} // namespace palp
