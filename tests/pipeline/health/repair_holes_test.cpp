// Holes that meet, and what lies in them, on them or beside them: the body is whole afterwards, and
// nothing else is left.

#include "tests/pipeline/health/faulty_meshes.h"

#include <gtest/gtest.h>
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
  const auto [a, b, c] = mesh.triangles[0];
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

} // namespace
} // namespace palp::test
