#pragma once

#include <QObject>
#include <functional>

class QWidget;

namespace palp
{

/// A key that counts for as long as it is held, wherever in a window the focus is but in a field
/// that is typed into; a window that loses the focus lets go.
class HoldKey : public QObject
{
public:
  /// @param window  owns this object
  /// @param held    told of each change
  HoldKey(int key, QWidget& window, std::function<void(bool isHeld)> held);

  bool eventFilter(QObject* object, QEvent* event) override;

private:
  void change(bool isHeld);

  int key_;
  QWidget& window_;
  std::function<void(bool)> held_;
  bool isHeld_ = false;
};

} // namespace palp
