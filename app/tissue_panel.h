#pragma once

#include "haptics/servo/scene.h"

#include <QWidget>

class QComboBox;
class QDoubleSpinBox;

namespace palp
{

/// Tool and tissue with their units; says when any of them changed.
class TissuePanel : public QWidget
{
  Q_OBJECT

public:
  explicit TissuePanel(const Scene& scene, QWidget* parent = nullptr);

  [[nodiscard]] ForceLaw law() const;
  [[nodiscard]] ContactRule rule() const;
  [[nodiscard]] double damping() const; ///< b [N s/m]

Q_SIGNALS:
  void tissueChanged();

private:
  void showAngleForConesOnly();

  LawSettings settings_; // from the command line, too
  Tip other_;            // a tool from the command line that the panel has no fields for
  QComboBox* kind_;
  QDoubleSpinBox* radiusMm_;
  QDoubleSpinBox* halfAngleDeg_;
  QDoubleSpinBox* modulusKpa_;
  QDoubleSpinBox* poisson_;
  QDoubleSpinBox* damping_;
  QComboBox* rule_;
};

} // namespace palp
