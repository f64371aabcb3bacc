// Holes that meet, and what lies in them, on them or beside them: the body is whole afterwards, and
// nothing else is left.

#include "pipeline/health/fill_holes.h"
#include "tests/pipeline/health/faulty_meshes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

constexpr double kAnyHole = 1.0; // [m]

const Mesh& sphere()
{
  static const Mesh mesh = makeSphere(0.03, 3); // edges of 4 to 5 mm
  return mesh;
}

// the sphere, its own triangles and no other piece
void expectSphere(const Mesh& mesh, double largestHole)
{
  const RepairedMesh mended = repairedOf(mesh, largestHole);
  const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
  for (const Finding& finding : health.findings)
  {
    ADD_FAILURE() << nameOf(finding.fault) << ": " << finding.count;
  }
  EXPECT_EQ(health.points, sphere().points.size());
  EXPECT_EQ(health.triangles, sphere().triangles.size());
  EXPECT_EQ(health.pieces.size(), 1U);
  const double volume = volumeOf(sphere().points, sphere().triangles);
  EXPECT_NEAR(volumeOf(mended.points, mended.triangles), volume, 1e-4 * volume);
}

void expectSphere(const Mesh& mesh)
{
  expectSphere(mesh, 0.0);
  expectSphere(mesh, kAnyHole); // more is asked for, and nothing is worse
}

std::size_t sharedBy(const Triangle& one, const Triangle& other)
{
  return static_cast<std::size_t>(
    std::ranges::count_if(one, [&](int i) { return std::ranges::count(other, i) > 0; }));
}

// the triangles on the three sides of one, which is left hanging by its corners
TEST(MeshRepair, ClosesHolesAroundATriangle)
{
  for (const std::size_t middle : { 0U, 303U, 700U })
  {
    Mesh mesh = sphere();
    const Triangle hanging = mesh.triangles[middle];
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return sharedBy(t, hanging) == 2; });
    ASSERT_EQ(mesh.triangles.size() + 3, sphere().triangles.size());
    EXPECT_EQ(palp::healthOf(mesh.points, mesh.triangles).find(Fault::Hole)->count, 3U);
    expectSphere(mesh, kAnyHole);
    expectSphere(mesh, 0.016); // around one of them, less than around all
  }
}

// every second of the triangles around a point, or two that only share it
TEST(MeshRepair, ClosesHolesThatMeetAtAPoint)
{
  for (int point = 12; point < 600; point += 40) // of six triangles, as all but the first twelve
  {
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < sphere().triangles.size(); ++i)
    {
      std::ranges::count(sphere().triangles[i], point) > 0 ? around.push_back(i) : void();
    }
    ASSERT_EQ(around.size(), 6U);
    Mesh mesh = sphere();
    std::size_t removed = 0;
    std::vector<Triangle> gone;
    for (const std::size_t i : around)
    {
      const Triangle t = sphere().triangles[i];
      if (std::ranges::all_of(gone, [&](const Triangle& other) { return sharedBy(t, other) == 1; }))
      {
        gone.push_back(t);
        std::erase(mesh.triangles, t);
        ++removed;
      }
    }
    EXPECT_GE(removed, 2U);
    const MeshHealth health = palp::healthOf(mesh.points, mesh.triangles);
    EXPECT_EQ(health.find(Fault::Hole)->count, removed);
    expectSphere(mesh, kAnyHole);
  }
}

TEST(MeshRepair, LeavesOutWhatIsThereTwiceInASoupBeforeHolesAreClosed)
{
  for (const double off : { 1e-8, 1e-6 })
  {
    Mesh mesh = soupOf(sphere(), off, 1);
    for (const std::size_t i : { 3U, 100U, 500U, 900U })
    {
      const auto [a, b, c] = mesh.triangles[i];
      mesh.triangles.push_back({ c, b, a });
    }
    expectSphere(mesh);
  }
}

