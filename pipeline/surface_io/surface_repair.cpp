#include "pipeline/surface_io/surface_repair.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/edges.h"
#include "haptics/surface/tree/box_tree.h"
#include "pipeline/model/merged_mesh.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_facing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{

namespace
{

void warnOfEdges(const Edges& edges, std::vector<std::string>& warnings)
{
  const std::size_t open = edges.unpaired.size() - edges.crowded;
  if (edges.crowded > 0)
  {
    warnings.push_back("not a manifold: " + counted(edges.crowded, "edge has", "edges have") +
      " more than two triangles; forces near there may be wrong");
  }
  if (open > 0)
  {
    warnings.push_back("open: " + counted(open, "edge has", "edges have") +
      " one triangle only; press it from the front");
  }
}

} // namespace

RepairedSurface repair(std::span<const Eigen::Vector3d> filePoints,
  std::span<const Triangle> fileTriangles, const std::string& name, bool isLevel)
{
  RepairedSurface result;
  MergedMesh mesh = mergedMesh(filePoints, fileTriangles);
  if (const std::size_t dropped = fileTriangles.size() - mesh.triangles.size(); dropped > 0)
  {
    result.notes.push_back(
      counted(dropped, "triangle whose corners coincide", "triangles whose corners coincide") +
      " dropped");
  }
  if (std::ranges::none_of(
        mesh.triangles, [&](const Triangle& t) { return !unitNormal(mesh.points, t).isZero(); }))
  {
    throw Error(ErrorCode::BadMesh, name + ": no triangle has an area; export the surface again");
  }

  const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
  result.closed = edges.unpaired.empty();
  warnOfEdges(edges, result.warnings);
  const Facing facing = isLevel ? Facing{} : facingOf(mesh.points, mesh.triangles, edges);
  if (facing.twisted)
  {
    result.closed = false;
    result.warnings.emplace_back(
      "it cannot be oriented: one side goes over into the other, as of a "
      "Moebius strip, so inside and outside are not told apart; repair the "
      "mesh");
  }
  std::size_t changed = 0;
  for (std::size_t i = 0; i < facing.turn.size(); ++i)
  {
    if (facing.turn[i])
    {
      std::swap(mesh.triangles[i][0], mesh.triangles[i][2]);
      ++changed;
    }
  }
  if (changed > 0)
  {
    result.notes.push_back(counted(changed, "triangle") +
      (result.closed ? " turned to face outwards" : " turned to face as their neighbors"));
  }
  if (facing.cavities > 0)
  {
    result.notes.push_back(counted(facing.cavities, "closed piece") +
      " within another, facing the other way: taken for hollow");
  }
  if (facing.inner > 0)
  {
    result.notes.push_back(counted(facing.inner, "closed piece") +
      " within another, facing as it does: left out, as a part of it");
    mesh = mergedWithout(mesh.points, mesh.triangles, facing.within);
  }
  result.mesh = makePolyData(mesh.points, mesh.triangles);
  return result;
}

} // namespace palp
