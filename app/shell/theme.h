#pragma once

#include <QPalette>

class QMenu;

namespace palp
{

enum class Theme
{
  System, ///< what the desktop has
  Light,
  Dark,
};

/// Gives it to all windows of the program, and remembers it for the next ones.
void setTheme(Theme theme);

/// The one that was set last, in this program or an earlier one.
[[nodiscard]] Theme rememberedTheme();

/// Whether letters are lighter than what they stand on.
[[nodiscard]] bool isDark(const QPalette& palette);

/// Adds the themes to a menu, of which one is on.
void addThemes(QMenu& menu);

} // namespace palp
