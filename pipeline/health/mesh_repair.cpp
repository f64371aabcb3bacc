#include "pipeline/health/mesh_repair.h"

#include "haptics/surface/edges.h"
#include "pipeline/health/fill_holes.h"
#include "pipeline/health/slivers.h"
#include "pipeline/health/split_mesh.h"
#include "pipeline/model/merged_mesh.h"
#include "pipeline/surface_io/surface_facing.h"

#include <algorithm>
#include <map>
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

// Bodies of one closed surface that share faces, there once each way: they bound nothing, and one
// alone would be a wall within the body.
void dropSharedFaces(MergedMesh& mesh)
{
  if (edgesOf(mesh.points.size(), mesh.triangles).unbalanced > 0)
  {
    return; // whether it encloses anything is not known
  }
  std::map<Triangle, std::vector<std::size_t>> facing; // by the corners from the lowest on
  std::vector<bool> shared(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    Triangle own = mesh.triangles[i];
    std::ranges::rotate(own, std::ranges::min_element(own));
    const auto other = facing.find({ own[0], own[2], own[1] });
    if (other == facing.end() || other->second.empty())
    {
      facing[own].push_back(i);
      continue;
    }
    shared[i] = shared[other->second.back()] = true;
    other->second.pop_back();
  }
  if (std::ranges::count(shared, false) > 0) // else a sheet of two sides, which is all there is
  {
    std::size_t i = 0;
    std::erase_if(mesh.triangles, [&](const Triangle&) { return shared[i++]; });
  }
}

} // namespace

RepairedMesh repairedMesh(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, double largestHole)
{
  MergedMesh merged = mergedMesh(points, triangles);
  dropSharedFaces(merged);
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
