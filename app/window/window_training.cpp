// The search for hidden nodules: begun, marked, graded, shown, saved.

#include "app/panels/folder_dialog.h"
#include "app/panels/panel_area.h"
#include "app/panels/tissue_panel.h"
#include "app/shell/change.h"
#include "app/shell/dock.h"
#include "app/shell/message_bar.h"
#include "app/train/panel/training_panel.h"
#include "app/window/exported.h"
#include "app/window/window.h"
#include "haptics/error.h"

#include <QMenuBar>
#include <QScrollArea>

#include <algorithm>

namespace palp
{
namespace
{

constexpr double kMarkRadius = 1.5e-3; // [m]

Balls::Ball markAt(const Eigen::Vector3d& place, const appearance::Color& color)
{
  return { .center = place, .radius = kMarkRadius, .color = color };
}

std::vector<Balls::Ball> ballsOf(const Grade& grade)
{
  std::vector<Balls::Ball> balls;
  for (const GradedNodule& one : grade.nodules)
  {
    balls.push_back({ .center = one.nodule.nodule.center,
      .radius = one.nodule.nodule.radius,
      .color = one.foundBy ? appearance::kGood : appearance::kDoubtful });
  }
  for (const GradedMark& mark : grade.marks)
  {
    balls.push_back(markAt(mark.place, mark.isNear ? appearance::kContact : appearance::kInk));
  }
  return balls;
}

// null: none was graded
const Session::Take* lastSearch(const Session& session)
{
  const std::vector<Session::Take>& takes = session.earlier();
  const auto found = std::find_if(takes.rbegin(), takes.rend(),
    [](const Session::Take& take) { return take.body.training.has_value(); });
  return found == takes.rend() ? nullptr : &*found;
}

} // namespace

void Window::makeTraining()
{
  QMenu* menu = menuBar()->addMenu(tr("&Training"));
  QAction* begin = menu->addAction(tr("Find &hidden nodules…"), this, [this] { showTraining(); });
  begin->setObjectName("trainingAction");
  begin->setEnabled(session_.plan().records());
  const auto add = [&](const QString& name, const char* id, void (Window::*act)())
  {
    QAction* action = menu->addAction(name, this, act);
    action->setObjectName(id);
    action->setEnabled(false);
    return action;
  };
  add(tr("&Mark this place"), "markAction", &Window::markPlace)->setShortcut(Qt::Key_M);
  add(tr("&Finish and grade"), "gradeAction", &Window::finishTraining);
  add(tr("&Take the nodules out"), "noNodulesAction", &Window::takeNodulesOut);
}

// made when it is first asked for
void Window::showTraining()
{
  attempt(
    [this]
    {
      if (training_ == nullptr)
      {
        training_ = new TrainingPanel(shippedCurriculum());
        auto* area = new QScrollArea;
        scrollDownOnly(*area, training_);
        auto* dock = addDock(this, Qt::RightDockWidgetArea, tr("Training"), area);
        if (auto* curves = findChild<QDockWidget*>(tr("Force over depth")))
        {
          tabifyDockWidget(curves, dock); // the force over time stays in sight
        }
        connect(training_, &TrainingPanel::startAsked, this, &Window::startTraining);
        connect(training_, &TrainingPanel::markAsked, this, &Window::markPlace);
        connect(training_, &TrainingPanel::finishAsked, this, &Window::finishTraining);
        connect(training_, &TrainingPanel::saveAsked, this, &Window::askSheet);
        connect(training_, &TrainingPanel::refused, this,
          [this](const QString& why) { message_->warn(why); });
      }
      auto* dock = findChild<QDockWidget*>(tr("Training"));
      dock->show();
      bringUp(dock);
    });
}

void Window::startTraining(const TrainingPlan& plan)
{
  attempt(
    [&]
    {
      endReview();
      takeSamples();
      session_.train(plan);
      clearCharts();
      undo_.clear(); // of another tool or tissue
      takesKept_ = session_.earlier().size();
      showBody();
      beginSearch();
    });
}

void Window::beginSearch()
{
  search_ = Search{ .from = session_.newest().time };
  findChild<QAction*>("translucentAction")->setChecked(false);
  marked_.clear();
  showInside();
  lockForSearch(true);
  training_->showSearch(*session_.body().training);
  say(tr("Search what you see of %1: press and slide, watch the force, and mark with M where it "
         "rises; Ctrl+Z takes a mark back")
        .arg(QString::fromStdString(session_.body().name)));
}

// what would tell of nodules by other ways than touch, or end the recording
void Window::lockForSearch(bool searches)
{
  for (const char* name : { "markAction", "gradeAction" })
  {
    findChild<QAction*>(name)->setEnabled(searches);
  }
  panel_->setEnabled(!searches);
  QAction* plots = findChild<QAction*>("plotsAction");
  searches ? plots->setChecked(false) : void();
  plots->setEnabled(!searches);
}

bool Window::isFree()
{
  if (search_)
  {
    message_->warn(
      tr("A search for nodules goes on: finish it first (Training > Finish and grade)"));
  }
  return !search_;
}

void Window::markPlace()
{
  if (!search_)
  {
    return;
  }
  takeSamples();
  const std::vector<Sample>& samples = session_.recording().samples;
  const auto touched = std::find_if(samples.rbegin(), samples.rend(),
    [](const Sample& sample) { return sample.contact.touching(); });
  if (touched == samples.rend())
  {
    message_->warn(tr("Nothing was touched yet: press where a nodule may be, then mark"));
    return;
  }
  const auto add = [this, time = touched->time, place = touched->contact.center]
  {
    search_->marks.push_back(time);
    marked_.push_back(markAt(place, appearance::kContact));
    showInside();
  };
  const auto takeBack = [this]
  {
    search_->marks.pop_back();
    marked_.pop_back();
    showInside();
  };
  add();
  undo_.push(new Change(tr("mark"), takeBack, add));
}

void Window::finishTraining()
{
  if (!search_)
  {
    return;
  }
  attempt(
    [&]
    {
      letGo();
      takeSamples();
      const std::size_t before = session_.earlier().size();
      session_.finishTraining(search_->marks);
      search_.reset();
      undo_.clear(); // its marks are graded
      lockForSearch(false);
      clearCharts();
      takesKept_ = session_.earlier().size();
      if (takesKept_ == before) // nothing was touched
      {
        training_->showResult(nullptr);
        takeNodulesOut();
        return;
      }
      const Session::Take* take = lastSearch(session_);
      const Recording& recording = take->recording;
      const ScoreSheet sheet =
        scoreSheetOf(take->body.name, recording.scene, recording.samples, *take->body.training);
      training_->showResult(&sheet);
      marked_ = ballsOf(sheet.grade);
      findChild<QAction*>("translucentAction")->setChecked(true);
      showInside();
      say(QString::fromStdString(summaryOf(sheet.grade)) +
        tr(": green nodules were found, yellow ones missed; black marks are false"));
    });
}

// those of a search or of a scene
void Window::takeNodulesOut()
{
  std::vector<MeshSource> meshes = session_.body().sources;
  std::ranges::for_each(meshes, [](MeshSource& mesh) { mesh.nodules.clear(); });
  if (isFree() && attempt([&] { openBody({ .meshes = meshes, .organs = session_.organs() }); }))
  {
    say(tr("The nodules are out of %1").arg(QString::fromStdString(session_.body().name)));
  }
}

void Window::askSheet()
{
  FolderDialog dialog(tr("Save the score sheet into"), "palp_training", this);
  if (dialog.exec() == QDialog::Accepted)
  {
    saveSheet(dialog.folder());
  }
}

bool Window::saveSheet(const QString& directory)
{
  return attempt(
    [&]
    {
      const Session::Take* take = lastSearch(session_);
      if (take == nullptr)
      {
        throw Error(ErrorCode::BadValue, "training: none was graded yet; finish one first");
      }
      if (exportOne(
            directory, exported({ take->body, take->recording, take->calibration }), nullptr))
      {
        say(
          tr("Written to %1: score.html, score.json, score.csv, and the recording that they are of")
            .arg(directory));
      }
    });
}

} // namespace palp
