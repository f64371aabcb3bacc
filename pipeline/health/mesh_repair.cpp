#include "pipeline/health/mesh_repair.h"

#include "haptics/surface/edges.h"
#include "pipeline/health/fill_holes.h"
#include "pipeline/health/slivers.h"
#include "pipeline/health/split_mesh.h"
#include "pipeline/model/merged_mesh.h"
#include "pipeline/surface_io/surface_facing.h"

#include <utility>

namespace palp
{
namespace
{

// @return  triangles that were turned
std::size_t turnAlike(RepairedMesh& mesh)
{
  const Facing facing =
    facingOf(mesh.points, mesh.triangles, edgesOf(mesh.points.size(), mesh.triangles));
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (facing.turn[i])
    {
      std::swap(mesh.triangles[i][0], mesh.triangles[i][2]);
      ++count;
    }
  }
  return count;
}

} // namespace

RepairedMesh repairedMesh(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, double largestHole)
{
  MergedMesh merged = mergedMesh(points, triangles);
  const std::vector<bool> repeated = repeatedTriangles(merged.triangles);
  std::size_t i = 0;
  std::erase_if(merged.triangles, [&](const Triangle&) { return repeated[i++]; });
  RepairedMesh result{ .points = std::move(merged.points),
    .triangles = std::move(merged.triangles) };
  result.merged = points.size() - result.points.size();
  result.removed = triangles.size() - result.triangles.size();
  result.turned = turnAlike(result);
  result.split = splitNonManifold(result.points, result.triangles);
  result.slivers = removeSlivers(result.points, result.triangles);
  result.filled = fillHoles(result.points, result.triangles, largestHole);
  result.turned += turnAlike(result); // what is closed now
  return result;
}

} // namespace palp
