#pragma once

#include "pipeline/view/appearance.h"

#include <QWidget>

#include <array>

class QLabel;
class QLineEdit;
class QPushButton;

namespace palp
{

/// Of bonded and of sliding, apart on tissue for every kind of color vision.
inline constexpr std::array<appearance::Color, 2> kSupportColors{ appearance::kCurves[0],
  appearance::kNet };

class ChoiceBox;
class QuantityBox;

/// Where a body rests, to be painted or typed, and solved. Changes nothing by itself.
class SupportPanel : public QWidget
{
  Q_OBJECT

public:
  explicit SupportPanel(QWidget* parent = nullptr);

  /// In the order of the list.
  enum Brush
  {
    Bonded,
    Sliding,
    Erase
  };
  [[nodiscard]] Brush brush() const;
  [[nodiscard]] double radius() const; ///< of the brush [m]
  [[nodiscard]] double cell() const;   ///< side of the cubes to solve by [m]
  [[nodiscard]] bool paints() const;
  void endPainting();

  /// Supports that are not painted, as text.
  void showOthers(const QString& supports);

  /// How much of the surface each kind holds [m^2]; the legend of the picture.
  void showAreas(const std::array<double, 2>& areas);

Q_SIGNALS:
  void paintToggled(bool paints);
  void clearAsked();
  void othersChanged(const QString& supports);
  void solveAsked();

private:
  ChoiceBox* brush_;
  QuantityBox* radius_;
  QLineEdit* others_;
  QuantityBox* cell_;
  QPushButton* paint_;
  QPushButton* clear_;
  QPushButton* solve_;
  QLabel* legend_;
};

} // namespace palp
