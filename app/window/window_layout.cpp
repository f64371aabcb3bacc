// What the window is made of; what it does is in window.cpp.

#include "app/graphs/chart_panel.h"
#include "app/graphs/figure_dialog.h"
#include "app/graphs/plot_panel.h"
#include "app/panels/device_panel.h"
#include "app/panels/diagnostics_panel.h"
#include "app/panels/panel_area.h"
#include "app/panels/press_list.h"
#include "app/panels/tissue_panel.h"
#include "app/panels/validity_panel.h"
#include "app/plots/chart_job.h"
#include "app/plots/kept_presses.h"
#include "app/shell/compose_alone.h"
#include "app/shell/dock.h"
#include "app/shell/message_bar.h"
#include "app/shell/theme.h"
#include "app/window/vtkPalpPressStyle.h"
#include "app/window/window.h"
#include "pipeline/layout/before_render.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QScrollArea>
#include <QStatusBar>

#include <algorithm>

namespace palp
{
namespace
{

// for a screen that is too low for all panels
QScrollArea* scrolled(QWidget* content)
{
  auto* area = new QScrollArea;
  scrollDownOnly(*area, content);
  return area;
}

// listed when they are looked for, as some are made late
void addPanels(QMainWindow& window, QMenu& menu)
{
  QMenu* panels = menu.addMenu(QMainWindow::tr("Pa&nels"));
  panels->setObjectName("panels");
  QObject::connect(panels, &QMenu::aboutToShow, &window,
    [&window, panels]
    {
      panels->clear();
      for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
      {
        panels->addAction(dock->toggleViewAction());
      }
    });
}

} // namespace

void Window::makeView()
{
  canvas_ = new QVTKOpenGLNativeWidget(this);
  canvas_->setObjectName("canvas");
  canvas_->setAccessibleName(tr("Picture of the press"));
  composeAlone(*canvas_);
  canvas_->setRenderWindow(renderWindow_);
  renderWindow_->SetMultiSamples(0);
  renderWindow_->AddRenderer(renderer_);
  setCentralWidget(canvas_);
  message_ = new MessageBar(canvas_);
  connect(message_, &MessageBar::covers, this,
    [this](int height)
    {
      setFoot(*renderer_, height * canvas_->devicePixelRatioF());
      isStale_ = true;
    });
  if (session_.plan().overlays)
  {
    view_.setVisible(*session_.plan().overlays);
  }

  makePointer();
  style_->AddObserver(vtkCommand::StartInteractionEvent, this, &Window::keepView);
}

void Window::makeDocks()
{
  panel_ = new TissuePanel(session_.scene(), session_.plan().validity);
  connect(panel_, &TissuePanel::tissueChanged, this, &Window::changeTissue);
  addDock(this, Qt::LeftDockWidgetArea, tr("Tool and tissue"), new PanelArea(panel_));
  makeDevicePanel();
  QScrollArea* device = scrolled(devicePanel_);
  const int usual = devicePanel_->sizeHint().height();
  constexpr int kMore = 4; // lines, to tell of a fault or a limit
  device->setMinimumHeight(std::min(usual, kLeastScreen / 6));
  device->setMaximumHeight(usual + kMore * devicePanel_->fontMetrics().lineSpacing());
  addDock(this, Qt::LeftDockWidgetArea, tr("Device"), device);
  QDockWidget* validity = nullptr;
  if (session_.plan().validity)
  {
    validityPanel_ = new ValidityPanel;
    validity =
      addDock(this, Qt::LeftDockWidgetArea, tr("Model validity"), scrolled(validityPanel_));
  }
  diagnostics_ = new DiagnosticsPanel;
  QDockWidget* diagnostics =
    addDock(this, Qt::LeftDockWidgetArea, tr("Diagnostics"), scrolled(diagnostics_));
  if (validity != nullptr)
  {
    tabifyDockWidget(validity, diagnostics); // which costs no height
  }
  diagnostics->hide();

  makeOrganList();

  forceLabel_ = new QLabel;
  forceLabel_->setObjectName("force");
  forceLabel_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // cut, not the window's
  statusBar()->addWidget(forceLabel_, 1);
}

void Window::makeCharts()
{
  charts_ = std::make_unique<ForceCharts>();
  charts_->setSent(session_.rendersForce());
  for (const PlotKind plot : session_.plan().plots)
  {
    if (plot == PlotKind::ForceOverTime)
    {
      ChartPanel* panel = makeChartPanel(0);
      addDock(this, Qt::RightDockWidgetArea, tr("Force over time"), panel);
      charts_->addForceOverTime(*panel->scene());
    }
    else if (plot == PlotKind::ForceOverDepth)
    {
      ChartPanel* panel = makeChartPanel(1);
      addDock(this, Qt::RightDockWidgetArea, tr("Force over depth"), panel);
      charts_->addForceOverDepth(*panel->scene());
    }
  }
}

// both are paused and cleared together, as they show the same press
ChartPanel* Window::makeChartPanel(std::size_t chart)
{
  auto* panel = new ChartPanel(chart == 0 ? "timeChart" : "depthChart");
  panel->setScene(showEmptyScene(panel->window()));
  panel->offerPause();
  chartPanels_.push_back(panel);
  connect(panel, &ChartPanel::pauseToggled, this,
    [this](bool paused)
    {
      charts_->setPaused(paused);
      for (ChartPanel* each : chartPanels_)
      {
        each->setPaused(paused);
      }
      chartsAreStale_ = true;
    });
  connect(panel, &ChartPanel::clearAsked, this,
    [this]
    {
      clearCharts();
      undrawn_ = chartPanels_;
    });
  connect(panel, &ChartPanel::saveAsked, this,
    [this, chart]
    {
      FigureDialog dialog(tr("Save chart"), chart == 0 ? "force_time.png" : "force_depth.png",
        tr("Plots (*.png *.svg *.pdf *.csv)"), ImageSize{ .width = 1600, .height = 1000 }, this);
      if (dialog.exec() == QDialog::Accepted)
      {
        saveChart(chart, dialog.file(), dialog.size());
      }
    });
  return panel;
}

// made when it is first shown
void Window::makePlots(bool shown)
{
  if (plots_)
  {
    auto* dock = qobject_cast<QDockWidget*>(plots_->parentWidget());
    dock->setVisible(shown);
    bringUp(dock);
    chartsAreStale_ = true;
    return;
  }
  const auto forces = [this]
  {
    const Recording& recording = session_.recording();
    const auto press = recording.lastPress();
    const int organ = press.empty() ? 0 : press.back().organ;
    return forceComparison(
      organOf(recording.scene, organ), press, &organOf(session_.calibration(), organ));
  };
  const auto section = [this]
  {
    const Pictured seen = pictured();
    return sectionOf(view_.press(), calibrationShown(),
      seen.body.felt(seen.recording.organs, shown_.organ).shownNodules());
  };
  plots_ =
    new PlotPanel({ { tr("Section"), section, tr("Nothing to show: press the surface and hold it"),
                      true }, // also when it is lifted
      { tr("Forces"), forces },
      { tr("Extent"), [this] { return extentComparison(calibrationShown()); } },
      { tr("Presses"), [this] { return pressForces(pressList_->ticked()); },
        tr("Nothing to show yet: press the surface, and tick the press in the list of presses") },
      { tr("Differences"), [this] { return pressDifferences(pressList_->compared()); },
        tr("Nothing to compare yet: tick two presses or more in the list of presses") } });
  connect(plots_, &PlotPanel::saveAsked, this,
    [this]
    {
      FigureDialog dialog(tr("Save plots"), "plots.png", tr("Plots (*.png *.svg *.pdf *.csv)"),
        ChartSheet::usualSize(plots_->plots()), this);
      if (dialog.exec() == QDialog::Accepted)
      {
        savePlots(dialog.file(), dialog.size());
      }
    });
  QDockWidget* dock = addDock(this, Qt::RightDockWidgetArea, tr("Section and comparison"), plots_);
  if (auto* charts = findChild<QDockWidget*>(tr("Force over depth")))
  {
    tabifyDockWidget(charts, dock); // below two charts it would be too low to draw
    bringUp(dock);
  }
  auto* entry = findChild<QAction*>("plotsAction");
  connect(dock->toggleViewAction(), &QAction::toggled, entry, &QAction::setChecked);
}

void Window::showPlots(const QString& page)
{
  if (!isFree())
  {
    return;
  }
  findChild<QAction*>("plotsAction")->setChecked(true);
  auto* dock = qobject_cast<QDockWidget*>(plots_->parentWidget());
  resizeDocks({ dock }, { height() / 2 }, Qt::Vertical);
  resizeDocks({ dock }, { std::max(dock->width(), width() * 3 / 10) }, Qt::Horizontal);
  bringUp(dock);
  plots_->turnTo(page);
  chartsAreStale_ = true; // once it can be seen
}

void Window::makeViewMenu()
{
  QMenu* view = menuBar()->addMenu(tr("&View"));
  view->setToolTipsVisible(true);
  view
    ->addAction(
      tr("&Reset view"), this, [this] { fittedTo_ = std::pair(0, 0); }, QKeySequence(Qt::Key_Home))
    ->setObjectName("resetViewAction");
  addStandardViews(*view);
  view->addSeparator();
  addMarks(*view);
  addBodyLooks(*view);
  const auto add = [&](const QString& name, Overlay overlay)
  {
    QAction* action = view->addAction(name);
    action->setCheckable(true);
    action->setChecked(view_.isVisible(overlay));
    connect(action, &QAction::toggled, this,
      [this, overlay](bool on)
      {
        view_.setVisible(overlay, on);
        isStale_ = true;
      });
    return action;
  };
  add(tr("&Force arrow"), Overlay::ForceArrow);
  add(tr("&Contact circle"), Overlay::ContactCircle);
  add(tr("&Extent circle"), Overlay::ExtentCircle);
  add(tr("&Lines of equal displacement"), Overlay::IsoLines);
  add(tr("&Readings"), Overlay::Readings);
  add(tr("Bézier control &net"), Overlay::ControlNet);
  add(tr("&Undeformed surface"), Overlay::Ghost);
  view->addSeparator();
  auto* colors = new QActionGroup(this); // the surface has one at a time, or its own
  colors->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
  colors->addAction(add(tr("&Displacement colors"), Overlay::DisplacementColors));
  colors->addAction(add(tr("&Pressure colors"), Overlay::PressureColors));
  colors->addAction(add(tr("&Validity colors"), Overlay::ValidityColors));
  mapColors_ = view->addAction(tr("S&tiffness map")); // over the others
  mapColors_->setObjectName("mapColors");
  mapColors_->setCheckable(true);
  mapColors_->setEnabled(false);
  connect(mapColors_, &QAction::toggled, this, &Window::showMap);
  view->addSeparator();
  addPanels(*this, *view);
  addThemes(*view);
  QAction* plots = view->addAction(tr("Section and comparison &plots"));
  plots->setObjectName("plotsAction");
  plots->setCheckable(true);
  connect(plots, &QAction::toggled, this, &Window::makePlots);
  const ScenePlan& plan = session_.plan();
  plots->setChecked(
    plan.has(PlotKind::Section) || plan.has(PlotKind::Comparison) || plan.has(PlotKind::Extent));
}

} // namespace palp
