#pragma once

#include "pipeline/tissue/tissue_map.h"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace palp
{

struct MeshSource;
class Surface;

/// A part of a body that has a map.
struct MappedPart
{
  const MeshSource* source;
  std::vector<Eigen::Vector3d> points; ///< of its surface, in the frame of its file [m]
};

/// The map of a body's stiffness, in the scene. What several say of a place, the first of them
/// does.
/// @param parts   of the body, in the order of their sources
/// @param body    with all its parts, in the scene
/// @return        empty where there are no parts
/// @throws Error  as tissueMapOf
[[nodiscard]] TissueMap placedMap(std::span<const MappedPart> parts, const Surface& body);

/// Tells the labels of the sources' label maps that are in a body and have no tissue, as the end of
/// a sentence; empty: there are none.
/// @param points  of the body, in the scene [m]
[[nodiscard]] std::string labelsWithoutTissue(
  const std::vector<MeshSource>& sources, std::span<const Eigen::Vector3d> points);

} // namespace palp
