#include "data/shapes.h"

#include <array>
#include <map>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

using Eigen::Vector3d;

// number of the point at a place that several triangles share, added at the first visit
template <typename Key>
class SharedPoints
{
public:
  explicit SharedPoints(std::vector<Vector3d>& points)
    : points_(points)
  {
  }

  int at(const Key& key, const Vector3d& point)
  {
    const auto [entry, isNew] = numbers_.try_emplace(key, static_cast<int>(points_.size()));
    if (isNew)
    {
      points_.push_back(point);
    }
    return entry->second;
  }

private:
  std::vector<Vector3d>& points_;
  std::map<Key, int> numbers_;
};

Mesh icosahedron()
{
  constexpr double phi = std::numbers::phi;
  Mesh mesh;
  mesh.points = { { -1, phi, 0 }, { 1, phi, 0 }, { -1, -phi, 0 }, { 1, -phi, 0 }, { 0, -1, phi },
    { 0, 1, phi }, { 0, -1, -phi }, { 0, 1, -phi }, { phi, 0, -1 }, { phi, 0, 1 }, { -phi, 0, -1 },
    { -phi, 0, 1 } };
  mesh.triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 },
    { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
    { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
    { 9, 8, 1 } };
  return mesh;
}

// each triangle becomes four
void split(Mesh& mesh)
{
  SharedPoints<std::pair<int, int>> midpoints(mesh.points);
  const auto midpoint = [&](int a, int b)
  {
    const Vector3d& first = mesh.points[static_cast<std::size_t>(a)];
    const Vector3d& second = mesh.points[static_cast<std::size_t>(b)];
    return midpoints.at(std::minmax(a, b), (first + second) / 2.0);
  };
  std::vector<Triangle> fine;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const int ab = midpoint(a, b);
    const int bc = midpoint(b, c);
    const int ca = midpoint(c, a);
    fine.insert(fine.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
  }
  mesh.triangles = std::move(fine);
}

} // namespace

Mesh makeGrid(int n, double size)
{
  Mesh mesh;
  const double spacing = size / (n - 1);
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      mesh.points.emplace_back(i * spacing - size / 2.0, j * spacing - size / 2.0, 0.0);
    }
  }
  for (int j = 0; j + 1 < n; ++j)
  {
    for (int i = 0; i + 1 < n; ++i)
    {
      const int corner = j * n + i;
      mesh.triangles.push_back({ corner, corner + 1, corner + n + 1 });
      mesh.triangles.push_back({ corner, corner + n + 1, corner + n });
    }
  }
  return mesh;
}

Mesh makeBox(const Vector3d& size, double spacing)
{
  using Counts = Eigen::Array3i; // of cells along the axes
  Mesh mesh;
  SharedPoints<std::array<int, 3>> lattice(mesh.points);
  // the slack keeps 100 mm at 2.5 mm from becoming 41 cells
  const Counts cells = (size.array() / spacing - 1e-9).ceil().cast<int>();
  const auto point = [&](const Counts& from)
  {
    const Eigen::Array3d fraction = from.cast<double>() / cells.cast<double>();
    return lattice.at(
      { from[0], from[1], from[2] }, size.array() * (fraction - Eigen::Array3d(0.5, 0.5, 1.0)));
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const int side : { 0, cells[axis] })
    {
      for (int i = 0; i < cells[u]; ++i)
      {
        for (int j = 0; j < cells[v]; ++j)
        {
          std::array<Counts, 4> corner; // counter-clockwise seen from the end of the axis
          for (std::size_t k = 0; k < 4; ++k)
          {
            corner[k][axis] = side;
            corner[k][u] = i + (k == 1 || k == 2 ? 1 : 0);
            corner[k][v] = j + (k >= 2 ? 1 : 0);
          }
          if (side == 0)
          {
            std::swap(corner[1], corner[3]);
          }
          const int a = point(corner[0]);
          const int c = point(corner[2]);
          mesh.triangles.push_back({ a, point(corner[1]), c });
          mesh.triangles.push_back({ a, c, point(corner[3]) });
        }
      }
    }
  }
  return mesh;
}

Mesh makeSphere(double radius, int splits)
{
  Mesh mesh = icosahedron();
  for (int i = 0; i < splits; ++i)
  {
    split(mesh);
    for (Vector3d& point : mesh.points)
    {
      point.normalize();
    }
  }
  for (Vector3d& point : mesh.points)
  {
    point *= radius / point.norm();
  }
  return mesh;
}

} // namespace palp
