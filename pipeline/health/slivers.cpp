#include "pipeline/health/slivers.h"

#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/crossing.h"

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace palp
{
namespace
{

struct Traits : OpenMesh::DefaultTraits
{
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Halfedge = OpenMesh::HalfedgeHandle;
using Vertex = OpenMesh::VertexHandle;

constexpr double kTurn = 0.9; // cosine
constexpr double kOff = 0.1;  // of a short side, by which a point may leave the triangles about it
constexpr double kShape = 1e-4; // of the body's size, by which no shape changes

// how far a point may leave the triangles about it, however long its way
struct Off
{
  double least; // as files round coordinates
  double most;
};

Eigen::Vector3d placeOf(const HalfEdges& mesh, Vertex vertex)
{
  return Eigen::Vector3d(mesh.point(vertex).data());
}

Eigen::Vector3d normalOf(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return (b - a).cross(c - a).normalized();
}

// the sides of a triangle, the shortest first
std::array<Halfedge, 3> sidesOf(const HalfEdges& mesh, OpenMesh::FaceHandle face)
{
  const Halfedge first = mesh.halfedge_handle(face);
  const Halfedge second = mesh.next_halfedge_handle(first);
  std::array<Halfedge, 3> sides{ first, second, mesh.next_halfedge_handle(second) };
  std::ranges::sort(sides, {}, [&](Halfedge side) { return mesh.calc_edge_sqr_length(side); });
  return sides;
}

double flatnessOf(const HalfEdges& mesh, OpenMesh::FaceHandle face)
{
  const Halfedge side = mesh.halfedge_handle(face);
  return flatness(placeOf(mesh, mesh.from_vertex_handle(side)),
    placeOf(mesh, mesh.to_vertex_handle(side)),
    placeOf(mesh, mesh.to_vertex_handle(mesh.next_halfedge_handle(side))));
}

// whether the triangles around a point may change, and keep their normals, when it goes to another
bool mayGo(const HalfEdges& mesh, Vertex from, Vertex to, const Off& mayBe)
{
  const Eigen::Vector3d there = placeOf(mesh, to);
  for (const Halfedge out : mesh.voh_range(from))
  {
    if (mesh.is_boundary(out))
    {
      continue;
    }
    const Vertex b = mesh.to_vertex_handle(out);
    const Vertex c = mesh.to_vertex_handle(mesh.next_halfedge_handle(out));
    if (b == to || c == to)
    {
      continue; // goes away
    }
    const Eigen::Vector3d here = placeOf(mesh, from);
    const Eigen::Vector3d before = normalOf(here, placeOf(mesh, b), placeOf(mesh, c));
    const Eigen::Vector3d after = normalOf(there, placeOf(mesh, b), placeOf(mesh, c));
    const double off = std::abs(before.dot(there - here));
    if (before.dot(after) < kTurn ||
      off > std::max(mayBe.least, std::min(mayBe.most, kOff * (there - here).norm())) ||
      mesh.status(mesh.face_handle(out)).locked())
    {
      return false;
    }
  }
  return true;
}

bool collapse(HalfEdges& mesh, Halfedge shortest, const Off& mayBe)
{
  // which points were taken is marked as selected: is_collapse_ok writes the tags
  for (const Halfedge way : { shortest, mesh.opposite_halfedge_handle(shortest) })
  {
    const Vertex from = mesh.from_vertex_handle(way);
    const Vertex to = mesh.to_vertex_handle(way);
    if (mesh.status(from).selected() || mesh.status(to).selected())
    {
      continue; // at once, one after the other, they would lead around a cylinder
    }
    const bool onBorder = mesh.is_boundary(from) && !mesh.is_boundary(mesh.edge_handle(way));
    if (!onBorder && mesh.is_collapse_ok(way) && mayGo(mesh, from, to, mayBe))
    {
      mesh.status(to).set_selected(true);
      mesh.collapse(way);
      return true;
    }
  }
  return false;
}

bool flip(HalfEdges& mesh, Halfedge longest)
{
  const auto edge = mesh.edge_handle(longest);
  const Halfedge behind = mesh.opposite_halfedge_handle(longest);
  if (mesh.is_boundary(edge) || !mesh.is_flip_ok(edge) ||
    mesh.status(mesh.face_handle(longest)).locked() ||
    mesh.status(mesh.face_handle(behind)).locked())
  {
    return false;
  }
  const auto opposite = [&](Halfedge side)
  { return placeOf(mesh, mesh.to_vertex_handle(mesh.next_halfedge_handle(side))); };
  const Eigen::Vector3d a = placeOf(mesh, mesh.from_vertex_handle(longest));
  const Eigen::Vector3d b = placeOf(mesh, mesh.to_vertex_handle(longest));
  const Eigen::Vector3d c = opposite(longest);
  const Eigen::Vector3d d = opposite(behind);
  const Eigen::Vector3d normal = normalOf(b, a, d);
  const double before = std::min(flatness(a, b, c), flatness(b, a, d));
  const double after = std::min(flatness(c, a, d), flatness(d, b, c));
  if (after <= before || normalOf(c, a, d).dot(normal) < kTurn ||
    normalOf(d, b, c).dot(normal) < kTurn)
  {
    return false;
  }
  mesh.flip(edge);
  return true;
}

std::optional<HalfEdges> halfEdgesOf(
  const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  HalfEdges mesh;
  omerr().disable();
  for (const Eigen::Vector3d& x : points)
  {
    mesh.add_vertex({ x.x(), x.y(), x.z() });
  }
  for (const Triangle& t : triangles)
  {
    if (!mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])).is_valid())
    {
      return std::nullopt;
    }
  }
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  return mesh;
}

