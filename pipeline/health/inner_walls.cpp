#include "pipeline/health/inner_walls.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "haptics/surface/ray.h"
#include "haptics/surface/winding.h"
#include "pipeline/health/open_sides.h"
#include "pipeline/health/slivers.h"
#include "pipeline/surface_io/surface_facing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

constexpr std::size_t kMostWalls = 32; // that are looked at: each takes a search of all triangles
constexpr std::size_t kPlaces = 5;     // of each

// what hangs together across edges of two triangles
struct Part
{
  double area = 0.0;
  bool isBounded = false; // by edges of more than two triangles
  bool isOpen = false;
  std::vector<std::size_t> triangles;
};

// those that end at edges of more than two triangles, the largest first
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
  std::erase_if(parts, [](const Part& part) { return !part.isBounded; });
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

Eigen::Vector3d middleOf(const MergedMesh& mesh, const Triangle& t)
{
  return (mesh.points[at(t[0])] + mesh.points[at(t[1])] + mesh.points[at(t[2])]) / 3.0;
}

// some triangles of a part, spread over it
std::vector<std::size_t> samplesOf(const Part& part)
{
  std::vector<std::size_t> samples;
  const std::size_t step = std::max<std::size_t>(1, part.triangles.size() / kPlaces);
  for (std::size_t i = step / 2; i < part.triangles.size(); i += step)
  {
    samples.push_back(part.triangles[i]);
  }
  return samples;
}

bool liesOn(const MergedMesh& mesh, const BoxTree& rest, const Triangle& t, double aside)
{
  const auto isOn = [&](const Eigen::Vector3d& place)
  { return distanceTo(rest, place, 2.0 * aside) < aside; };
  return isOn(middleOf(mesh, t)) &&
    std::ranges::all_of(t, [&](int corner) { return isOn(mesh.points[at(corner)]); });
}

// whether a part is there twice: all of it lies on the rest
bool isCovered(const MergedMesh& mesh, const BoxTree& rest, const Part& part, double aside)
{
  return std::ranges::all_of(
    part.triangles, [&](std::size_t i) { return liesOn(mesh, rest, mesh.triangles[i], aside); });
}

// whether all the rest is on both sides of a part, which is nowhere seen from outside, where that
// is looked at
bool isBetween(
  const MergedMesh& mesh, const BoxTree& whole, const BoxTree& rest, const Part& part, double aside)
{
  const Winding winding(rest);
  const auto isInside = [&](const Eigen::Vector3d& place)
  {
    constexpr double kHalf = 0.5; // of a turn of all directions
    return std::abs(winding(place)) > kHalf;
  };
  return std::ranges::all_of(samplesOf(part),
    [&](std::size_t i)
    {
      const Triangle& t = mesh.triangles[i];
      const Eigen::Vector3d middle = middleOf(mesh, t);
      const Eigen::Vector3d normal = unitNormal(mesh.points, t);
      const Eigen::Vector3d off = aside * normal;
      return isInside(middle + off) && isInside(middle - off) &&
        !seesOutside(whole, middle + off, normal) && !seesOutside(whole, middle - off, -normal);
    });
}

// of one triangle
std::size_t openEdges(const Edges& edges)
{
  return edges.unpaired.size() - edges.crowded;
}

// what the rest is whole without
bool isWall(const MergedMesh& mesh, const Edges& edges, const BoxTree& whole, const Part& part)
{
  std::vector<Triangle> rest = mesh.triangles;
  for (const std::size_t triangle : part.triangles)
  {
    rest[triangle].fill(0); // which is no triangle
  }
  const BoxTree tree(mesh.points, rest);
  if (tree.empty() || openEdges(edgesOf(mesh.points.size(), rest)) > openEdges(edges))
  {
    return false;
  }
  const double aside = asideOf(tree);
  return isCovered(mesh, tree, part, aside) ||
    (!part.isOpen && isBetween(mesh, whole, tree, part, aside));
}

} // namespace

void dropHanging(MergedMesh& mesh)
{
  const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
  std::vector<bool> isApart(mesh.triangles.size());
  std::vector<Triangle> rest;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    isApart[i] = std::ranges::count(edges.across[i], -1) == 3;
    isApart[i] ? void() : rest.push_back(mesh.triangles[i]);
  }
  if (rest.size() == mesh.triangles.size())
  {
    return;
  }
  std::vector<bool> isOpen(mesh.triangles.size());
  for (const std::vector<Side>& sides : unpairedSides(mesh.triangles, edges))
  {
    sides.size() == 1 ? void(isOpen[at(sides.front().triangle)] = true) : void();
  }
  const BoxTree tree(mesh.points, rest);
  const auto hangs = [&](const Triangle& t, bool isLoose)
  {
    constexpr double kFlat = 1e-6; // of its longest side, as high: by the rounding of files
    constexpr double kOn = 1e-3;   // of that side, off the rest
    const Eigen::Vector3d& a = mesh.points[at(t[0])];
    const Eigen::Vector3d& b = mesh.points[at(t[1])];
    const Eigen::Vector3d& c = mesh.points[at(t[2])];
    const double longest = std::max({ (b - a).norm(), (c - b).norm(), (a - c).norm() });
    return flatness(a, b, c) < kFlat || (isLoose && liesOn(mesh, tree, t, kOn * longest));
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    isApart[i] = isApart[i] && hangs(mesh.triangles[i], isOpen[i]);
  }
  mesh = mergedWithout(mesh.points, mesh.triangles, isApart);
}

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
    const auto wall = std::ranges::find_if(
      parts, [&](const Part& part) { return isWall(mesh, edges, whole, part); });
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

std::size_t turnOutward(MergedMesh& mesh)
{
  const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
  if (edges.crowded == 0)
  {
    return 0;
  }
  std::vector<bool> turn = facingOf(mesh.points, mesh.triangles, edges).turn;
  if (std::ranges::count(turn, true) == 0)
  {
    return 0;
  }
  const BoxTree whole(mesh.points, mesh.triangles);
  const double aside = whole.empty() ? 0.0 : asideOf(whole);
  for (const Part& part : boundedParts(mesh, edges))
  {
    int seen = 0; // from the front less from the back
    for (const std::size_t triangle : samplesOf(part))
    {
      const Triangle& t = mesh.triangles[triangle];
      const Eigen::Vector3d front = (turn[triangle] ? -1.0 : 1.0) * unitNormal(mesh.points, t);
      const Eigen::Vector3d middle = middleOf(mesh, t);
      seen += seesOutside(whole, middle + aside * front, front) ? 1 : 0;
      seen -= seesOutside(whole, middle - aside * front, -front) ? 1 : 0;
    }
    for (const std::size_t triangle : part.triangles)
    {
      turn[triangle] = turn[triangle] != (seen < 0);
    }
  }
  for (std::size_t i = 0; i < turn.size(); ++i)
  {
    turn[i] ? std::swap(mesh.triangles[i][0], mesh.triangles[i][2]) : void();
  }
  return static_cast<std::size_t>(std::ranges::count(turn, true));
}

} // namespace palp
