#include "app/window.h"

#include "app/device_panel.h"
#include "app/export.h"
#include "app/ledger.h"
#include "app/plot_panel.h"
#include "app/reliance_panel.h"
#include "app/tissue_panel.h"
#include "app/vtkPalpPressStyle.h"
#include "calibration/replace_file.h"
#include "haptics/contact/indentation_of.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <QLabel>
#include <QMessageBox>
#include <QScreen>
#include <QStatusBar>
#include <QTimer>

#include <utility>

namespace palp
{
namespace
{

constexpr int kFrameMs = 16; // the picture
constexpr int kPlotMs = 100; // the curves, which cost more and need less

// whether nobody could tell their pictures apart
bool looksAlike(const Sample& a, const Sample& b)
{
  constexpr double kLength = 1e-6; // [m]
  constexpr double kAngle = 1e-4;  // [rad]
  constexpr double kForce = 1e-3;  // [N]
  const bool near = (a.pose.apex - b.pose.apex).norm() < kLength &&
    (a.pose.axis - b.pose.axis).norm() < kAngle &&
    (a.contact.normal - b.contact.normal).norm() < kAngle;
  return near && std::abs(a.contact.depth - b.contact.depth) < kLength &&
    std::abs(a.response.force - b.response.force) < kForce;
}

} // namespace

Window::Window(Session& session, Ledger& ledger)
  : session_(session)
  , view_(*renderer_)
  , pointer_([this](double x, double y) { return sightLine(x, y); })
  , validity_(session.recording().scene.law)
{
  resize(QSize(1440, 860).boundedTo(screen()->availableSize()));
  ledger.build("3-D view", "the window shows the surface", [&] { makeView(); });
  ledger.build("panels, menus", "tool, tissue and device can be changed",
    [&]
    {
      makeDocks();
      makeFileMenu();
      makeDeviceMenu();
      makeViewMenu();
    });
  if (session_.plan().records())
  {
    ledger.build("plots", "named in the scene", [&] { makeCharts(); });
  }
  showBody();
  applyTissue();

  auto* frames = new QTimer(this);
  connect(frames, &QTimer::timeout, this, &Window::refresh);
  frames->start(kFrameMs);
  auto* plots = new QTimer(this);
  connect(plots, &QTimer::timeout, this, &Window::refreshPanels);
  plots->start(kPlotMs);
}

Window::~Window() = default;

void Window::showBody()
{
  setWindowTitle(tr("Palp — %1").arg(QString::fromStdString(session_.body().name)));
  view_.setSurface(session_.body().display);
  pointer_.setSurface(session_.body().haptic);
  view_.lookAtSurface();
  isStale_ = true;
}

void Window::takeSamples()
{
  session_.update(
    [this](const Sample& sample)
    {
      acting_ |= sample.flags;
      if (charts_)
      {
        charts_->add(sample);
      }
    });
}

void Window::clearCharts()
{
  if (charts_)
  {
    charts_->clear();
  }
}

void Window::refresh()
{
  takeSamples();
  aim(); // a click ends by itself
  const Sample& sample = session_.newest();
  if (isStale_ || !looksAlike(sample, shown_))
  {
    view_.show(sample);
    renderWindow_->Render();
    shown_ = sample;
    isStale_ = false;
  }

  forceLabel_->setText(tr(kHint));
  if (sample.contact.touching())
  {
    forceLabel_->setText(
      tr("Force %1 N    depth %2 mm    stiffness %3 N/mm")
        .arg(sample.response.force, 0, 'f', 2)
        .arg(units::toMillimetres(sample.contact.depth), 0, 'f', 1)
        .arg(units::toNewtonsPerMillimetre(sample.response.stiffness), 0, 'f', 2) +
      (session_.calibration().covers(sample.contact.depth) ? QString() : tr("    R_d estimated")));
  }
}

void Window::refreshPanels()
{
  devicePanel_->show(session_, session_.newest(), std::exchange(acting_, 0));
  if (reliance_)
  {
    showReliance(session_.newest());
  }
  if (charts_)
  {
    charts_->refresh();
    for (vtkContextView* view : { timeView_.Get(), depthView_.Get() })
    {
      if (view->GetScene()->GetNumberOfItems() > 0)
      {
        view->GetRenderWindow()->Render();
      }
    }
  }

  if (plots_)
  {
    plots_->refresh();
  }

  const Timing& timing = session_.timing();
  const auto ticks = timing.ticks.load();
  const auto late = timing.skipped.load();
  const double elapsed = static_cast<double>(ticks + late);
  servoLabel_->setText(
    tr("servo %1 Hz    late ticks %2")
      .arg(elapsed > 0.0 ? 1000.0 * static_cast<double>(ticks) / elapsed : 0.0, 0, 'f', 0)
      .arg(late));
}

void Window::showReliance(const Sample& sample)
{
  const Contact& contact = sample.contact;
  if (contact.touching())
  {
    reliance_->showRules(validity_(indentationOf(contact), contact.edgeDistance));
  }
  else
  {
    reliance_->showNoContact();
  }
  reliance_->showTiming(session_.timing(), session_.schedule());
}

void Window::applyTissue()
{
  attempt(
    [this]
    {
      const ForceLaw law = panel_->law();
      session_.setTissue(law, panel_->rule(), panel_->damping());
      validity_ = Validity(law, { .stableStiffness = session_.stableStiffness() });
      view_.setTip(law.tip());
      view_.setLaw(law);
      view_.setExtents(session_.calibration().extents);
      view_.setStyle(session_.calibration().style);
      if (charts_)
      {
        charts_->setLaw(law);
      }
      clearCharts(); // as the recording
      isStale_ = true;
      forceLabel_->setToolTip(QString::fromStdString(session_.calibration().note));
    });
  panel_->setScene(session_.recording().scene); // what was refused is not in use
}

void Window::applyDevice(const QString& name)
{
  if (name == tr(kLookForDevices))
  {
    offerDevices();
    return;
  }
  attempt([&] { session_.useDevice(name.toStdString()); });
  devicePanel_->choose(QString::fromStdString(session_.recording().device));
  applyTissue(); // what is stable depends on the device
}

bool Window::openSurface(const QString& file, const QString& unit)
{
  const bool opened = attempt(
    [&]
    {
      session_.open(file.toStdString(), unit.toStdString());
      clearCharts();
      showBody();
    });
  devicePanel_->choose(QString::fromStdString(session_.recording().device));
  return opened;
}

bool Window::saveScreenshot(const QString& file)
{
  return attempt(
    [&]
    {
      renderWindow_->Render();
      replaceFile(file.toStdString(),
        [&](const std::filesystem::path& fresh)
        {
          if (!canvas_->grabFramebuffer().save(QString::fromStdString(fresh.string())))
          {
            throw Error(ErrorCode::BadFile,
              file.toStdString() + ": cannot be written; choose another folder or a name in .png");
          }
        });
    });
}

bool Window::savePlots(const QString& file)
{
  return attempt([&] { plots_->save(file.toStdString()); });
}

bool Window::exportData(const QString& directory)
{
  return attempt(
    [&]
    {
      takeSamples();
      const auto ask = [&](const std::string& found)
      {
        const QString text = tr("%1 holds %2 already. Replace?");
        return QMessageBox::question(this, tr("Palp"),
                 text.arg(directory, QString::fromStdString(found))) == QMessageBox::Yes;
      };
      if (exportRecording(directory.toStdString(), session_.body(), session_.recording(),
            session_.calibration(), session_.timing(), ask))
      {
        statusBar()->showMessage(tr("Written to %1").arg(directory), 5000);
      }
    });
}

bool Window::attempt(const std::function<void()>& work)
{
  try
  {
    work();
    return true;
  }
  catch (const std::exception& error)
  {
    QMessageBox::warning(this, tr("Palp"), QString::fromStdString(error.what()));
    return false;
  }
}

} // namespace palp
