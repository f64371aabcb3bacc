#pragma once

#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"

#include <QWidget>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace palp
{

/// Tool, tissue and device with their units; says when any of them changed.
class TissuePanel : public QWidget
{
  Q_OBJECT

public:
  /// @param devices  names for the device list; the first is selected
  TissuePanel(const Scene& scene, const QStringList& devices, QWidget* parent = nullptr);

  [[nodiscard]] ForceLaw law() const;
  [[nodiscard]] ContactRule rule() const;
  [[nodiscard]] double damping() const; ///< b [N s/m]

  /// What the device does now; the button follows what the session says.
  void showDevice(const Sample& sample, bool rendersForce, bool armed);

Q_SIGNALS:
  void tissueChanged();
  void armAsked(bool armed);
  void deviceChanged(const QString& name);

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
  QComboBox* device_;
  QPushButton* arm_;
  QLabel* state_;
};

} // namespace palp