// three more sides below a triangle make a body of their own, which hides that it is one of a soup
TEST(MeshRepair, SewsTrianglesThatHaveATetrahedronBelow)
{
  for (const double off : { 1e-8, 1e-6 })
  {
    Mesh mesh = soupOf(sphere(), off, 2);
    for (const std::size_t i : { 20U, 400U, 800U })
    {
      const auto [a, b, c] = mesh.triangles[i];
      const auto n = static_cast<int>(mesh.points.size());
      mesh.points.emplace_back(
        0.97 / 3.0 * (mesh.points[at(a)] + mesh.points[at(b)] + mesh.points[at(c)]));
      mesh.triangles.insert(mesh.triangles.end(), { { a, b, n }, { b, c, n }, { c, a, n } });
    }
    expectSphere(mesh);
  }
}

// triangles with two corners at one place, which a soup moves apart
TEST(MeshRepair, LeavesOutNeedlesOfASoup)
{
  for (const double off : { 1e-8, 1e-6 })
  {
    Mesh mesh = sphere();
    for (const std::size_t i : { 10U, 200U, 1000U })
    {
      const Triangle& t = sphere().triangles[i];
      mesh.triangles.push_back({ t[0], t[0], t[1] });
    }
    expectSphere(soupOf(mesh, off, 3));
  }
}

// whole, or half of it, a hair above
TEST(MeshRepair, LeavesOutATriangleThatLiesOnTheSurface)
{
  for (const double off : { 1e-9, 1e-7, 1e-6 })
  {
    for (const double size : { 1.0, 0.5 })
    {
      Mesh mesh = sphere();
      const Triangle t = sphere().triangles[7];
      const auto n = static_cast<int>(mesh.points.size());
      for (const int corner : t)
      {
        const Vector3d& first = sphere().points[at(t[0])];
        mesh.points.emplace_back((1.0 + off / 0.03) * // of its radius
          (first + size * (sphere().points[at(corner)] - first)));
      }
      mesh.triangles.push_back({ n, n + 1, n + 2 });
      expectSphere(mesh);
    }
  }
}

// Of two triangles at an edge each has a point on it that the other does not know, and each is
// there twice, once reversed: without those there is a hole of no area, to be cut and not filled.
TEST(MeshRepair, CutsAtPointsOnAnEdgeBeforeHolesAreClosed)
{
  Mesh mesh = cube();
  const int a = mesh.triangles[0][0];
  const int b = mesh.triangles[0][1];
  const int c = mesh.triangles[0][2];
  const auto other = std::ranges::find_if(mesh.triangles.begin() + 1, mesh.triangles.end(),
    [&](const Triangle& t) { return std::ranges::count(t, a) + std::ranges::count(t, b) == 2; });
  const int d = *std::ranges::find_if(*other, [&](int i) { return i != a && i != b; });
  const auto m = static_cast<int>(mesh.points.size());
  for (const double share : { 0.36, 0.8 })
  {
    mesh.points.emplace_back((1.0 - share) * mesh.points[at(a)] + share * mesh.points[at(b)]);
  }
  *other = { b, m + 1, d };
  mesh.triangles[0] = { a, m, c };
  const std::vector<Triangle> around = { { a, m, c }, { m, b, c }, { b, m + 1, d },
    { m + 1, a, d } };
  mesh.triangles.insert(mesh.triangles.end(), { around[1], around[3] });
  for (const auto& [e, f, g] : around)
  {
    mesh.triangles.push_back({ g, f, e });
  }
  for (const double largestHole : { 0.0, 10.0 })
  {
    const RepairedMesh mended = repairedOf(mesh, largestHole);
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    EXPECT_TRUE(health.findings.empty()) << nameOf(health.findings.front().fault);
    ASSERT_EQ(health.pieces.size(), 1U);
    EXPECT_TRUE(health.pieces[0].closed);
    EXPECT_NEAR(health.pieces[0].volume, 1.0, 1e-6);
  }
}

// but not what stands off it
TEST(MeshRepair, KeepsALooseTriangle)
{
  Mesh mesh = sphere();
  const auto n = static_cast<int>(mesh.points.size());
  for (const int corner : sphere().triangles[7])
  {
    mesh.points.emplace_back(1.02 * sphere().points[at(corner)]); // 0.6 mm
  }
  mesh.triangles.push_back({ n, n + 1, n + 2 });
  EXPECT_EQ(repairedOf(mesh).triangles.size(), mesh.triangles.size());
}

