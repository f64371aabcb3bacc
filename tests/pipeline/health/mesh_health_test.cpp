#include "pipeline/health/mesh_health.h"

#include "tests/pipeline/health/faulty_meshes.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <set>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

MeshHealth healthOf(const Mesh& mesh)
{
  return palp::healthOf(mesh.points, mesh.triangles);
}

// what was found, by name and count
std::string found(const MeshHealth& health)
{
  std::string all;
  for (const Finding& one : health.findings)
  {
    all += std::string(nameOf(one.fault)) + " " + std::to_string(one.count) + "; ";
  }
  return all;
}

TEST(MeshHealth, OfASphereIsPerfect)
{
  const Mesh sphere = makeSphere(0.03, 4);
  const MeshHealth health = healthOf(sphere);
  EXPECT_EQ(found(health), "");
  ASSERT_EQ(health.pieces.size(), 1U);
  EXPECT_TRUE(health.pieces[0].closed);
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(0.03, 3);
  EXPECT_LT(health.pieces[0].volume, ball);
  EXPECT_GT(health.pieces[0].volume, 0.98 * ball);
  EXPECT_EQ(health.edgeLengths.size(), 30U << 8U); // 30 of the icosahedron, four times as many each
  EXPECT_NEAR((health.high - health.low).maxCoeff(), 0.06, 1e-4);
}

// as STL has it: three points a triangle
Mesh loosened(const Mesh& mesh)
{
  Mesh loose;
  for (const Triangle& triangle : mesh.triangles)
  {
    const auto first = static_cast<int>(loose.points.size());
    for (const int corner : triangle)
    {
      loose.points.push_back(mesh.points[at(corner)]);
    }
    loose.triangles.push_back({ first, first + 1, first + 2 });
  }
  return loose;
}

TEST(MeshHealth, OfLooseTrianglesIsThatOfThoseThatShareTheirPoints)
{
  Mesh sphere = makeSphere(0.03, 3);
  const MeshHealth whole = healthOf(loosened(sphere));
  EXPECT_EQ(found(whole), "");
  EXPECT_EQ(whole.points, sphere.points.size());
  EXPECT_EQ(whole.pieces.size(), 1U);

  std::swap(sphere.triangles[7][0], sphere.triangles[7][1]);
  sphere.triangles.push_back(sphere.triangles[90]);
  sphere.triangles.erase(sphere.triangles.begin() + 200);
  EXPECT_NE(found(healthOf(sphere)), "");
  EXPECT_EQ(found(healthOf(loosened(sphere))), found(healthOf(sphere)));
}

TEST(MeshHealth, WherePointsAreSharedTwoAtAPlaceAreAFault)
{
  Mesh loose = loosened(makeSphere(0.03, 3));
  loose.triangles.push_back(loose.triangles.back());
  EXPECT_NE(healthOf(loose).find(Fault::DuplicatePoint), nullptr);
}

TEST(MeshHealth, CountsHolesAndMeasuresTheWidest)
{
  Mesh sphere = makeSphere(0.03, 3);
  // one triangle here, all of a point's there
  const Vector3d top = sphere.points[at(sphere.triangles[200][0])];
  const Triangle gone = sphere.triangles[900];
  sphere.triangles.erase(sphere.triangles.begin() + 900);
  const int hub = sphere.triangles[200][0];
  double around = 0.0;
  std::erase_if(sphere.triangles,
    [&](const Triangle& t)
    {
      const auto corner = std::ranges::find(t, hub) - t.begin();
      if (corner == 3)
      {
        return false;
      }
      const auto k = static_cast<std::size_t>(corner);
      around += (sphere.points[at(t[(k + 1) % 3])] - sphere.points[at(t[(k + 2) % 3])]).norm();
      return true;
    });
  ASSERT_EQ(std::ranges::count(gone, hub), 0);
  const MeshHealth health = healthOf(sphere);
  EXPECT_EQ(found(health), "unused point 1; hole 2; ");
  const Finding* holes = health.find(Fault::Hole);
  ASSERT_NE(holes, nullptr);
  EXPECT_NEAR(holes->size, around, 1e-6 * around);
  EXPECT_LT((holes->place - top).norm(), 0.2 * around);
  EXPECT_FALSE(health.pieces[0].closed);
}

