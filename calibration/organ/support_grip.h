#pragma once

#include "calibration/organ/node_weights.h"

#include <Eigen/Core>
#include <span>

namespace palp
{

/// A support on the surface in one cube: its mean displacement is held, not that of nodes beside.
struct SupportGrip
{
  NodeWeights weights{}; ///< sums over the area until this is divided by
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double area = 0.0;
  Eigen::Vector3d along = Eigen::Vector3d::Zero(); ///< as of its support

  void add(const NodeWeights& more, const Eigen::Vector3d& middle, double part);
  void divide();

  /// Of what is held.
  [[nodiscard]] Eigen::Matrix3d direction() const;
};

/// @param size    of the body [m]
/// @throws Error  BadValue: they leave a motion free, and which
void checkHeld(std::span<const SupportGrip> grips, double size);

} // namespace palp
