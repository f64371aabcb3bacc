#pragma once

#include "haptics/force/linear/coated_body.h"
#include "haptics/force/linear/contact_table.h"
#include "haptics/force/linear/half_space.h"
#include "haptics/force/linear/layer.h"

#include <optional>
#include <variant>

namespace palp
{

/// Fraction of a ball in the shape of a body: 0 where its surface is flat or hollow, 1 where it
/// bends so much that it closes within the thickness.
/// @param thickness  [m], more than 0; infinite where it is not known
/// @param curvature  of the surface [1/m], convex positive
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] double fractionOfBall(double thickness, double curvature) noexcept;

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

  /// The curvature that is applied: as it is to half the hollowness at which the tip no longer
  /// touches with its apex first, then leveling off at 0.6 of that; a flat tip takes none.
  [[nodiscard]] double allowedCurvature(double curvature) const noexcept;

  /// Thickness of the flat layer that holds the tool up as much as a body of this thickness whose
  /// surface bends away.
  ///
  /// A flat layer's base reaches far to the sides; a ball's does not. The far field of the force,
  /// seen from the middle of a ball of radius R0, shortens the depth by
  /// (3 - 2 nu) / (4 pi (1 - nu)) F / (E* R0) where the ball is held at its middle, by nothing
  /// where it rests freely: half of that stands for a support that is not known. Bodies between a
  /// flat one and a ball, by the fraction of a ball, take it in proportion.
  ///
  /// @param thickness  [m], more than 0; infinite for a half-space
  /// @source           Boussinesq, u_z on the axis 2 R0 below the load, which Tatara 1991 takes for
  ///                   the opposite pole of a ball between plates
  /// @realtime         pure; no allocation, no lock, no exception
  [[nodiscard]] double layerThickness(double thickness, double curvature) const noexcept;

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
  // nothing where steps do not get there: the base is in contact, or the surface as hollow as may
  // be
  [[nodiscard]] std::optional<LinearContact> onHalfSpace(
    double depth, double curvature) const noexcept;
  [[nodiscard]] Trial trial(
    double halfSpaceDepth, double thickness, double curvature) const noexcept;

  ContactTable table_;
  std::variant<Layer, CoatedBody> body_;
  double mostHollow_ = 0.0; // [1/m], 0 or more
  double ball_ = 0.0; // of a ball: its thickness over that of the layer that stands for it [-]
};

} // namespace palp
