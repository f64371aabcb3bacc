#include "app/plot_panel.h"

#include "haptics/error.h"

#include <QVTKOpenGLNativeWidget.h>

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
  canvas->setMinimumSize(320, 240);
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

void PlotPanel::save(const std::filesystem::path& file)
{
  if (plots_.empty())
  {
    throw Error(ErrorCode::BadValue, "nothing to save yet: press the surface");
  }
  writePlots(plots_, *window_, file);
}

} // namespace palp
