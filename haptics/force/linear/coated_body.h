#pragma once

#include "haptics/force/linear/coating.h"
#include "haptics/force/linear/layer.h"

#include <vector>

namespace palp
{

/// How far a surface gives way under a pressure p cos(k x): its deflection over 2 p / (E* k), that
/// of a half-space of the uppermost material.
///
/// @param wavenumber  k [1/m], more than 0
/// @param coatings    from the surface down; at least one
/// @param body        what lies below them
/// @param thickness   of the body without its coatings [m]: infinite, or down to the base; 0: the
///                    coatings lie on the base
/// @return            [-]; 1 for a large k, E* of the uppermost over that of the body for a small
///                    one on a half-space, 0 for a small one on a base
/// @source            the general solution of plane strain in each sheet, joined from below; two
///                    sheets: Burmister 1943
[[nodiscard]] double surfaceCompliance(double wavenumber, std::span<const Coating> coatings,
  const Material& body, double thickness, Base base);

/// Whether a flat punch would have to pull somewhere in the inner half of its face, from which a
/// stiff coating bends away. Beside the edge a pull lifts it by less than a thousandth of the
/// depth.
///
/// @param radius  of the punch [m], not more than 200 times the uppermost coating
/// @source        Sneddon 1966: p(r) of phi
[[nodiscard]] bool pullsUnderPunch(
  const Coatings& coatings, const Material& body, Base base, double radius);

/// Linear elastic body under coatings, on a rigid base or without end: the solution phi of Layer
/// for it, for contacts to a largest radius.
class CoatedBody
{
public:
  static constexpr double kMinThickness = 0.005;   ///< uppermost coating, over the widest contact
  static constexpr double kMinBodyThickness = 0.2; ///< below the coatings, as well
  static constexpr double kStiffest = 20.0; ///< E* of a coating, over that of the softest below it;
                                            ///< stiffer, the contact is no longer a single circle
  static constexpr double kSoftest = 0.001;

  /// @param coatings  at least one
  /// @param widest    radius of the widest contact, the tip's base [m]
  /// @throws Error    BadValue: the uppermost coating is thinner than kMinThickness of the widest
  ///                  contact, or one is stiffer than kStiffest or softer than kSoftest
  CoatedBody(const Coatings& coatings, const Material& body, Base base, double widest);

  /// @param radius     a [m], 0 to the widest
  /// @param thickness  of the body with its coatings [m]; below them at least kMinBodyThickness is
  ///                   taken
  /// @return           phi, relative to a half-space of the body; slopes by the radius [1/m]
  /// @realtime         pure; no allocation, no lock, no exception
  [[nodiscard]] PunchSolution operator()(double radius, double thickness) const noexcept;

private:
  static constexpr int kRadii = 81;
  static constexpr int kThicknesses = 21; // of the body alone, the first without end
  [[nodiscard]] static std::size_t indexOf(int radius, int thickness) noexcept
  {
    return static_cast<std::size_t>(radius) * kThicknesses + static_cast<std::size_t>(thickness);
  }

  [[nodiscard]] Eigen::MatrixXd deficitsAt(const std::vector<double>& wavenumbers,
    const Coatings& coatings, const Material& body, Base base) const;

  double coatings_;                 // thickness of all [m]
  double widest_;                   // [m]
  double uppermost_;                // thickness [m]
  double radiusStep_;               // in asinh(a / uppermost)
  double thicknessStep_;            // in asinh(widest / thickness)
  std::vector<PunchSolution> rows_; // of each radius, the thickness running fastest
};

} // namespace palp
