// What the window shows of a body, and of several organs: which is pressed, and how each is seen.

#include "app/organs/organ_list.h"
#include "app/panels/tissue_panel.h"
#include "app/shell/change.h"
#include "app/shell/dock.h"
#include "app/window/window.h"
#include "haptics/error.h"

#include <QDockWidget>

#include <algorithm>

namespace palp
{

void Window::showBody()
{
  endReview();
  setWindowTitle(tr("Palp — %1").arg(QString::fromStdString(session_.body().name)));
  orientation_.setPatient(isPatient(session_.body()));
  shown_ = {};
  balls_.show({});
  organs_ != nullptr&& session_.organs().empty() ? organs_->parentWidget()->hide() : void();
  showOrgans();
  fittedTo_ = std::pair(0, 0);
  queued_.clear();
  dropMap();
}

void Window::makeOrganList()
{
  if (session_.organs().empty())
  {
    return;
  }
  organs_ = new OrganList;
  organs_->show(session_.organs());
  addDock(this, Qt::RightDockWidgetArea, tr("Organs"), organs_);
  connect(organs_, &OrganList::changed, this, &Window::changeOrgans);
  connect(organs_, &OrganList::chosenChanged, this, [this] { panel_->setScene(tissueInUse()); });
}

// as the session has them: in the list, below the pointer, in the picture
void Window::showOrgans()
{
  const Scene& scene = session_.recording().scene;
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

// another organ is touched than before; a mouse that presses it chooses it, too
void Window::showOther()
{
  showPictured();
  if (organs_ && !review_ && session_.isLed())
  {
    organs_->choose(session_.recording().organName(shown_.organ));
    panel_->setScene(tissueInUse());
  }
}

// false where they are refused
bool Window::useOrgans(const std::vector<OrganPlan>& organs)
{
  const bool isUsed = attempt(
    [&]
    {
      if (!std::ranges::equal(organs, session_.organs(), {}, &OrganPlan::name, &OrganPlan::name))
      {
        throw Error(ErrorCode::BadValue, "those organs are no longer open");
      }
      endReview();
      takeSamples();
      const std::uint64_t before = session_.recording().scene.version;
      session_.setOrgans(organs);
      session_.recording().scene.version != before ? clearCharts() : void();
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

// that of the organ that is chosen, with the tool
Scene Window::tissueInUse() const
{
  Scene scene = session_.recording().scene;
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
  return organOf(pictured().recording.scene, shown_.organ);
}

const Calibration& Window::calibrationShown() const
{
  return organOf(pictured().calibration, shown_.organ);
}

} // namespace palp
