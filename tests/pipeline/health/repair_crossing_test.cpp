#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"
#include "tests/pipeline/health/faulty_meshes.h"

#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

using Corners = std::array<Vector3d, 3>;

using Long = Eigen::Matrix<long double, 3, 1>;

// six times the volume over a triangle; of single precision it is exact but for the last bits
long double volumeOver(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& x)
{
  const Long o = x.cast<long double>();
  return (a.cast<long double>() - o)
    .dot((b.cast<long double>() - o).cross(c.cast<long double>() - o));
}

// Whether the line from a to b goes through the inside of a triangle. What ends at it, to a
// millionth of its length, only touches it.
bool pierces(const Vector3d& a, const Vector3d& b, const Corners& t)
{
  const long double above = volumeOver(t[0], t[1], t[2], a);
  const long double below = volumeOver(t[0], t[1], t[2], b);
  const double touching = 1e-6 * (b - a).norm() * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  const long double first = volumeOver(a, b, t[0], t[1]);
  return above * below < 0.0L && std::min(std::abs(above), std::abs(below)) > touching &&
    first * volumeOver(a, b, t[1], t[2]) > 0.0L && first * volumeOver(a, b, t[2], t[0]) > 0.0L;
}

bool cross(const Corners& one, const Corners& other)
{
  std::size_t shared = 0;
  bool found = false;
  for (std::size_t k = 0; k < 3; ++k)
  {
    shared += static_cast<std::size_t>(std::ranges::count(other, one[k]));
    const std::size_t next = (k + 1) % 3;
    found |= pierces(one[k], one[next], other) || pierces(other[k], other[next], one);
  }
  return shared < 2 && found;
}

// triangles that pass through others, each with each
std::size_t crossingIn(const std::vector<Vector3d>& points, const std::vector<Triangle>& triangles)
{
  std::vector<Corners> all;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Triangle& t : triangles)
  {
    Corners& corners = all.emplace_back();
    Eigen::AlignedBox3d& box = boxes.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[k] = points[at(t[k])].cast<float>().cast<double>(); // as files have it
      box.extend(corners[k]);
    }
  }
  std::set<std::size_t> found;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (std::size_t j = i + 1; j < all.size(); ++j)
    {
      if (boxes[i].intersects(boxes[j]) && cross(all[i], all[j]))
      {
        found.insert(i);
        found.insert(j);
      }
    }
  }
  return found.size();
}

// A surface with faults by the hundred.
class Damaged
{
public:
  Damaged(Mesh mesh, unsigned seed)
    : mesh_(std::move(mesh))
    , random_(seed)
  {
    for (const auto& [a, b, c] : mesh_.triangles)
    {
      edge_ += (mesh_.points[at(b)] - mesh_.points[at(a)]).norm() /
        static_cast<double>(mesh_.triangles.size());
    }
  }

  Damaged& shake(double share, double edges)
  {
    for (Vector3d& point : mesh_.points)
    {
      isOne(share) ? void(point += edges * edge_ * any()) : void();
    }
    return *this;
  }

  // points within triangles, near a corner or an edge
  Damaged& addSlivers(int count)
  {
    constexpr double kNear = 0.004;
    for (int i = 0; i < count; ++i)
    {
      Triangle& t = mesh_.triangles[random_() % mesh_.triangles.size()];
      const auto [a, b, c] = t;
      const Vector3d along = mesh_.points[at(b)] - mesh_.points[at(a)];
      const Vector3d in = mesh_.points[at(c)] - mesh_.points[at(a)];
      const auto n = static_cast<int>(mesh_.points.size());
      mesh_.points.emplace_back(
        mesh_.points[at(a)] + (isOne(0.5) ? kNear : 0.5) * along + kNear * in);
      t = { a, b, n };
      mesh_.triangles.insert(mesh_.triangles.end(), { { b, c, n }, { c, a, n } });
    }
    return *this;
  }

  Damaged& cut(double share)
  {
    std::erase_if(mesh_.triangles, [&](const Triangle&) { return isOne(share); });
    return *this;
  }

  // what is done may leave no triangle more that passes through another
  void expectNoWorse(const char* what)
  {
    const auto count = [](const std::vector<Vector3d>& points, const std::vector<Triangle>& all)
    {
      const MeshHealth health = palp::healthOf(points, all);
      const Finding* found = health.find(Fault::SelfIntersection);
      return found == nullptr ? 0 : found->count;
    };
    const RepairedMesh repaired = repairedOf(mesh_, 0.02);
    EXPECT_LE(
      crossingIn(repaired.points, repaired.triangles), crossingIn(mesh_.points, mesh_.triangles))
      << what;
    EXPECT_LE(count(repaired.points, repaired.triangles), count(mesh_.points, mesh_.triangles))
      << what;
  }

private:
  bool isOne(double share)
  {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share;
  }

  Vector3d any()
  {
    std::normal_distribution<double> normal;
    return { normal(random_), normal(random_), normal(random_) };
  }

