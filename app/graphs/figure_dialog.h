#pragma once

#include "app/input/scene_plan.h"
#include "app/plots/press_figure.h"

#include <QFileDialog>

#include <utility>
#include <vector>

class QCheckBox;
class QComboBox;

namespace palp
{

/// Asks for a file to draw a figure into, and for its size.
class FigureDialog : public QFileDialog
{
  Q_OBJECT

public:
  /// @param suggested  name of a new file
  /// @param kinds      of files, as QFileDialog takes them
  /// @param usual      size that is offered first
  FigureDialog(const QString& title, const QString& suggested, const QString& kinds,
    ImageSize usual, QWidget* parent = nullptr);

  /// Adds what a figure of a press may have beside it.
  void offerParts(const FigureLook& usual);

  /// Those that were chosen; without overlays the colors of the dent stay.
  [[nodiscard]] FigureLook look() const;

  /// Both once it is accepted.
  [[nodiscard]] QString file() const
  {
    return selectedFiles().value(0);
  }
  [[nodiscard]] ImageSize size() const
  {
    return size_;
  }

  void accept() override;

private:
  QComboBox* sizes_;
  ImageSize size_;
  FigureLook usual_;
  std::vector<std::pair<QCheckBox*, bool FigureLook::*>> parts_;
  QCheckBox* overlays_ = nullptr; // null: no parts are offered
};

} // namespace palp
