#pragma once

namespace palp
{

/// Isotropic, linearly elastic half-space.
struct Material
{
  double youngModulus; ///< E [Pa], 1 Pa to 10 GPa
  double poissonRatio; ///< nu [-], 0 to 0.5

  /// G = E / (2 (1 + nu)) [Pa].
  [[nodiscard]] constexpr double shearModulus() const noexcept
  {
    return youngModulus / (2.0 * (1.0 + poissonRatio));
  }

  /// E* = E / (1 - nu^2) [Pa], the plane-strain modulus under a rigid tool.
  [[nodiscard]] constexpr double contactModulus() const noexcept
  {
    return youngModulus / (1.0 - poissonRatio * poissonRatio);
  }
};

/// A material whose values were checked.
///
/// @param youngModulus  E [Pa], 1 to 1e10
/// @param poissonRatio  nu [-], 0 to 0.5, 0.5 included
/// @throws Error        BadValue: outside its range, or not a number
[[nodiscard]] Material makeMaterial(double youngModulus, double poissonRatio);

} // namespace palp
