#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <span>

namespace palp
{

struct HalfEdgeTraits : OpenMesh::DefaultTraits
{
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

/// Points that no triangle has, and triangles of fewer than three points, are left out.
/// @throws Error  BadMesh: as decimated
[[nodiscard]] HalfEdges halfEdgesOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);

} // namespace palp
