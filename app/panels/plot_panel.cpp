#include "app/panels/plot_panel.h"

#include "haptics/error.h"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkRenderWindow.h>
#include <vtkRendererCollection.h>

#include <QHBoxLayout>
#include <QPushButton>
#include <QTabBar>

namespace palp
{

PlotPanel::PlotPanel(std::vector<Page> pages, QWidget* parent)
  : QWidget(parent)
  , pages_(std::move(pages))
  , tabs_(new QTabBar)
{
  window_->SetMultiSamples(0);
  auto* canvas = new QVTKOpenGLNativeWidget;
  canvas->setObjectName("plots");
  canvas->setRenderWindow(window_);
  canvas->setMinimumSize(280, 180);
  tabs_->setObjectName("plotTabs");
  tabs_->setExpanding(false);
  for (const Page& page : pages_)
  {
    tabs_->addTab(page.name);
  }
  auto* save = new QPushButton(tr("Save…"));
  auto* top = new QHBoxLayout;
  top->addWidget(tabs_, 1);
  top->addWidget(save);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(top);
  layout->addWidget(canvas, 1);
  connect(tabs_, &QTabBar::currentChanged, this, &PlotPanel::refresh);
  connect(save, &QPushButton::clicked, this, &PlotPanel::saveAsked);
}

void PlotPanel::refresh()
{
  if (!isVisible())
  {
    return;
  }
  const int page = tabs_->currentIndex();
  Plots plots = pages_[static_cast<std::size_t>(page)].make();
  // those of the same page stay, to be looked at when the tool is lifted
  if (!plots.empty() || page != page_)
  {
    showPlots(*window_, plots);
    plots_ = std::move(plots); // the window has let go of those before
    page_ = page;
  }
  window_->Render();
}

QString PlotPanel::save(const std::filesystem::path& file)
{
  if (plots_.empty())
  {
    throw Error(ErrorCode::BadValue, "nothing to save yet: press the surface");
  }
  QString what = savePlots(plots_, file);
  showPlots(*window_, plots_); // a chart is in one window at a time
  window_->Render();
  return what;
}

QString savePlots(const Plots& plots, const std::filesystem::path& file)
{
  constexpr int kWidth = 1600; // [pixels]
  constexpr int kHeight = 1000;
  constexpr int kDpi = 144; // letters and marks twice as large as on a screen
  const bool isPicture = file.extension() == ".png";
  const int divisor = isPicture ? 1 : 2; // lines and text are as sharp at any size
  const int height = plots.size() > 1 ? kHeight * 3 / 2 : kHeight;
  vtkNew<vtkRenderWindow> window;
  window->SetShowWindow(false);
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(isPicture ? 8 : 0);
  window->SetSize(kWidth / divisor, height / divisor);
  window->SetDPI(kDpi / divisor);
  showPlots(*window, plots);
  writePlots(plots, *window, file);
  window->GetRenderers()->RemoveAllItems(); // the charts outlive it
  return isPicture ? QObject::tr("%1 x %2 pixels").arg(kWidth).arg(height)
                   : QObject::tr("lines and text");
}

} // namespace palp
