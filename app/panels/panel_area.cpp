#include "app/panels/panel_area.h"

#include <QEvent>
#include <QScrollBar>

#include <algorithm>

namespace palp
{

namespace
{

void fitWidth(QScrollArea& area)
{
  area.setMinimumWidth(
    area.widget()->minimumSizeHint().width() + area.verticalScrollBar()->sizeHint().width());
}

} // namespace

void scrollDownOnly(QScrollArea& area, QWidget* content)
{
  area.setWidget(content);
  area.setWidgetResizable(true);
  area.setFrameShape(QFrame::NoFrame);
  area.setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  fitWidth(area);
}

PanelArea::PanelArea(QWidget* content)
{
  scrollDownOnly(*this, content);
  fit();
}

bool PanelArea::eventFilter(QObject* object, QEvent* event)
{
  if (object == widget() && event->type() == QEvent::LayoutRequest)
  {
    fit();
  }
  return QScrollArea::eventFilter(object, event);
}

// limits, as a dock heeds no hint once it has a height
void PanelArea::fit()
{
  const int height = widget()->sizeHint().height();
  setMinimumHeight(std::min(height, kLeastScreen / 3));
  setMaximumHeight(height);
  fitWidth(*this);
}

} // namespace palp
