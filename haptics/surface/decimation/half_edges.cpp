#include "haptics/surface/decimation/half_edges.h"

#include "haptics/error.h"

#include <array>
#include <string>
#include <vector>

namespace palp
{

HalfEdges halfEdgesOf(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  HalfEdges mesh;
  mesh.reserve(points.size(), 3 * triangles.size() / 2, triangles.size());
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

} // namespace palp
