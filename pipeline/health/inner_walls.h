#pragma once

#include "pipeline/model/merged_mesh.h"

namespace palp
{

/// Leaves out walls within a body: what ends on every side at edges of three triangles or more, and
/// has the rest of the body on both of its sides, so that nobody sees it from outside.
///
/// Of several that could go, as the wall of a chamber and the part of the body's own that it
/// shares, the larger goes, so that the body stays whole.
///
/// @param mesh  each point once; stays a mesh
void dropInnerWalls(MergedMesh& mesh);

} // namespace palp
