#pragma once

#include <vector>

namespace palp
{

/// Factor on the force of a round tip where the surface curves differently in two directions,
/// over the force on a surface of their mean curvature at the same depth.
///
/// @source Hertz 1882; Johnson 1985, Sec. 4.2
class EllipseFactor
{
public:
  /// Spread beyond which the factor stays: the contact is 2.6 times as long as wide, and no longer
  /// on the part of a body that its curvature at one place describes.
  static constexpr double kSlimmest = 0.6;

  EllipseFactor();

  /// @param spread  (B - A) / (B + A) of the gap A x^2 + B y^2, 0 (circle) to kSlimmest
  /// @return        [-], 1 for a circle and more for an ellipse
  /// @realtime      pure; no allocation, no lock, no exception
  [[nodiscard]] double operator()(double spread) const noexcept;

private:
  std::vector<double> spreads_;
  std::vector<double> factors_;
  std::vector<double> slopes_;
};

} // namespace palp
