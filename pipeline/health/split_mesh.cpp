#include "pipeline/health/split_mesh.h"

#include "haptics/surface/edges.h"
#include "pipeline/health/open_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace palp
{
namespace
{

// a triangle at an edge that goes from a to b
struct Leaf
{
  Side side;
  double angle; // about the edge [rad]
  bool along;   // goes from a to b: the body lies where the angle is smaller
};

std::vector<Leaf> leavesAt(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const std::vector<Side>& sides)
{
  const auto point = [&](const Side& side, std::size_t k)
  { return triangles[at(side.triangle)][(at(side.k) + k) % 3]; };
  const int a = point(sides.front(), 0);
  const Eigen::Vector3d axis = (points[at(point(sides.front(), 1))] - points[at(a)]).normalized();
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  std::vector<Leaf> leaves;
  for (const Side& side : sides)
  {
    const Eigen::Vector3d to = points[at(point(side, 2))] - points[at(a)];
    leaves.push_back({ side, std::atan2(to.dot(y), to.dot(x)), point(side, 0) == a });
  }
  std::ranges::sort(leaves, {}, &Leaf::angle);
  return leaves;
}

// joins what bounds the same wedge of the body
void joinWedges(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
  const std::vector<Side>& sides, Edges& edges)
{
  const std::vector<Leaf> leaves = leavesAt(points, triangles, sides);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    const Leaf& low = leaves[i];
    const Leaf& high = leaves[(i + 1) % leaves.size()];
    if (!low.along && high.along)
    {
      edges.across[at(low.side.triangle)][at(low.side.k)] = high.side.triangle;
      edges.across[at(high.side.triangle)][at(high.side.k)] = low.side.triangle;
    }
  }
}

// the points that have several
std::vector<bool> withSeveral(std::size_t points, const std::vector<Triangle>& triangles,
  const std::vector<std::array<int, 3>>& fans)
{
  std::vector<int> first(points, -1);
  std::vector<bool> result(points);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      int& known = first[at(triangles[i][k])];
      known = known < 0 ? fans[i][k] : known;
      result[at(triangles[i][k])] = result[at(triangles[i][k])] || known != fans[i][k];
    }
  }
  return result;
}

// a point of its own for each fan, near the fan's triangles
class Fans
{
public:
  Fans(std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles,
    const std::vector<std::array<int, 3>>& fans)
    : points_(points)
  {
    const std::vector<bool> parted = withSeveral(points.size(), triangles, fans);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      const auto& [a, b, c] = triangles[i];
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (parted[at(triangles[i][k])])
        {
          Fan& fan = ofPoint_[triangles[i][k]][fans[i][k]];
          fan.middles += (points[at(a)] + points[at(b)] + points[at(c)]) / 3.0;
          ++fan.triangles;
        }
      }
    }
  }

  std::size_t part()
  {
    const std::size_t before = points_.size();
    for (auto& [point, fans] : ofPoint_)
    {
      const Eigen::Vector3d place = points_[at(point)];
      int number = point;
      for (auto& [corner, fan] : fans)
      {
        constexpr double kApart = 1e-3;
        const Eigen::Vector3d to = fan.middles / static_cast<double>(fan.triangles) - place;
        points_.resize(std::max(points_.size(), at(number) + 1));
        points_[at(number)] = place + kApart * to;
        fan.point = std::exchange(number, static_cast<int>(points_.size()));
      }
    }
    return points_.size() - before;
  }

  [[nodiscard]] int pointOf(int point, int fan) const
  {
    const auto parted = ofPoint_.find(point);
    return parted == ofPoint_.end() ? point : parted->second.at(fan).point;
  }

private:
  struct Fan
  {
    Eigen::Vector3d middles = Eigen::Vector3d::Zero(); // their sum
    int triangles = 0;
    int point = -1;
  };
  std::vector<Eigen::Vector3d>& points_;
  std::map<int, std::map<int, Fan>> ofPoint_;
};

// cuts a triangle off all others
void isolate(int triangle, Edges& edges)
{
  for (int& other : edges.across[at(triangle)])
  {
    if (other >= 0)
    {
      std::ranges::replace(edges.across[at(other)], triangle, -1);
      other = -1;
    }
  }
}

// gives each fan its own points
std::size_t partFans(
  std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles, const Edges& edges)
{
  const auto numbers = fansOf(triangles, edges);
  Fans fans(points, triangles, numbers);
  const std::size_t added = fans.part();
  for (std::size_t i = 0; i < triangles.size() && added > 0; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      triangles[i][k] = fans.pointOf(triangles[i][k], numbers[i][k]);
    }
  }
  return added;
}

} // namespace

std::size_t splitNonManifold(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles)
{
  Edges edges = edgesOf(points.size(), triangles);
  for (const std::vector<Side>& sides : unpairedSides(triangles, edges))
  {
    sides.size() > 1 ? joinWedges(points, triangles, sides, edges) : void();
  }
  const std::size_t added = partFans(points, triangles, edges);
  // what hangs together around both ends of such an edge can only be torn
  edges = edgesOf(points.size(), triangles);
  if (edges.crowded == 0)
  {
    return added;
  }
  for (const std::vector<Side>& sides : unpairedSides(triangles, edges))
  {
    for (std::size_t i = 1; i < sides.size(); ++i)
    {
      isolate(sides[i].triangle, edges);
    }
  }
  return added + partFans(points, triangles, edges);
}

} // namespace palp
