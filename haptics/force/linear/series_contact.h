#pragma once

#include "haptics/force/linear/half_space.h"

namespace palp
{

/// What a body adds to the displacement of its own surface at a place, over its contact modulus:
/// a load of F at p + x moves the surface at p + y by F / E* (constant + slope.(x + y)) more than
/// that of a half-space, and by (x'Ax + y'Ay) / 2 more where the body bends.
struct BodyCompliance
{
  double constant = 0.0; ///< E* G0 [1/m]; negative over a near support
  double slope = 0.0;    ///< length of E* b, along the surface [1/m^2]
  double bend = 0.0;     ///< E* tr A [1/m^3]
  double edge = 0.0;     ///< 1/D, one over the distance to the sharp edge that slope is of [1/m];
                         ///< 0: none is near
};

/// By how much the pressure of a round tip moves to the stiffer side: x (1 + x / D)^2 = R b f.
///
/// @param pull  R b f: radius of the tip, slope, force over E* [m]; 0 or more
/// @param edge  1/D, as in BodyCompliance [1/m]
/// @return      x [m]
/// @realtime    pure; no allocation, no lock, no exception
[[nodiscard]] double asideOf(double pull, double edge) noexcept;

/// What a body of its own compliance answers.
struct SeriesContact
{
  LinearContact contact; ///< stiffness as felt, with the body
  double local = 0.0; ///< depth that the tip has in the body, without what the body gives way [m]
  bool isBeyond = false; ///< the support is too near for so large a contact: the force is that of
                         ///< the deepest for which this holds
};

/// A contact on a half-space in series with the body.
///
/// With a slope the middle of the pressure moves to the stiffer side, by at most half of the
/// contact radius; beside an edge the constant falls on that way as one over the distance, as in a
/// wedge.
///
/// @param depth   of the tip [m], more than 0
/// @param radius  of the tip at its apex [m]; 0: sharp or flat, whose pressure is taken to stay
///                where it is
/// @source        d = d(a) + F (G0 + 4/15 a^2 tr A) - 2 F |b| x / (1 + x / D) + x^2 / (2 R), from
///                the complementary energy of the body, whose pressure is as a paraboloid's
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] SeriesContact inSeries(
  const HalfSpace& local, const BodyCompliance& body, double depth, double radius) noexcept;

} // namespace palp
