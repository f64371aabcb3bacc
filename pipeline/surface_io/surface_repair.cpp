#include "pipeline/surface_io/surface_repair.h"

#include "haptics/error.h"
#include "haptics/surface/box_tree.h"
#include "haptics/surface/edges.h"
#include "pipeline/model/coincident_points.h"
#include "pipeline/model/poly_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// points that are used, each once; triangles that have three corners
struct Merged
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
  std::size_t dropped = 0;
};

Merged merged(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  const std::vector<int> first = firstOfEach(points);
  std::vector<int> number(points.size(), -1);
  Merged result;
  result.triangles.reserve(triangles.size());
  for (Triangle t : triangles)
  {
    std::ranges::transform(t, t.begin(), [&](int corner) { return first[at(corner)]; });
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    {
      ++result.dropped;
      continue;
    }
    for (int& corner : t)
    {
      int& known = number[at(corner)];
      if (known < 0)
      {
        known = static_cast<int>(result.points.size());
        result.points.emplace_back(points[at(corner)].cast<float>().cast<double>());
      }
      corner = known;
    }
    result.triangles.push_back(t);
  }
  return result;
}

// whether a triangle goes along an edge from one point to another
bool goes(const Triangle& t, int from, int to)
{
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) ||
    (t[2] == from && t[0] == to);
}

// six times the volume below triangles, seen from a point
double volumeSeen(
  std::span<const Eigen::Vector3d> points, const Triangle& t, const Eigen::Vector3d& from)
{
  return (points[at(t[0])] - from).dot((points[at(t[1])] - from).cross(points[at(t[2])] - from));
}

// which triangles to turn, so that those across an edge agree, with the first of each piece or,
// when closed, so that its volume is positive
std::vector<bool> toTurn(const Merged& mesh, const Edges& edges, bool closed)
{
  const std::vector<Triangle>& triangles = mesh.triangles;
  std::vector<bool> turn(triangles.size());
  std::vector<bool> met(triangles.size());
  std::vector<int> piece;
  for (std::size_t start = 0; start < triangles.size(); ++start)
  {
    if (met[start])
    {
      continue;
    }
    met[start] = true;
    piece.assign(1, static_cast<int>(start));
    const Eigen::Vector3d& from = mesh.points[at(triangles[start][0])];
    double volume = 0.0;
    for (std::size_t next = 0; next < piece.size(); ++next)
    {
      const std::size_t self = at(piece[next]);
      const Triangle& t = triangles[self];
      volume += (turn[self] ? -1.0 : 1.0) * volumeSeen(mesh.points, t, from);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const int other = edges.across[self][k];
        if (other >= 0 && !met[at(other)])
        {
          met[at(other)] = true;
          turn[at(other)] = turn[self] != goes(triangles[at(other)], t[k], t[(k + 1) % 3]);
          piece.push_back(other);
        }
      }
    }
    for (const int triangle : piece)
    {
      turn[at(triangle)] = turn[at(triangle)] != (closed && volume < 0.0);
    }
  }
  return turn;
}

} // namespace

RepairedSurface repair(std::span<const Eigen::Vector3d> filePoints,
  std::span<const Triangle> fileTriangles, const std::string& name)
{
  RepairedSurface result;
  Merged mesh = merged(filePoints, fileTriangles);
  if (mesh.dropped > 0)
  {
    result.notes.push_back(
      counted(mesh.dropped, "triangle whose corners coincide", "triangles whose corners coincide") +
      " dropped");
  }
  if (std::ranges::none_of(
        mesh.triangles, [&](const Triangle& t) { return !unitNormal(mesh.points, t).isZero(); }))
  {
    throw Error(ErrorCode::BadMesh, name + ": no triangle has an area; export the surface again");
  }

  const Edges edges = edgesOf(mesh.points.size(), mesh.triangles);
  const std::size_t open = edges.unpaired.size() - edges.crowded;
  result.closed = edges.unpaired.empty();
  if (edges.crowded > 0)
  {
    result.warnings.push_back(
      "not a manifold: " + counted(edges.crowded, "edge has", "edges have") +
      " more than two triangles; forces near there may be wrong");
  }
  if (open > 0)
  {
    result.warnings.push_back("open: " + counted(open, "edge has", "edges have") +
      " one triangle only; press it from the front");
  }

  const std::vector<bool> turn = toTurn(mesh, edges, result.closed);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < turn.size(); ++i)
  {
    if (turn[i])
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
  result.mesh = makePolyData(mesh.points, mesh.triangles);
  return result;
}

} // namespace palp
