#include "app/panel_area.h"

#include <QEvent>
#include <QScreen>
#include <QScrollBar>

#include <algorithm>

namespace palp
{

PanelArea::PanelArea(QWidget* content)
{
  setWidget(content);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
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
  setMinimumHeight(std::min(height, screen()->availableGeometry().height() / 2));
  setMaximumHeight(height);
  setMinimumWidth(widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width());
}

} // namespace palp
