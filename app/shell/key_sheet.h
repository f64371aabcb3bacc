#pragma once

#include <QString>

#include <vector>

class QMenuBar;
class QWidget;

namespace palp
{

/// What the user does, and what that does.
struct KeyEntry
{
  QString keys;
  QString effect;
};

/// Every entry of the menus, of those below them too, that has a key.
[[nodiscard]] std::vector<KeyEntry> keysOf(const QMenuBar& menus);

/// All of the mouse and the keys on one sheet beside the window; takes it away where it is shown,
/// as Escape stops a force wherever the focus is.
void showKeySheet(QWidget& window, const std::vector<KeyEntry>& mouse, const QMenuBar& menus);

} // namespace palp
