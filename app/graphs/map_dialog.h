#pragma once

#include "app/map/stiffness_map.h"

#include <QDialog>

class QLabel;
class QRadioButton;

namespace palp
{

class QuantityBox;

/// Asks where, how deep and how densely to press for a map of stiffness.
class MapDialog : public QDialog
{
  Q_OBJECT

public:
  /// @param usual  is offered first
  /// @param last   place of the last press [m]; none: only the whole surface can be mapped
  MapDialog(const MapRequest& usual, const std::optional<Eigen::Vector3d>& last, QWidget* parent);

  /// Once it is accepted.
  [[nodiscard]] MapRequest request() const;

  void accept() override;

private:
  std::optional<Eigen::Vector3d> last_;
  QuantityBox* depth_;
  QuantityBox* spacing_;
  QuantityBox* radius_;
  QRadioButton* isRegion_;
};

} // namespace palp
