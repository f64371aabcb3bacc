#pragma once

#include "pipeline/tissue/tissue_map.h"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace palp
{

struct MeshSource;

/// The map of a source's stiffness, in the scene. What several say of a place, the first of them
/// does.
/// @param points  of the surface, in the frame of its file [m]
/// @param before  of the sources before it; empty: none
/// @throws Error  as tissueMapOf
[[nodiscard]] TissueMap placedMap(
  const MeshSource& source, std::span<const Eigen::Vector3d> points, TissueMap before);

/// Tells the labels of the sources' label maps that are in a body and have no tissue, as the end of
/// a sentence; empty: there are none.
/// @param points  of the body, in the scene [m]
[[nodiscard]] std::string labelsWithoutTissue(
  const std::vector<MeshSource>& sources, std::span<const Eigen::Vector3d> points);

} // namespace palp
