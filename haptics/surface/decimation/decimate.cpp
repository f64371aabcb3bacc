#include "haptics/surface/decimation/decimate.h"

#include "haptics/error.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <string>

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

HalfEdges halfEdgesOf(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  HalfEdges mesh;
  std::vector<HalfEdges::VertexHandle> handles(points.size());
  omerr().disable(); // the error below says it in our words
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    std::array<HalfEdges::VertexHandle, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto point = static_cast<std::size_t>(triangles[i][k]);
      const Eigen::Vector3d& x = points[point];
      if (!handles[point].is_valid())
      {
        handles[point] = mesh.add_vertex({ x.x(), x.y(), x.z() });
      }
      corners[k] = handles[point];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
    {
      continue;
    }
    if (!mesh.add_face(corners[0], corners[1], corners[2]).is_valid())
    {
      throw Error(ErrorCode::BadMesh,
        "surface: triangle " + std::to_string(i) +
          " does not fit its neighbors; repair the mesh, or press it undecimated");
    }
  }
  return mesh;
}

} // namespace

Surface decimated(const Surface& surface, std::size_t points)
{
  return decimated(surface.points(), surface.triangles(), points);
}

Surface decimated(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, std::size_t count)
{
  HalfEdges mesh = halfEdgesOf(points, triangles);
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.request_face_normals();
  mesh.update_face_normals();

  OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle quadric;
  OpenMesh::Decimater::ModNormalFlippingT<HalfEdges>::Handle flipping;
  decimater.add(quadric);
  decimater.add(flipping);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to(count);
  mesh.garbage_collection();

  std::vector<Eigen::Vector3d> kept;
  kept.reserve(mesh.n_vertices());
  for (const HalfEdges::VertexHandle vertex : mesh.vertices())
  {
    kept.emplace_back(mesh.point(vertex).data());
  }
  std::vector<Triangle> facesKept;
  facesKept.reserve(mesh.n_faces());
  for (const HalfEdges::FaceHandle face : mesh.faces())
  {
    Triangle& triangle = facesKept.emplace_back();
    std::size_t k = 0;
    for (const HalfEdges::VertexHandle vertex : mesh.fv_range(face))
    {
      triangle[k++] = vertex.idx();
    }
  }
  return { std::move(kept), std::move(facesKept) };
}

} // namespace palp
