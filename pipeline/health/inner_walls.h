#pragma once

#include "pipeline/model/merged_mesh.h"

#include <cstddef>

namespace palp
{

/// Turns triangles alike across edges of two, and what ends at edges of more to where it sees
/// outside of the whole. A mesh whose triangles are alike across edges of two is left as it is.
///
/// @param mesh  each point once
/// @return      how many were turned
[[nodiscard]] std::size_t turnOutward(MergedMesh& mesh);

/// Leaves out triangles that no side joins to others: those without an area, and those that lie on
/// the rest, to a thousandth of their longest side, and are open.
///
/// @param mesh  each point once; stays a mesh
void dropHanging(MergedMesh& mesh);

/// Leaves out what bounds nothing and ends at edges of three triangles or more, where the rest is
/// whole without it: walls within a body, that have the rest on both of their sides, so that nobody
/// sees them from outside, and what lies on the rest.
///
/// Of several that could go, as the wall of a chamber and the part of the body's own that it
/// shares, the larger goes, so that the body stays whole.
///
/// @param mesh  each point once; stays a mesh
void dropInnerWalls(MergedMesh& mesh);

} // namespace palp
