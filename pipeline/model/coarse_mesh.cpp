#include "pipeline/model/coarse_mesh.h"

#include "haptics/surface/area_and_volume.h"
#include "pipeline/model/poly_data.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using Cube = Eigen::Array3i; // of the grid, by its place

std::vector<Cube> cubesOf(
  std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& origin, double side)
{
  std::vector<Cube> cubes;
  cubes.reserve(points.size());
  for (const Eigen::Vector3d& x : points)
  {
    cubes.emplace_back(((x - origin).array() / side).floor().cast<int>());
  }
  return cubes;
}

// What hangs together within a cube, so that walls of a shell stay apart: a number of each point.
struct Parts
{
  std::vector<int> of;
  int count = 0;
};

Parts partsOf(std::span<const Triangle> triangles, const std::vector<Cube>& cubes)
{
  std::vector<int> linked(cubes.size());
  std::iota(linked.begin(), linked.end(), 0);
  const auto first = [&](int point)
  {
    while (linked[at(point)] != point)
    {
      point = linked[at(point)] = linked[at(linked[at(point)])];
    }
    return point;
  };
  for (const Triangle& triangle : triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int from = triangle[k];
      const int to = triangle[(k + 1) % 3];
      if ((cubes[at(from)] == cubes[at(to)]).all())
      {
        const int one = first(from);
        const int other = first(to);
        linked[at(std::max(one, other))] = std::min(one, other);
      }
    }
  }
  Parts parts{ .of = std::vector<int>(cubes.size()) };
  for (std::size_t i = 0; i < cubes.size(); ++i)
  {
    const int lowest = first(static_cast<int>(i));
    parts.of[i] = at(lowest) == i ? parts.count++ : parts.of[at(lowest)];
  }
  return parts;
}

// The place where some planes meet best, from that between their points.
class Meeting
{
public:
  void addPoint(const Eigen::Vector3d& point)
  {
    middle_ += (point - middle_) / ++points_;
  }

  // after all points
  void addPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point)
  {
    planes_ += normal * normal.transpose();
    towards_ += normal.dot(point - middle_) * normal;
  }

  [[nodiscard]] Eigen::Vector3d place() const
  {
    constexpr double kFlat = 1e-3; // of the largest eigenvalue: along it all places are as good
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(planes_);
    Eigen::Vector3d place = middle_;
    for (int k = 0; k < 3; ++k)
    {
      const double value = axes.eigenvalues()[k];
      const Eigen::Vector3d axis = axes.eigenvectors().col(k);
      place += value > kFlat * axes.eigenvalues()[2] ? (axis.dot(towards_) / value * axis).eval()
                                                     : Eigen::Vector3d::Zero().eval();
    }
    return place;
  }

private:
  double points_ = 0.0;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d planes_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d towards_ = Eigen::Vector3d::Zero();
};

std::vector<Meeting> meetingsOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, const Parts& parts)
{
  std::vector<Meeting> meetings(at(parts.count));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    meetings[at(parts.of[i])].addPoint(points[i]);
  }
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d& corner = points[at(a)];
    const Eigen::Vector3d normal = (points[at(b)] - corner).cross(points[at(c)] - corner);
    const auto [one, two, three] = std::tuple(parts.of[at(a)], parts.of[at(b)], parts.of[at(c)]);
    meetings[at(one)].addPlane(normal, corner);
    two != one ? meetings[at(two)].addPlane(normal, corner) : void();
    three != one&& three != two ? meetings[at(three)].addPlane(normal, corner) : void();
  }
  return meetings;
}

} // namespace

vtkSmartPointer<vtkPolyData> coarseMesh(vtkPolyData& fine, int triangles)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(fine);
  const std::vector<Triangle> all = trianglesOf(fine);
  // a plane of any attitude goes through 1.5 cubes an area of their face, with two triangles a cube
  constexpr double kPerFace = 3.0;
  const double side = std::sqrt(kPerFace * surfaceArea(points, all) / triangles);
  const Eigen::Vector3d origin = boxAbout(points).min();
  const std::vector<Cube> cubes = cubesOf(points, origin, side);
  const Parts parts = partsOf(all, cubes);
  std::vector<Eigen::Vector3d> places;
  for (const Meeting& meeting : meetingsOf(points, all, parts))
  {
    places.push_back(meeting.place());
  }
  for (std::size_t i = 0; i < points.size(); ++i) // none beyond its cube
  {
    const Eigen::Vector3d low = origin + side * cubes[i].cast<double>().matrix();
    Eigen::Vector3d& place = places[at(parts.of[i])];
    place = place.cwiseMax(low).cwiseMin(low + Eigen::Vector3d::Constant(side));
  }
  std::vector<Triangle> coarse;
  for (const Triangle& triangle : all)
  {
    const Triangle part{ parts.of[at(triangle[0])], parts.of[at(triangle[1])],
      parts.of[at(triangle[2])] };
    if (part[0] != part[1] && part[1] != part[2] && part[2] != part[0])
    {
      coarse.push_back(part); // also two that fold onto one another: one would be a hole
    }
  }
  return makePolyData(places, coarse);
}

} // namespace palp
