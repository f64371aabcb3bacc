#include "app/window/window.h"

#include "app/check/panel/surface_check.h"
#include "app/folder/autosave.h"
#include "app/graphs/chart_panel.h"
#include "app/graphs/plot_panel.h"
#include "app/organs/organ_list.h"
#include "app/organs/support_painting.h"
#include "app/panels/device_panel.h"
#include "app/panels/diagnostics_panel.h"
#include "app/panels/press_list.h"
#include "app/panels/tissue_panel.h"
#include "app/panels/validity_panel.h"
#include "app/press/recording.h"
#include "app/program/build_trace.h"
#include "app/shell/message_bar.h"
#include "app/train/panel/training_panel.h"
#include "app/window/vtkPalpPressStyle.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/figure/fast_pass.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QScreen>
#include <QTimer>

#include <utility>

namespace palp
{
namespace
{

constexpr int kFrameMs = 16; // the picture
constexpr int kPlotMs = 33;  // panels and charts, which cost more and need less, by turns
constexpr int kPlotTurns = 3;
constexpr int kTimingMs = 1000; // what always changes a little

constexpr const char* kHint =
  "Drag down: press    Wheel: hold a depth    Right-drag: rotate    Middle-drag: move    "
  "Ctrl+wheel: zoom    H: all keys";

// whether nobody could tell their pictures apart
bool looksAlike(const Sample& a, const Sample& b)
{
  constexpr double kLength = 1e-6; // [m]
  constexpr double kAngle = 1e-4;  // [rad]
  constexpr double kForce = 1e-3;  // [N]
  const bool near = (a.pose.apex - b.pose.apex).norm() < kLength &&
    (a.pose.axis - b.pose.axis).norm() < kAngle &&
    (a.contact.normal - b.contact.normal).norm() < kAngle;
  return near && a.organ == b.organ && std::abs(a.contact.depth - b.contact.depth) < kLength &&
    std::abs(a.surfaceDepth - b.surfaceDepth) < kLength &&
    std::abs(a.response.force - b.response.force) < kForce && (a.force - b.force).norm() < kForce;
}

bool looksAlike(const Sample* a, const Sample* b)
{
  return a == nullptr || b == nullptr ? a == b : looksAlike(*a, *b);
}

// of the second hand, live or at that time of a recording; null: there is none
const Sample* secondBeside(const Sample& sample, Session& session, const Recording* reviewed)
{
  if (reviewed == nullptr)
  {
    return session.newestOfSecond();
  }
  return reviewed->second ? nearestSample(reviewed->second->samples, sample.time) : nullptr;
}

} // namespace

Window::Window(Session& session, BuildTrace& trace)
  : session_(session)
  , view_(*renderer_)
  , other_(*renderer_, view_)
  , around_(*renderer_)
  , fast_(fastPass())
  , realism_(*renderer_)
  , orientation_(*renderer_)
  , scaleBar_(*renderer_)
  , balls_(*renderer_)
  , reach_(*renderer_)
  , pointer_([this](double x, double y) { return sightLine(x, y); })
  , validity_(session.scene().law)
  , takesKept_(session.earlier().size())
{
  constexpr QSize kFrame{ 16, 48 }; // about what a title bar and borders take
  resize(QSize(1440, 860).boundedTo(screen()->availableSize() - kFrame));
  trace.build("3-D view", "the window shows the surface", [&] { makeView(); });
  trace.build("panels, menus", "tool, tissue and device can be changed",
    [&]
    {
      makeDocks();
      makeFileMenu();
      makeEditMenu();
      makeDeviceMenu();
      makeViewMenu();
      makePlaying();
      makeTraining();
      makeHelpMenu();
      makeToolBar();
      makePressBar();
    });
  if (session_.plan().records())
  {
    trace.build("plots", "named in the scene",
      [&]
      {
        makeCharts();
        makePressList();
      });
  }
  memory_.restore(*this);
  handPlayBar();
  setAcceptDrops(true);
  showBody();
  applyTissue();
  takeTheme();
  if (session_.plan().camera)
  {
    lookFrom(*session_.plan().camera);
  }
  if (session_.body().training)
  {
    showTraining();
    beginSearch();
  }

  frames_ = new QTimer(this);
  frames_->setObjectName("frames");
  frames_->setTimerType(Qt::PreciseTimer);
  connect(frames_, &QTimer::timeout, this, &Window::refresh);
  frames_->start(kFrameMs);
  auto* plots = new QTimer(this);
  connect(plots, &QTimer::timeout, this, &Window::refreshPanels);
  plots->start(kPlotMs);
  auto* timing = new QTimer(this);
  connect(timing, &QTimer::timeout, this, &Window::refreshTiming);
  timing->start(kTimingMs);
}

Window::~Window()
{
  message_->disconnect(this); // it is hidden after the picture that it covers is gone
  for (auto* dock : findChildren<QDockWidget*>()) // likewise
  {
    dock->disconnect(this);
  }
}

void Window::takeSamples()
{
  session_.update(
    [this](const Sample& sample)
    {
      acting_ |= sample.flags;
      chartsAreStale_ = true;
      if (charts_)
      {
        charts_->add(sample);
      }
    });
}

// once, where it begins
void Window::sayWhatIsThinned()
{
  const bool isThinned = session_.isThinned();
  if (isThinned && !saidThinned_)
  {
    say(tr("A long recording: of what is older than ten minutes, the least and the largest depth "
           "and force of each 0.1 s are kept"));
  }
  saidThinned_ = isThinned;
}

void Window::clearCharts()
{
  if (charts_)
  {
    charts_->setSent(session_.rendersForce());
    charts_->clear();
  }
  chartsAreStale_ = true;
}

void Window::refresh()
{
  frames_->start(kFrameMs);
  takeSamples();
  sayWhatIsThinned();
  pressQueued();
  aim(); // a click ends by itself
  fitView();
  Sample sample = sampleToShow();
  if (map_ && mapColors_->isChecked() && !review_ && !sample.contact.touching())
  {
    sample.organ = placeOf(map_->map).value_or(sample.organ); // whose map is to be seen
  }
  if (organs_ && !review_ && !session_.isCurrent(sample))
  {
    return; // of organs that are no longer felt
  }
  shown_.flags = sample.flags;
  shown_.state = sample.state;
  const Session::Reach reach = session_.reach();
  isStale_ = reach_.show(reach.center, reach.radius) || isStale_;
  const Sample* second = secondBeside(sample, session_, review_ ? &pictured().recording : nullptr);
  if (isStale_ || !looksAlike(sample, shown_) || !looksAlike(second, other_.shown()))
  {
    const bool isOther = shown_.organ != sample.organ;
    const bool begins = !shown_.contact.touching() && sample.contact.touching();
    shown_ = sample;
    isOther ? showPictured() : void();
    isOther || begins ? chooseTouched() : void();
    isStale_ = false;
    chartsAreStale_ = true; // the section
    other_.show(shown_, second);
    shown_.contact.touching() ? scaleBar_.setPlace(shown_.contact.center) : void();
    still_ = 0;
    setSmooth(false);
    renderWindow_->Render();
    showReadings();
    sound_.setForce(shown_.contact.touching() ? shown_.response.force : 0.0);
  }
  smoothen(sample);
  chooseRealism();
  tellCoarse();
}

// all that tells of the press is of the one sample that the picture shows; of the device, live
void Window::showReadings()
{
  const Sample& live = review_ ? session_.newest() : shown_;
  const Sample* second = session_.newestOfSecond();
  const std::uint32_t flags = acted_ | live.flags | (second != nullptr ? second->flags : 0U);
  devicePanel_->show(session_, live, second, flags);
  const Contact& contact = shown_.contact;
  const Calibration& calibration = calibrationShown();
  forceLabel_->setText(!contact.touching()
      ? tr(kHint)
      : tr("Force %1 N    depth %2 mm    stiffness %3 N/mm")
          .arg(shown_.response.force, 0, 'f', 2)
          .arg(units::toMillimeters(contact.depth), 0, 'f', 1)
          .arg(units::toNewtonsPerMillimeter(shown_.response.stiffness), 0, 'f', 2) +
        (calibration.covers(contact.depth) ? QString() : tr("    R_d estimated")) +
        (calibration.fits(contact) ? QString() : tr("    dent estimated")));
}

// or one of the charts: all in a turn may take longer than a picture
void Window::refreshPanels()
{
  panelTurn_ = (panelTurn_ + 1) % kPlotTurns;
  if (panelTurn_ > 0)
  {
    if (!undrawn_.empty())
    {
      undrawn_.back()->draw();
      undrawn_.pop_back();
    }
    return;
  }
  acted_ = std::exchange(acting_, 0);
  followMap();
  showReadings();
  search_ ? training_->showProgress(session_.newest().time - search_->from, search_->marks.size())
          : void();
  if (validityPanel_)
  {
    showValidity(shown_);
  }
  if (pressList_ != nullptr && pressList_->refresh())
  {
    showTicked();
  }
  if (std::exchange(chartsAreStale_, false))
  {
    refreshCharts();
  }
}

// a text that changes lays the whole window out and draws it: seldom while nothing else changes
void Window::refreshTiming()
{
  checkSaved();
  constexpr int kIdle = 120;  // pictures
  constexpr int kSeldom = 10; // times
  if (still_ > kIdle && ++timingsLeftOut_ < kSeldom)
  {
    return;
  }
  timingsLeftOut_ = 0;
  if (diagnostics_->isVisible())
  {
    diagnostics_->show(session_.timing(), session_.schedule());
  }
}

void Window::refreshCharts()
{
  if (charts_)
  {
    charts_->mark(review_ && reviewed_ == 0 ? &shown_ : nullptr);
    charts_->refresh();
    undrawn_ = chartPanels_;
  }
  if (plots_)
  {
    plots_->refresh();
  }
}

void Window::showValidity(const Sample& sample)
{
  const Contact& contact = sample.contact;
  if (contact.touching())
  {
    Scene scene = organShown();
    scene.nodules = search_ ? nullptr : scene.nodules; // which the rules would tell of
    std::vector<Rule> rules = rulesAt(scene, validity_, contact);
    if (const Sample* second = other_.shown())
    {
      rules.push_back(betweenRule(pictured().calibration, sample, *second));
    }
    validityPanel_->showRules(rules, contrastsAt(scene, contact));
  }
  else
  {
    validityPanel_->showNoContact();
  }
}

} // namespace palp