TEST(MeshHealth, CountsWhatIsThereTwiceAndWhatFacesTheOtherWay)
{
  Mesh sphere = makeSphere(0.03, 3);
  std::mt19937 random(3);
  std::set<std::size_t> flipped;
  while (flipped.size() < 40)
  {
    flipped.insert(random() % sphere.triangles.size());
  }
  for (const std::size_t i : flipped)
  {
    std::swap(sphere.triangles[i][0], sphere.triangles[i][1]);
  }
  for (std::size_t i = 0; i < 7; ++i)
  {
    Triangle again = sphere.triangles[100 * i];
    std::rotate(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(i % 3), again.end());
    i % 2 == 0 ? void() : std::swap(again[0], again[1]);
    sphere.triangles.push_back(again);
  }
  const MeshHealth health = healthOf(sphere);
  EXPECT_EQ(found(health), "duplicate triangle 7; flipped triangle 40; ");
  const Finding* turned = health.find(Fault::Flipped);
  EXPECT_EQ(std::set<std::size_t>(turned->triangles.begin(), turned->triangles.end()), flipped);
}

TEST(MeshHealth, SeesWherePartsMeetInAnEdgeOrAPointOnly)
{
  Mesh edge = cube();
  add(edge, cube(), { 1.0, 1.0, 0.0 });
  EXPECT_EQ(found(healthOf(edge)), "duplicate point 2; non-manifold edge 1; ");
  Mesh point = cube();
  add(point, cube(), { 1.0, 1.0, 1.0 });
  EXPECT_EQ(found(healthOf(point)), "duplicate point 1; non-manifold point 1; ");
}

TEST(MeshHealth, SeesThinTriangles)
{
  Mesh flat{ .points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0.009, 0 }, { 0.5, -0.011, 0 },
               { 0.5, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } },
    .triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 4, 5, 6 }, { 5, 5, 6 } } };
  const MeshHealth health = healthOf(flat);
  ASSERT_NE(health.find(Fault::Degenerate), nullptr);
  EXPECT_EQ(health.find(Fault::Degenerate)->triangles, (std::vector{ 2, 3 }));
  ASSERT_NE(health.find(Fault::Sliver), nullptr);
  EXPECT_EQ(health.find(Fault::Sliver)->triangles, std::vector{ 0 });
}

