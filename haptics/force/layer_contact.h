#pragma once

#include "haptics/force/coated_body.h"
#include "haptics/force/contact_table.h"
#include "haptics/force/half_space.h"
#include "haptics/force/layer.h"

#include <variant>

namespace palp
{

/// Exact linear solution for a rigid frictionless tip on a layer, coated or of one material, with a
/// curved surface.
///
/// The curvature of the surface widens the gap by r^2 / 2 R0, which adds a^2 / R0 to the depth
/// of contact; it stands for the surface near the tip, not for the shape of the whole body.
///
/// @source Lebedev and Ufliand 1958 (layer); Sneddon 1965, linear in the gap (curvature)
class LayerContact
{
public:
  LayerContact(const Tip& tip, double poissonRatio, Base base);

  /// The same tip on a coated body.
  /// @throws Error  as CoatedBody
  [[nodiscard]] LayerContact coated(
    const Coatings& coatings, const Material& body, Base base) const;

  /// @param depth      delta [m], more than 0
  /// @param thickness  of the body [m], more than 0; infinite for a half-space
  /// @param curvature  of the surface, 1/R0 [1/m], convex positive; see allowedCurvature()
  /// @realtime         pure; no allocation, no lock, no exception
  [[nodiscard]] LinearContact operator()(
    double depth, double thickness, double curvature) const noexcept;

  /// The curvature that is applied: half the hollowness at which the tip no longer touches with
  /// its apex first is the most, and a flat tip takes none.
  [[nodiscard]] double allowedCurvature(double curvature) const noexcept;

private:
  /// The contact while the half-space would be in contact on the same circle at halfSpaceDepth.
  struct Trial
  {
    double depth;   // at which this is the true contact [m]
    double radius;  // a [m]
    double uniform; // A [m]
    double shape;   // B [m^2]
  };

  [[nodiscard]] PunchSolution solution(double radius, double thickness) const noexcept;
  [[nodiscard]] Trial trial(
    double halfSpaceDepth, double thickness, double curvature) const noexcept;

  ContactTable table_;
  std::variant<Layer, CoatedBody> body_;
  double mostHollow_; // [1/m], 0 or more
};

} // namespace palp
