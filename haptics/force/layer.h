#pragma once

#include <array>
#include <vector>

namespace palp
{

/// How the body is held below.
enum class Base
{
  Bonded, ///< glued to something rigid
  Slip,   ///< on something rigid, without friction
};

/// Linear elastic layer on a rigid base, in the form that gives the force of any tip.
///
/// phi(x) solves Lebedev and Ufliand's integral equation for a flat punch of radius a = 1 at
/// depth 1, x = s / a. A half-space has phi = 1. With it, for the contact radius a,
///   F = 2 E* (depth A - B),  A = a int_0^1 phi dx,  B = a int_0^1 g(a x) phi dx,
/// and F is stationary in a, which gives the contact radius.
///
/// @source Lebedev and Ufliand 1958; the kernels: Dhaliwal and Rau 1970, Popov and Hess 2015
class Layer
{
public:
  static constexpr int kTerms = 4;
  static constexpr double kWidest = 3.0; ///< a / thickness; wider, the terms go on as lines

  struct Terms
  {
    std::array<double, kTerms> value{ 1.0 }; ///< c_k of phi = sum c_k x^(2k) [-]
    std::array<double, kTerms> slope{};      ///< d c_k / d(a / thickness) [-]
  };

  /// @param poissonRatio  nu, 0 to 0.5
  Layer(double poissonRatio, Base base);

  /// @param width  a / thickness, 0 or more
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Terms operator()(double width) const noexcept;

private:
  std::vector<Terms> rows_;
};

} // namespace palp
