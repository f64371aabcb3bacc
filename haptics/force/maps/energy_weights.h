#pragma once

#include "haptics/force/nodules/homogeneous_press.h"

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

namespace palp
{

/// Where in the tissue the energy of a press lies: what each place counts for the force where the
/// stiffness is not the same everywhere.
///
/// The weight at a place is the product of the strain and its rate in the stress of the tissue,
/// over the force; over the whole body it sums to 1. Weights are kept at places around the axis,
/// finer near the contact, for every knot of the press.
class EnergyWeights
{
public:
  /// What a tool feels of a stiffness that varies, at each knot of the press.
  struct Means
  {
    std::vector<double> logs;    ///< of the modulus that acts, over what was given [-]
    std::vector<double> spreads; ///< geometric over harmonic mean, less 1 [-]
    double known = 0.0;          ///< least part of the energy where the stiffness is known [-]
  };

  explicit EnergyWeights(const HomogeneousPress& press);

  /// Sums of the weights at each knot before they were scaled to 1 [-].
  [[nodiscard]] std::span<const double> sums() const noexcept
  {
    return sums_;
  }

  /// @param ratio   Young's modulus over that of the press, above 0, at a place: x and y from the
  ///                axis, z below the surface [m]; not finite where it is not known, which does not
  ///                count
  /// @return        m_geo^0.65 m_har^0.35 of the weighted geometric and harmonic means
  /// @source        energy of first order, the exponents fitted to linear finite elements: 40 cases
  ///                of layers, skins, cylinders and a gradient to 4.2 %
  [[nodiscard]] Means means(const std::function<double(const Eigen::Vector3d&)>& ratio) const;

private:
  std::vector<Eigen::Vector3d> places_; // ring by ring around the axis [m]
  std::vector<std::size_t> ends_;       // of each ring
  Eigen::MatrixXd weights_;             // of the rings, for each knot a row
  std::vector<double> sums_;
};

} // namespace palp
