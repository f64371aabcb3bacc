#include "app/graphs/plot_panel.h"

#include <QBoxLayout>
#include <QTabBar>

#include <algorithm>

namespace palp
{

PlotPanel::PlotPanel(std::vector<Page> pages, QWidget* parent)
  : ChartPanel("plots", parent)
  , pages_(std::move(pages))
  , tabs_(new QTabBar)
{
  tabs_->setObjectName("plotTabs");
  tabs_->setAccessibleName(tr("Plots"));
  tabs_->setExpanding(false);
  tabs_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); // turned by its arrows
  for (const Page& page : pages_)
  {
    tabs_->addTab(page.name);
  }
  qobject_cast<QBoxLayout*>(layout())->insertWidget(0, tabs_); // the buttons' row is full
  setScene(showEmptyScene(window()));                          // before the first press
  setHint(pages_.front().hint);
  connect(tabs_, &QTabBar::currentChanged, this, &PlotPanel::refresh);
}

void PlotPanel::refresh()
{
  if (!isVisible())
  {
    return;
  }
  const int page = tabs_->currentIndex();
  const Page& shown = pages_[static_cast<std::size_t>(page)];
  Plots plots = shown.make();
  if (!plots.empty() || page != page_ || !shown.stays)
  {
    for (std::size_t i = 0; page == page_ && i < std::min(plots.size(), plots_.size()); ++i)
    {
      plots[i]->chart().TakeViewOf(plots_[i]->chart());
    }
    put(std::move(plots));
    page_ = page;
  }
  setHint(plots_.empty() ? shown.hint : QString());
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

} // namespace palp