// of any simple polygon in a plane every triangulation has the area that the shoelace formula gives
TEST(MeshRepair, FillsAStarByItsArea)
{
  std::vector<Vector3d> points;
  std::vector<int> chain;
  const Eigen::Matrix3d tilt =
    Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  double twice = 0.0;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  constexpr int corners = 17;
  for (int i = 0; i <= 2 * corners; ++i)
  {
    const double angle = std::numbers::pi * i / corners;
    const double r = i % 2 == 0 ? 1.0 : 0.35;
    const Eigen::Vector2d x(r * std::cos(angle), r * std::sin(angle));
    twice += i > 0 ? last.x() * x.y() - last.y() * x.x() : 0.0;
    last = x;
    if (i < 2 * corners)
    {
      points.emplace_back(tilt * Vector3d(x.x(), x.y(), 0.0));
      chain.push_back(i);
    }
  }
  const std::vector<Triangle> filling = smallestFilling(points, chain);
  EXPECT_EQ(filling.size(), chain.size() - 2);
  double area = 0.0;
  for (const auto& [a, b, c] : filling)
  {
    area += 0.5 * (points[at(b)] - points[at(a)]).cross(points[at(c)] - points[at(a)]).norm();
  }
  EXPECT_NEAR(area, 0.5 * twice, 1e-12);
}

// the caps of a ball that is cut by planes; the lids are flat
TEST(MeshRepair, ClosesHolesUpToALength)
{
  constexpr double radius = 0.03;
  Mesh ball = makeSphere(radius, 4);
  std::erase_if(ball.triangles,
    [&](const Triangle& t)
    {
      const auto highest = [&](auto coordinate)
      {
        return std::max({ coordinate(ball.points[at(t[0])]), coordinate(ball.points[at(t[1])]),
          coordinate(ball.points[at(t[2])]) });
      };
      return highest([](const Vector3d& x) { return x.z(); }) > 0.9 * radius ||
        highest([](const Vector3d& x) { return -x.x(); }) > 0.6 * radius;
    });
  const double small = 2.0 * std::numbers::pi * radius * std::sqrt(1.0 - 0.9 * 0.9);
  const double wide = 2.0 * std::numbers::pi * radius * 0.8;
  EXPECT_EQ(repairedOf(ball, 0.5 * small).filled, 0U);
  EXPECT_EQ(repairedOf(ball, 0.5 * (small + wide)).filled, 1U);
  const RepairedMesh whole = repairedOf(ball, 2.0 * wide);
  EXPECT_EQ(whole.filled, 2U);
  EXPECT_TRUE(palp::healthOf(whole.points, whole.triangles).findings.empty());
  const auto cap = [](double share) // of a unit ball beyond a plane, height h: pi h^2 (3 - h) / 3
  { return std::numbers::pi * (1.0 - share) * (1.0 - share) * (2.0 + share) / 3.0; };
  const double expected =
    (4.0 / 3.0 * std::numbers::pi - cap(0.88) - cap(0.57)) * std::pow(radius, 3);
  EXPECT_NEAR(volumeOf(whole.points, whole.triangles), expected, 0.03 * expected);
}

// as a scan ends below: two sides of a triangle that stays may follow one another around the hole,
// whose third side must not be made again
TEST(MeshRepair, ClosesJaggedCuts)
{
  constexpr double radius = 0.03;
  for (const int level : { 3, 4, 5 })
  {
    const Mesh whole = makeSphere(radius, level);
    for (const double share : { -0.66, -0.33, -0.17, 0.0, 0.17, 0.33, 0.5, 0.66 })
    {
      Mesh cut = whole;
      std::erase_if(cut.triangles,
        [&](const Triangle& t)
        {
          const Vector3d sum = cut.points[at(t[0])] + cut.points[at(t[1])] + cut.points[at(t[2])];
          return sum.z() / 3.0 >= share * radius;
        });
      const RepairedMesh closed = repairedOf(cut, 1.0);
      EXPECT_EQ(closed.filled, 1U) << level << ' ' << share;
      EXPECT_EQ(closed.holesUnfit, 0U);
      const double part = (2.0 + share) * (1.0 - share) * (1.0 - share) / 4.0; // that is cut off
      const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
      EXPECT_NEAR(volumeOf(closed.points, closed.triangles) / ball, 1.0 - part,
        2.5 * std::pow(0.5, level)) // an edge
        << level << ' ' << share;
    }
  }
}

} // namespace
} // namespace palp::test