std::size_t countOf(const HalfEdges& mesh)
{
  return static_cast<std::size_t>(std::ranges::count_if(
    mesh.faces(), [&](OpenMesh::FaceHandle face) { return flatnessOf(mesh, face) < kSliver; }));
}

void removeFrom(HalfEdges& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Vertex vertex : mesh.vertices())
  {
    box.extend(placeOf(mesh, vertex));
  }
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const Off mayBe{ std::numeric_limits<float>::epsilon() * largest,
    kShape * box.diagonal().norm() };
  constexpr int kPasses = 30; // one may make room for the next
  bool isDone = false;
  for (int pass = 0; pass < kPasses && !isDone; ++pass)
  {
    isDone = true;
    for (const Vertex vertex : mesh.vertices())
    {
      mesh.status(vertex).set_selected(false);
    }
    for (const OpenMesh::FaceHandle face : mesh.faces())
    {
      if (mesh.status(face).deleted() || !(flatnessOf(mesh, face) < kSliver))
      {
        continue;
      }
      const auto sides = sidesOf(mesh, face);
      const bool isNeedle =
        mesh.calc_edge_length(sides[0]) < 2.0 * kSliver * mesh.calc_edge_length(sides[2]);
      isDone = !((isNeedle && collapse(mesh, sides[0], mayBe)) || flip(mesh, sides[2])) && isDone;
    }
  }
}

// of each face, by its number; one that is gone has no area
std::vector<Triangle> trianglesOf(const HalfEdges& mesh)
{
  std::vector<Triangle> triangles(mesh.n_faces(), Triangle{});
  for (const OpenMesh::FaceHandle face : mesh.faces())
  {
    std::ranges::transform(mesh.fv_range(face), triangles[at(face.idx())].begin(), &Vertex::idx);
  }
  return triangles;
}

// Locks the faces that have to stay as they are, so that none passes through another that did not
// do so before; false: all may change as they did.
bool lockCrossing(std::span<const Eigen::Vector3d> points, const HalfEdges& changed,
  const std::vector<bool>& crossed, HalfEdges& mesh)
{
  const std::vector<Triangle> before = trianglesOf(mesh);
  const std::vector<Triangle> after = trianglesOf(changed);
  bool locks = false;
  for (const std::array<int, 2>& pair : crossingPairs(BoxTree(points, after), after))
  {
    for (const int i : pair)
    {
      if (!(crossed[at(pair[0])] && crossed[at(pair[1])]) && before[at(i)] != after[at(i)])
      {
        mesh.status(OpenMesh::FaceHandle(i)).set_locked(true);
        locks = true;
      }
    }
  }
  return locks;
}

} // namespace

RemovedSlivers removeSlivers(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles)
{
  constexpr int kTries = 20;
  std::optional<HalfEdges> given = halfEdgesOf(points, triangles);
  const std::size_t before = given ? countOf(*given) : 0;
  if (before == 0)
  {
    return {};
  }
  std::vector<bool> crossed(triangles.size());
  for (const int triangle : crossingTriangles(BoxTree(points, triangles), triangles))
  {
    crossed[at(triangle)] = true;
  }
  HalfEdges mesh = *given;
  removeFrom(mesh);
  const std::size_t least = countOf(mesh);
  for (int tries = 0; lockCrossing(points, mesh, crossed, *given); ++tries)
  {
    mesh = *given;
    tries < kTries ? removeFrom(mesh) : void(); // then all are left
  }
  const std::size_t left = std::max(countOf(mesh), least);
  mesh.garbage_collection();
  points.clear();
  triangles.clear();
  for (const Vertex vertex : mesh.vertices())
  {
    points.push_back(placeOf(mesh, vertex));
  }
  for (const OpenMesh::FaceHandle face : mesh.faces())
  {
    Triangle triangle{};
    std::ranges::transform(mesh.fv_range(face), triangle.begin(), &Vertex::idx);
    triangles.push_back(triangle);
  }
  return { before - std::min(before, left), left - least };
}

} // namespace palp