  Mesh mesh_;
  std::mt19937 random_;
  double edge_ = 0.0;
};

// the walls of voxels of 1 mm that are set by chance: many meet in edges and points only
Mesh wallsOfVoxels(unsigned seed)
{
  constexpr int n = 8;
  std::mt19937 random(seed);
  std::set<std::array<int, 3>> body;
  for (int i = 0; i < n * n * n; ++i)
  {
    random() % 2 == 0 ? void(body.insert({ i % n, i / n % n, i / n / n })) : void();
  }
  Mesh mesh;
  std::map<std::array<int, 3>, int> known;
  for (const std::array<int, 3>& voxel : body)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const int side : { 0, 1 })
      {
        std::array<int, 3> behind = voxel;
        behind[axis] += 2 * side - 1;
        if (body.contains(behind))
        {
          continue;
        }
        std::array<int, 4> corners{};
        for (std::size_t k = 0; k < 4; ++k)
        {
          std::array<int, 3> corner = voxel;
          corner[axis] += side;
          corner[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
          corner[(axis + 2) % 3] += k >= 2 ? 1 : 0;
          const auto [at, isNew] = known.try_emplace(corner, static_cast<int>(mesh.points.size()));
          isNew
            ? void(mesh.points.emplace_back(1e-3 * corner[0], 1e-3 * corner[1], 1e-3 * corner[2]))
            : void();
          corners[side == 1 ? k : 3 - k] = at->second;
        }
        mesh.triangles.push_back({ corners[0], corners[1], corners[2] });
        mesh.triangles.push_back({ corners[0], corners[2], corners[3] });
      }
    }
  }
  return mesh;
}

// cones of several widths, one in the other, which share their apex
Mesh nestedCones(unsigned seed)
{
  std::mt19937 random(seed);
  Mesh mesh{ .points = { Vector3d::Zero() }, .triangles = {} };
  constexpr int corners = 9;
  for (const double radius : { 4e-3, 8e-3, 12e-3 })
  {
    const auto first = static_cast<int>(mesh.points.size());
    const double height = 1e-2 * (1.0 + 0.5 * static_cast<double>(random() % 4));
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * i / corners;
      mesh.points.emplace_back(
        height * Vector3d(100.0 * radius * std::cos(angle), 100.0 * radius * std::sin(angle), 1.0));
      mesh.triangles.push_back({ 0, first + i, first + (i + 1) % corners });
    }
  }
  return mesh;
}

TEST(MeshRepair, LetsNoTriangleMorePassThroughAnother)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    Damaged(makeSphere(0.03, 3), seed)
      .shake(0.3, 0.6)
      .addSlivers(60)
      .cut(0.02)
      .expectNoWorse("shaken");
    Damaged(makeSphere(0.03, 3), seed).shake(0.02, 2.0).addSlivers(150).expectNoWorse("folded");
    Mesh lobes = makeSphere(0.03, 3);
    add(lobes, makeSphere(0.02, 3), { 0.015, 0.01, 0.004 * seed });
    Damaged(lobes, seed).addSlivers(80).cut(0.01).expectNoWorse("lobes");
    Damaged(wallsOfVoxels(seed), seed).expectNoWorse("voxels");
    Damaged(nestedCones(seed), seed).expectNoWorse("cones");
  }
}

// what is left is told: two lids of a box would cross a plate that stands in its opening
TEST(MeshRepair, LeavesAHoleThatCannotBeClosedWithoutCrossing)
{
  Mesh box = cube();
  std::erase_if(box.triangles,
    [&](const Triangle& t)
    { return std::ranges::all_of(t, [&](int i) { return box.points[at(i)].z() == 0.0; }); });
  EXPECT_EQ(repairedOf(box, 10.0).filled, 1U);
  const auto n = static_cast<int>(box.points.size());
  for (const Vector3d& x :
    { Vector3d(-0.2, 0.1, -0.5), Vector3d(0.3, 0.1, -0.5), Vector3d(0, 0.1, 0.5) })
  {
    box.points.push_back(x);
  }
  box.triangles.push_back({ n, n + 1, n + 2 });
  const RepairedMesh left = repairedOf(box, 10.0);
  EXPECT_EQ(left.filled, 0U);
  EXPECT_EQ(left.holesLeft, 1U);
}

// as it is where the file is pressed
TEST(MeshRepair, LeavesOutAPieceThatIsAPartOfAnother)
{
  Mesh mesh = makeSphere(0.03, 3);
  const std::size_t triangles = mesh.triangles.size();
  const auto n = static_cast<int>(mesh.points.size());
  for (int i = 0; i < n; ++i)
  {
    mesh.points.emplace_back(0.5 * mesh.points[at(i)]);
  }
  for (std::size_t i = 0; i < triangles; ++i)
  {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({ a + n, b + n, c + n });
  }
  const RepairedMesh mended = repairedOf(mesh);
  EXPECT_EQ(mended.triangles.size(), triangles);
  EXPECT_EQ(mended.points.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(mended.removed, triangles);
}

} // namespace
} // namespace palp::test
