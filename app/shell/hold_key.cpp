#include "app/shell/hold_key.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QWidget>

#include <utility>

namespace palp
{

HoldKey::HoldKey(int key, QWidget& window, std::function<void(bool)> held)
  : QObject(&window)
  , key_(key)
  , window_(window)
  , held_(std::move(held))
{
  qApp->installEventFilter(this);
}

bool HoldKey::eventFilter(QObject* object, QEvent* event)
{
  const QEvent::Type type = event->type();
  if (type == QEvent::WindowDeactivate && object == &window_)
  {
    change(false);
  }
  else if (type == QEvent::KeyPress || type == QEvent::KeyRelease)
  {
    const auto& pressed = static_cast<const QKeyEvent&>(*event);
    const bool isHeld = type == QEvent::KeyPress;
    const bool isTyped = qobject_cast<QLineEdit*>(QApplication::focusWidget()) != nullptr;
    const bool counts = window_.isActiveWindow() && !isTyped && pressed.modifiers() == 0;
    if (pressed.key() == key_ && !pressed.isAutoRepeat() && (counts || !isHeld))
    {
      change(isHeld);
    }
  }
  return QObject::eventFilter(object, event);
}

void HoldKey::change(bool isHeld)
{
  if (std::exchange(isHeld_, isHeld) != isHeld)
  {
    held_(isHeld);
  }
}

} // namespace palp
