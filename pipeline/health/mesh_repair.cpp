#include "pipeline/health/mesh_repair.h"

#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "haptics/threads/followed_work.h"
#include "pipeline/health/fill_holes.h"
#include "pipeline/health/inner_walls.h"
#include "pipeline/health/slivers.h"
#include "pipeline/health/split_mesh.h"
#include "pipeline/health/t_junctions.h"
#include "pipeline/health/weld_seams.h"
#include "pipeline/model/merged_mesh.h"
#include "pipeline/surface_io/surface_facing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace palp
{
namespace
{

Facing facingOf(const RepairedMesh& mesh)
{
  return facingOf(mesh.points, mesh.triangles, edgesOf(mesh.points.size(), mesh.triangles));
}

void turnAlike(RepairedMesh& mesh, const Facing& facing)
{
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (facing.turn[i])
    {
      std::swap(mesh.triangles[i][0], mesh.triangles[i][2]);
      ++mesh.turned;
    }
  }
}

// what is a part of another piece, as it is left out where the file is pressed
void dropInner(RepairedMesh& mesh, const Facing& facing)
{
  if (facing.inner > 0)
  {
    MergedMesh rest = mergedWithout(mesh.points, mesh.triangles, facing.within);
    mesh.removed += mesh.triangles.size() - rest.triangles.size();
    mesh.points = std::move(rest.points);
    mesh.triangles = std::move(rest.triangles);
  }
}

// Where bodies of one closed surface touch or overlap, what has the body on both sides bounds
// nothing. It goes where the rest is closed: else the walls cross, which stays and is told.
void dropBuried(MergedMesh& mesh)
{
  const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
  const BoxTree tree(mesh.points, mesh.triangles);
  if (edges.unbalanced > 0 || tree.empty())
  {
    return;
  }
  std::vector<bool> isOut(mesh.triangles.size());
  for (const int buried : buriedTriangles(tree, piecesOf(edges.across)))
  {
    isOut[at(buried)] = true;
  }
  MergedMesh boundary = mergedWithout(mesh.points, mesh.triangles, isOut);
  if (!boundary.triangles.empty() &&
    edgesOf(boundary.points.size(), boundary.triangles).unbalanced == 0)
  {
    mesh = std::move(boundary);
  }
}

// turned: whether also those that face the other way
void dropRepeated(MergedMesh& mesh, bool turned)
{
  const std::vector<bool> repeated = repeatedTriangles(mesh.triangles, turned);
  std::size_t i = 0;
  std::erase_if(mesh.triangles, [&](const Triangle&) { return repeated[i++]; });
}

RepairedMesh repairedOnce(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, double largestHole)
{
  MergedMesh merged = mergedMesh(points, triangles);
  const WeldedSeams seams = weldSeams(merged.points, merged.triangles);
  if (seams.isSewn)
  {
    merged = mergedMesh(merged.points, merged.triangles);
  }
  checkWanted();
  dropHanging(merged);
  const std::size_t turned = turnOutward(merged);
  dropRepeated(merged, false); // before cuts, which it hides, and what is buried
  const std::size_t cut = cutAtTJunctions(merged.points, merged.triangles);
  dropBuried(merged);
  dropRepeated(merged, true);
  dropInnerWalls(merged);
  RepairedMesh result{ .points = std::move(merged.points),
    .triangles = std::move(merged.triangles) };
  result.merged = points.size() - result.points.size();
  result.removed = triangles.size() + cut - result.triangles.size();
  result.cut = cut;
  result.turned = turned;
  result.seamsLeft = seams.left;
  checkWanted();
  const Facing facing = facingOf(result);
  turnAlike(result, facing);
  dropInner(result, facing);
  if (result.merged + result.removed + result.cut > 0)
  {
    return result; // by which more may meet: until all does, no hole is one, and nothing is parted
  }
  // first, for holes that meet at a point would be one where it is split
  const auto [filled, crossing, unfit] = fillHoles(result.points, result.triangles, largestHole);
  const auto [split, splitLeft] = splitNonManifold(result.points, result.triangles);
  const auto [slivers, sliversLeft] = removeSlivers(result.points, result.triangles);
  result.split = split;
  result.splitLeft = splitLeft;
  result.slivers = slivers;
  result.sliversLeft = sliversLeft;
  result.filled = filled;
  result.holesLeft = crossing;
  result.holesUnfit = unfit;
  turnAlike(result, facingOf(result)); // what is closed now
  if (splitLeft > 0)                   // in files they are one
  {
    merged = mergedMesh(result.points, result.triangles);
    result.points = std::move(merged.points);
    result.triangles = std::move(merged.triangles);
  }
  return result;
}

constexpr std::array kDone{ &RepairedMesh::merged, &RepairedMesh::removed, &RepairedMesh::slivers,
  &RepairedMesh::split, &RepairedMesh::cut, &RepairedMesh::filled, &RepairedMesh::turned };

bool isDone(const RepairedMesh& mesh)
{
  return std::ranges::all_of(kDone, [&](auto count) { return mesh.*count == 0; });
}

} // namespace

RepairedMesh repairedMesh(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, double largestHole)
{
  RepairedMesh result = repairedOnce(points, triangles, largestHole);
  constexpr int kMost = 20;
  bool isStable = isDone(result);
  for (int again = 0; again < kMost && !isStable; ++again) // one mend may let another do more
  {
    RepairedMesh next = repairedOnce(result.points, result.triangles, largestHole);
    isStable = isDone(next);
    for (const auto count : kDone)
    {
      next.*count += result.*count;
    }
    result = std::move(next);
  }
  return result;
}

} // namespace palp
