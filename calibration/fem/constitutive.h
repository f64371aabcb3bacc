#pragma once

#include "haptics/material.h"

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace palp::fem
{

/// Strain energy of the tissue; two that share E and nu differ once strains are large.
enum class StrainEnergy
{
  Linear,     ///< small strain, the gap taken at the undeformed radius: the limit of theory
  Corotated,  ///< mu |F - R|^2 + lambda/2 (tr U - 3)^2; what the paper's program calls linear
  NeoHookean, ///< mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2
  NeoHookeanIsochoric, ///< mu/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2
};

/// The name on the command line and in files: linear, corotated, neo-hookean,
/// neo-hookean-isochoric.
[[nodiscard]] std::string_view name(StrainEnergy energy) noexcept;

/// The formula, for the head of a table.
[[nodiscard]] std::string_view formula(StrainEnergy energy) noexcept;

/// @return  nothing where no energy has that name
[[nodiscard]] std::optional<StrainEnergy> energyNamed(std::string_view name) noexcept;

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// The columns of a matrix, one below the other.
[[nodiscard]] inline Vector9d vec(const Eigen::Matrix3d& m)
{
  return Eigen::Map<const Vector9d>(m.data());
}

/// First Piola-Kirchhoff stress P = dW/dF, and its derivative.
///
/// W holds U(theta), the energy of the change of volume theta(F); p = U' is its part of P per
/// d theta/dF. Under large strain theta is not linear in F: near nu = 0.5 its curvature times p is
/// what a Newton step goes wrong by.
struct StressResponse
{
  double energy;          ///< W [J/m^3]
  Eigen::Matrix3d stress; ///< P [Pa]
  Matrix9d tangent;       ///< dP/dF [Pa] over column-major vec(P), vec(F); symmetric

  double pressure = 0.0;                   ///< p [Pa], of tension
  double bulk = 0.0;                       ///< dp/dtheta [Pa]
  Vector9d volumeSlope = Vector9d::Zero(); ///< dtheta/dF
  Matrix9d volumeBend = Matrix9d::Zero();  ///< d2theta/dF2
};

/// @param gradient  F = I + grad u, det F > 0 (any F for Linear)
/// @param material  nu < 0.5
/// @source          Bonet and Wood 2008, Secs. 6.4 and 6.5; McAdams et al. 2011 for dR/dF
[[nodiscard]] StressResponse evaluate(
  StrainEnergy energy, const Material& material, const Eigen::Matrix3d& gradient);

} // namespace palp::fem
