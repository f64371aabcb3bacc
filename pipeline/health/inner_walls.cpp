#include "pipeline/health/inner_walls.h"

#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "haptics/surface/ray.h"
#include "haptics/surface/winding.h"
#include "pipeline/health/open_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace palp
{
namespace
{

constexpr std::size_t kMostWalls = 32; // that are looked at: each takes a search of all triangles

// what hangs together across edges of two triangles
struct Part
{
  double area = 0.0;
  bool isBounded = false; // by edges of more than two triangles
  bool isOpen = false;
  std::vector<std::size_t> triangles;
};

// those that may be walls, the largest first
std::vector<Part> boundedParts(const MergedMesh& mesh, const Edges& edges)
{
  const std::vector<int> numbers = piecesOf(edges.across);
  std::vector<Part> parts(static_cast<std::size_t>(std::ranges::max(numbers)) + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d& from = mesh.points[at(a)];
    Part& part = parts[at(numbers[i])];
    part.area += (mesh.points[at(b)] - from).cross(mesh.points[at(c)] - from).norm();
    part.triangles.push_back(i);
  }
  for (const std::vector<Side>& sides : unpairedSides(mesh.triangles, edges))
  {
    for (const Side& side : sides)
    {
      Part& part = parts[at(numbers[at(side.triangle)])];
      (sides.size() == 1 ? part.isOpen : part.isBounded) = true;
    }
  }
  std::erase_if(parts, [](const Part& part) { return !part.isBounded || part.isOpen; });
  std::ranges::stable_sort(parts, std::greater(), &Part::area);
  parts.resize(std::min(parts.size(), kMostWalls));
  return parts;
}

// whether one looks out of the whole mesh from a place, to the side of a normal
bool seesOutside(const BoxTree& whole, const Eigen::Vector3d& place, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d aside = normal.unitOrthogonal();
  const Eigen::Vector3d other = normal.cross(aside);
  for (const Eigen::Vector3d& lean : { Eigen::Vector3d(0.0, 0.0, 0.0), aside,
         Eigen::Vector3d(-aside), other, Eigen::Vector3d(-other) })
  {
    const Eigen::Vector3d way = (normal + 0.7 * lean).normalized();
    if (rayEntry(whole, place, way).triangle < 0 && rayExit(whole, place, way).triangle < 0)
    {
      return true;
    }
  }
  return false;
}

// whether all the rest is on both sides of a part, which is nowhere seen from outside, where that
// is looked at
bool isWall(const MergedMesh& mesh, const BoxTree& whole, const Part& part)
{
  constexpr std::size_t kPlaces = 5;
  std::vector<Triangle> rest = mesh.triangles;
  for (const std::size_t triangle : part.triangles)
  {
    rest[triangle].fill(0); // which is no triangle
  }
  const BoxTree tree(mesh.points, rest);
  if (tree.empty())
  {
    return false;
  }
  const Winding winding(tree);
  const double aside = asideOf(tree);
  const std::size_t step = std::max<std::size_t>(1, part.triangles.size() / kPlaces);
  for (std::size_t i = step / 2; i < part.triangles.size(); i += step)
  {
    const Triangle& t = mesh.triangles[part.triangles[i]];
    const Eigen::Vector3d middle =
      (mesh.points[at(t[0])] + mesh.points[at(t[1])] + mesh.points[at(t[2])]) / 3.0;
    const Eigen::Vector3d normal = unitNormal(mesh.points, t);
    const Eigen::Vector3d off = aside * normal;
    const auto isInside = [&](const Eigen::Vector3d& place)
    {
      constexpr double kHalf = 0.5; // of a turn of all directions
      return std::abs(winding(place)) > kHalf;
    };
    if (!isInside(middle + off) || !isInside(middle - off) ||
      seesOutside(whole, middle + off, normal) || seesOutside(whole, middle - off, -normal))
    {
      return false;
    }
  }
  return true;
}

} // namespace

void dropInnerWalls(MergedMesh& mesh)
{
  for (;;)
  {
    const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
    if (edges.crowded == 0)
    {
      return;
    }
    const BoxTree whole(mesh.points, mesh.triangles);
    const std::vector<Part> parts = boundedParts(mesh, edges);
    const auto wall =
      std::ranges::find_if(parts, [&](const Part& part) { return isWall(mesh, whole, part); });
    if (wall == parts.end())
    {
      return;
    }
    std::vector<bool> isOfIt(mesh.triangles.size());
    for (const std::size_t triangle : wall->triangles)
    {
      isOfIt[triangle] = true;
    }
    mesh = mergedWithout(mesh.points, mesh.triangles, isOfIt);
  }
}

} // namespace palp
