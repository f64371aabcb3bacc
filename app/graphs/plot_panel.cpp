#include "app/graphs/plot_panel.h"

#include "app/graphs/chart_theme.h"
#include "haptics/error.h"

#include <vtkRenderWindow.h>
#include <vtkRendererCollection.h>

#include <QBoxLayout>
#include <QTabBar>

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

ImageSize usualSizeOf(const Plots& plots)
{
  return { .width = 1600, .height = plots.size() > 1 ? 1500 : 1000 };
}

} // namespace

PlotPanel::PlotPanel(std::vector<Page> pages, QWidget* parent)
  : ChartPanel("plots", parent)
  , pages_(std::move(pages))
  , tabs_(new QTabBar)
{
  tabs_->setObjectName("plotTabs");
  tabs_->setExpanding(false);
  tabs_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // turned by its arrows
  for (const Page& page : pages_)
  {
    tabs_->addTab(page.name);
  }
  qobject_cast<QBoxLayout*>(layout())->insertWidget(0, tabs_); // the buttons' row is full
  setScene(showEmptyScene(window()));                          // before the first press
  connect(tabs_, &QTabBar::currentChanged, this, &PlotPanel::refresh);
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
    for (std::size_t i = 0; page == page_ && i < std::min(plots.size(), plots_.size()); ++i)
    {
      plots[i]->chart().TakeViewOf(plots_[i]->chart());
    }
    put(std::move(plots));
    page_ = page;
  }
  draw();
}

void PlotPanel::turnTo(const QString& page)
{
  for (int i = 0; i < tabs_->count(); ++i)
  {
    if (tabs_->tabText(i) == page)
    {
      tabs_->setCurrentIndex(i);
    }
  }
}

void PlotPanel::put(Plots plots)
{
  setScene(showPlots(window(), plots));
  plots_ = std::move(plots); // the window has let go of those before
}

QString PlotPanel::save(const std::filesystem::path& file, std::optional<ImageSize> size)
{
  if (plots_.empty())
  {
    throw Error(ErrorCode::BadValue, "nothing to save yet: press the surface");
  }
  QString what = savePlots(plots_, file, size);
  put(std::move(plots_)); // a chart is in one window at a time
  draw();
  return what;
}

ImageSize PlotPanel::usualSize() const
{
  return usualSizeOf(plots_);
}

QString savePlots(
  const Plots& plots, const std::filesystem::path& file, std::optional<ImageSize> wanted)
{
  constexpr double kUsualGrowth = 2.0; // letters and marks twice as large as on a screen
  const ImageSize usual = usualSizeOf(plots);
  const ImageSize size = wanted.value_or(usual);
  const double area = static_cast<double>(size.width) * size.height / usual.width / usual.height;
  const double growth = std::max(1.0, kUsualGrowth * std::sqrt(area));
  const bool isPicture = file.extension() == ".png";
  const double divisor = isPicture ? 1.0 : growth; // lines and text are as sharp at any size
  const auto width = static_cast<int>(std::lround(size.width / divisor));
  const auto height = static_cast<int>(std::lround(size.height / divisor));
  vtkNew<vtkRenderWindow> window;
  window->SetShowWindow(false);
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(isPicture ? 8 : 0);
  window->SetSize(width, height);
  window->SetDPI(static_cast<int>(std::lround(appearance::kDpi * growth / divisor)));
  for (const auto& plot : plots)
  {
    paintChart(plot->chart(), false);
  }
  showPlots(*window, plots);
  writePlots(plots, *window, file);
  window->GetRenderers()->RemoveAllItems(); // the charts outlive it
  return isPicture ? QObject::tr("%1 x %2 pixels").arg(width).arg(height)
    : file.extension() == ".csv"
    ? QObject::tr("all curves")
    : QObject::tr("lines and text, %1 x %2 points").arg(width).arg(height);
}

} // namespace palp