// Mirrored bodies meet edge to edge: a triangle passes through its mirror image where it has
// corners on both sides of the mirror. As they lie, and turned, so that rounding differs.
TEST(MeshHealth, FindsTheTrianglesThatMeetOthersEdgeToEdge)
{
  for (const double apart : { 0.02, 0.035, 0.0533 })
  {
    Mesh balls = makeSphere(0.03, 4);
    const std::size_t first = balls.triangles.size();
    const auto count = static_cast<int>(balls.points.size());
    for (int i = 0; i < count; ++i)
    {
      const Vector3d x = balls.points[at(i)];
      balls.points.emplace_back(apart - x.x(), x.y(), x.z());
    }
    std::set<int> expected;
    for (std::size_t i = 0; i < first; ++i)
    {
      const auto [a, b, c] = balls.triangles[i];
      balls.triangles.push_back({ count + c, count + b, count + a });
      const auto isBehind = [&](int corner) { return balls.points[at(corner)].x() > 0.5 * apart; };
      if (const int behind = isBehind(a) + isBehind(b) + isBehind(c); behind % 3 > 0)
      {
        expected.insert({ static_cast<int>(i), static_cast<int>(first + i) });
      }
    }
    for (int turn = 0; turn < 8; ++turn)
    {
      const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(0.7 * turn, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
      Mesh mesh = balls;
      std::ranges::for_each(mesh.points, [&](Vector3d& x) { x = turned * x; });
      const MeshHealth health = healthOf(mesh);
      const Finding* crossing = health.find(Fault::SelfIntersection);
      ASSERT_NE(crossing, nullptr) << apart << ' ' << turn;
      EXPECT_EQ(std::set<int>(crossing->triangles.begin(), crossing->triangles.end()), expected)
        << apart << ' ' << turn;
    }
  }
}

// edges that meet the diagonals of faces; and edges that touch from outside
TEST(MeshHealth, TellsBlocksThatOverlapFromSuchThatTouch)
{
  for (int turn = 0; turn < 8; ++turn)
  {
    const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.9 * turn, Vector3d(3.0, 1.0, 2.0).normalized()).toRotationMatrix();
    const auto isCrossing = [&](const Eigen::Matrix3d& second, const Vector3d& shift)
    {
      Mesh blocks = cube();
      Mesh other = cube();
      std::ranges::for_each(other.points, [&](Vector3d& x) { x = second * x; });
      add(blocks, other, shift);
      std::ranges::for_each(blocks.points, [&](Vector3d& x) { x = turned * x; });
      return healthOf(blocks).find(Fault::SelfIntersection) != nullptr;
    };
    const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d onEdge =
      Eigen::AngleAxisd(0.25 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
    EXPECT_TRUE(isCrossing(upright, { 0.5, 0.5, 0.5 })) << turn;
    EXPECT_TRUE(isCrossing(upright, { 0.5, -0.5, 0.5 })) << turn;
    EXPECT_TRUE(isCrossing(upright, { 0.5, 0.25, 0.5 })) << turn;
    // the lower edge of the second on that of the first, across it
    const Vector3d low = onEdge * Vector3d(0.0, 0.5, -1.0);
    const Vector3d high = onEdge * Vector3d(0.0, -0.5, -1.0);
    const Vector3d lowest = low.z() < high.z() ? low : high;
    EXPECT_FALSE(isCrossing(onEdge, Vector3d(0.5, 0.0, 0.0) - lowest)) << turn;
    EXPECT_TRUE(isCrossing(onEdge, Vector3d(0.5, 0.0, -0.01) - lowest)) << turn;
  }
}

// two balls that pass through each other meet in a circle
TEST(MeshHealth, FindsTheTrianglesThatPassThroughOthers)
{
  constexpr double radius = 0.03;
  constexpr double apart = 0.035;
  Mesh balls = makeSphere(radius, 4);
  const std::size_t first = balls.triangles.size();
  add(balls, makeSphere(radius, 3), { apart, 0.0, 0.0 });
  const MeshHealth health = healthOf(balls);
  const Finding* crossing = health.find(Fault::SelfIntersection);
  ASSERT_NE(crossing, nullptr);
  const double circle = std::sqrt(radius * radius - 0.25 * apart * apart);
  const std::set<int> marked(crossing->triangles.begin(), crossing->triangles.end());
  const double edge = health.edgeLengths.back();
  int sure = 0;
  for (std::size_t i = 0; i < balls.triangles.size(); ++i)
  {
    int inside = 0;
    int outside = 0;
    for (const int corner : balls.triangles[i])
    {
      const Vector3d& x = balls.points[at(corner)];
      const Vector3d other(i < first ? apart : 0.0, 0.0, 0.0);
      constexpr double rough = 0.03; // of the radius, by which facets lie below the ball
      inside += (x - other).norm() < (1.0 - rough) * radius;
      outside += (x - other).norm() > radius;
      if (marked.contains(static_cast<int>(i)))
      {
        const double off = std::hypot(x.x() - 0.5 * apart, std::hypot(x.y(), x.z()) - circle);
        EXPECT_LT(off, 1.5 * edge) << i;
      }
    }
    if (inside > 0 && outside > 0)
    {
      ++sure;
      EXPECT_TRUE(marked.contains(static_cast<int>(i))) << i;
    }
  }
  EXPECT_GT(sure, 20);
}

TEST(MeshHealth, TellsAPieceWithinAnotherFromAHollow)
{
  Mesh nested = makeSphere(0.03, 3);
  Mesh inner = makeSphere(0.01, 2);
  add(nested, inner, Vector3d::Zero());
  EXPECT_EQ(found(healthOf(nested)), "inner piece 1; ");
  Mesh hollow = makeSphere(0.03, 3);
  for (Triangle& t : inner.triangles)
  {
    std::swap(t[0], t[1]);
  }
  add(hollow, inner, Vector3d::Zero());
  EXPECT_EQ(found(healthOf(hollow)), "");
  EXPECT_EQ(healthOf(hollow).pieces.size(), 2U);
}

} // namespace
} // namespace palp::test
