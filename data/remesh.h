#pragma once

#include "data/implicit.h"
#include "data/shapes.h"

namespace palp
{

/// Closed surface of even, nearly equilateral triangles over the zero of a distance function.
///
/// Edges are split, collapsed and flipped, points relaxed along the surface and drawn back to it.
///
/// @param mesh      closed and 2-manifold, near the zero of the distance
/// @param edge      wanted edge length [m], below the radii of curvature
/// @return          same topology; points on the zero
/// @source          Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling", 2004
[[nodiscard]] Mesh remesh(const Mesh& mesh, double edge, const Distance& distance);

} // namespace palp
