#pragma once

#include <QScrollArea>

namespace palp
{

/// Rows of the least screen that the whole window has to fit on, however large the one in use is.
inline constexpr int kLeastScreen = 768;

/// Shows all of the width of a panel, and as much of its height as there is room.
/// @param content  becomes the area's
void scrollDownOnly(QScrollArea& area, QWidget* content);

/// A panel in a dock: as high as what it shows where there is room; scrolled where there is not.
class PanelArea : public QScrollArea
{
public:
  /// @param content  becomes the area's
  explicit PanelArea(QWidget* content);

protected:
  bool eventFilter(QObject* object, QEvent* event) override;

private:
  void fit();
};

} // namespace palp
