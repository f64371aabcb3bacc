#pragma once

#include "haptics/numerics/quadrature.h"

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palp
{

/// The solution phi(x), x = s / a, for a flat punch of radius a at depth 1, from which the force of
/// any tip follows.
///
/// A half-space has phi = 1. For the contact radius a,
///   F = 2 E* (depth A - B),  A = a int_0^1 phi dx,  B = a int_0^1 g(a x) phi dx,
/// and F is stationary in a, which gives the contact radius.
struct PunchSolution
{
  static constexpr int kTerms = 4;

  std::array<double, kTerms> value{ 1.0 }; ///< c_k of phi = sum c_k x^(2k) [-]
  std::array<double, kTerms> slope{};      ///< d c_k by the width that the solutions run over
};

/// Lebedev and Ufliand's integral equation, for any body that is alike in all places.
/// @source Lebedev and Ufliand 1958
class PunchEquation
{
public:
  /// @param wavenumbers  k of the integral over the surface's compliance [1/m, or over a length];
  ///                     the largest first saves work
  /// @param nodes       at which it is solved; more than the widest a times the largest k over 20
  PunchEquation(Quadrature wavenumbers, int nodes);

  [[nodiscard]] const std::vector<double>& wavenumbers() const noexcept
  {
    return wavenumbers_.nodes;
  }

  /// The punch whose equation is solved.
  /// @param radius  a, in the length of the wavenumbers
  void setRadius(double radius);

  /// @param deficit  1 - L(k) at each wavenumber, L the compliance over that of a half-space; the
  ///                 kernel of a sum is the sum of the kernels
  [[nodiscard]] Eigen::MatrixXd kernel(const Eigen::VectorXd& deficit) const;

  /// @return  phi at nodes()
  [[nodiscard]] Eigen::VectorXd phi(const Eigen::MatrixXd& kernel) const;

  /// @return  x, rising
  [[nodiscard]] const std::vector<double>& nodes() const noexcept
  {
    return nodes_.nodes;
  }

  /// @return  c_k; least squares, which keeps the integrals of phi and of x^2 phi exact
  [[nodiscard]] std::array<double, PunchSolution::kTerms> solve(
    const Eigen::MatrixXd& kernel) const;

private:
  Quadrature wavenumbers_;
  Quadrature nodes_; // x
  Eigen::MatrixXd fit_;
  Eigen::MatrixXd cosines_; // places x wavenumbers
  double radius_ = 0.0;
};

/// Gives solutions at equal steps of the width their slopes.
/// @param series  this many take turns: those of the first width come first
void setSlopes(std::span<PunchSolution> solutions, std::size_t series, double step);

/// @param fraction  0 to 1, from one solution to the next
/// @param step      of the width between them
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] PunchSolution between(
  const PunchSolution& low, const PunchSolution& high, double step, double fraction) noexcept;

} // namespace palp
