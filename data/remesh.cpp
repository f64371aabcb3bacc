#include "data/remesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <OpenMesh/Core/Geometry/EigenVectorT.hh> // specializes what the kernel declares

#include <cmath>

namespace palp
{
namespace
{

using Eigen::Vector3d;

struct Traits : OpenMesh::DefaultTraits
{
  using Point = Vector3d;
  using Normal = Vector3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

void splitLongEdges(HalfEdges& mesh, double longest)
{
  for (std::size_t e = 0; e < mesh.n_edges(); ++e) // new edges are looked at as well
  {
    const OpenMesh::EdgeHandle edge(static_cast<int>(e));
    if (mesh.calc_edge_sqr_length(edge) > longest * longest)
    {
      mesh.split(edge, mesh.calc_edge_midpoint(edge));
    }
  }
}

// true when the end of no remaining edge would be too far, and no triangle would turn over
bool mayCollapse(HalfEdges& mesh, OpenMesh::HalfedgeHandle half, double longest)
{
  if (!mesh.is_collapse_ok(half))
  {
    return false;
  }
  const auto from = mesh.from_vertex_handle(half);
  const auto to = mesh.to_vertex_handle(half);
  for (const auto neighbor : mesh.vv_range(from))
  {
    if ((mesh.point(neighbor) - mesh.point(to)).squaredNorm() > longest * longest)
    {
      return false;
    }
  }
  for (const auto face : mesh.vf_range(from))
  {
    Vector3d corner[3];
    bool survives = true;
    int i = 0;
    for (const auto v : mesh.fv_range(face))
    {
      survives = survives && v != to;
      corner[i++] = mesh.point(v == from ? to : static_cast<OpenMesh::VertexHandle>(v));
    }
    const Vector3d after = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    if (survives && after.dot(mesh.normal(face)) <= 0.5 * after.norm())
    {
      return false;
    }
  }
  return true;
}

void collapseShortEdges(HalfEdges& mesh, double shortest, double longest)
{
  for (const auto edge : mesh.edges())
  {
    if (edge.deleted() || mesh.calc_edge_sqr_length(edge) >= shortest * shortest)
    {
      continue;
    }
    for (const auto half : { edge.h0(), edge.h1() })
    {
      if (mayCollapse(mesh, half, longest))
      {
        mesh.collapse(half);
        break;
      }
    }
  }
  mesh.garbage_collection();
}

// brings the number of neighbors towards six
void flipEdges(HalfEdges& mesh)
{
  const auto excess = [&](OpenMesh::VertexHandle v, int change)
  {
    const int off = static_cast<int>(mesh.valence(v)) + change - 6;
    return off * off;
  };
  for (const auto edge : mesh.edges())
  {
    const auto a = edge.v0();
    const auto b = edge.v1();
    const auto c = edge.h0().next().to();
    const auto d = edge.h1().next().to();
    const int before = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
    const int after = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
    const bool isFlat = std::abs(mesh.calc_dihedral_angle_fast(edge.h0())) < 0.5;
    if (after < before && isFlat && mesh.is_flip_ok(edge))
    {
      mesh.flip(edge);
    }
  }
}

// every point towards the center of its neighbors, along the surface, then back onto it
void relax(HalfEdges& mesh, const Distance& distance)
{
  std::vector<Vector3d> moved;
  for (const auto v : mesh.vertices())
  {
    Vector3d center = Vector3d::Zero();
    for (const auto neighbor : mesh.vv_range(v))
    {
      center += mesh.point(neighbor) / mesh.valence(v);
    }
    const Vector3d p = mesh.point(v);
    const Vector3d normal = levelNormal(distance, p);
    const Vector3d step = center - p;
    moved.push_back(ontoSurface(distance, p + step - normal.dot(step) * normal));
  }
  for (const auto v : mesh.vertices())
  {
    mesh.set_point(v, moved[static_cast<std::size_t>(v.idx())]);
  }
}

} // namespace

Mesh remesh(const Mesh& mesh, double edge, const Distance& distance)
{
  HalfEdges half;
  for (const Vector3d& p : mesh.points)
  {
    half.add_vertex(p);
  }
  for (const auto& [a, b, c] : mesh.triangles)
  {
    half.add_face(OpenMesh::VertexHandle(a), OpenMesh::VertexHandle(b), OpenMesh::VertexHandle(c));
  }
  half.request_vertex_status();
  half.request_edge_status();
  half.request_face_status();
  half.request_halfedge_status();
  half.request_face_normals();

  for (int round = 0; round < 10; ++round)
  {
    splitLongEdges(half, 4.0 / 3.0 * edge);
    half.update_face_normals();
    collapseShortEdges(half, 4.0 / 5.0 * edge, 4.0 / 3.0 * edge);
    half.update_face_normals();
    flipEdges(half);
    relax(half, distance);
  }

  Mesh even;
  for (const auto v : half.vertices())
  {
    even.points.push_back(half.point(v));
  }
  for (const auto face : half.faces())
  {
    const auto corner = face.vertices().to_array<3>();
    even.triangles.push_back({ corner[0].idx(), corner[1].idx(), corner[2].idx() });
  }
  return even;
}

} // namespace palp
