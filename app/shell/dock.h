#pragma once

#include <QDockWidget>
#include <QMainWindow>
#include <QTimer>

namespace palp
{

/// A panel beside the picture, which the window remembers by its title.
inline QDockWidget* addDock(
  QMainWindow* window, Qt::DockWidgetArea area, const QString& title, QWidget* content)
{
  auto* dock = new QDockWidget(title, window);
  dock->setObjectName(title);
  content->setAccessibleName(title); // it may be scrolled by keys, and has to say what it is
  dock->setWidget(content);
  window->addDockWidget(area, dock);
  return dock;
}

/// Shows a dock in front of those that share its place, once it has one.
inline void bringUp(QDockWidget* dock)
{
  QTimer::singleShot(0, dock, &QDockWidget::raise);
}

} // namespace palp
