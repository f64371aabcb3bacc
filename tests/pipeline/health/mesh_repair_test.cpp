#include "pipeline/health/mesh_repair.h"

#include "pipeline/health/mesh_health.h"
#include "tests/pipeline/health/faulty_meshes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

MeshHealth healthOf(const RepairedMesh& mesh)
{
  return palp::healthOf(mesh.points, mesh.triangles);
}

TEST(MeshRepair, LeavesAPerfectSurfaceAlone)
{
  const Mesh sphere = makeSphere(0.03, 3);
  const RepairedMesh same = repairedOf(sphere, 1.0);
  ASSERT_EQ(same.triangles.size(), sphere.triangles.size());
  for (std::size_t i = 0; i < sphere.triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Vector3d& before = sphere.points[at(sphere.triangles[i][k])];
      EXPECT_LT((same.points[at(same.triangles[i][k])] - before).norm(), 1e-8); // single precision
    }
  }
  EXPECT_EQ(same.merged + same.removed + same.slivers + same.split + same.filled + same.turned, 0U);
}

TEST(MeshRepair, MergesRemovesAndTurns)
{
  const Mesh sphere = makeSphere(0.03, 3);
  Mesh faulty = sphere;
  faulty.points.emplace_back(1.0, 2.0, 3.0); // unused
  faulty.points.push_back(sphere.points[at(sphere.triangles[5][1])]);
  faulty.triangles[5][1] = static_cast<int>(faulty.points.size()) - 1; // at the place of another
  faulty.triangles.push_back(sphere.triangles[7]);
  faulty.triangles.push_back({ 3, 3, 4 });
  for (const std::size_t i : { 20U, 300U, 301U })
  {
    std::swap(faulty.triangles[i][1], faulty.triangles[i][2]);
  }
  const RepairedMesh mended = repairedOf(faulty);
  EXPECT_EQ(mended.merged, 2U);
  EXPECT_EQ(mended.removed, 2U);
  EXPECT_EQ(mended.turned, 3U);
  EXPECT_TRUE(healthOf(mended).findings.empty());
  EXPECT_NEAR(volumeOf(mended.points, mended.triangles), volumeOf(sphere.points, sphere.triangles),
    1e-6 * std::pow(0.03, 3));
}

// a body whose triangles, or halves, were written by themselves, each corner a little elsewhere
TEST(MeshRepair, WeldsSeamsButNoGap)
{
  const Mesh sphere = makeSphere(0.03, 3); // edges of 4 mm
  std::mt19937 random(5);
  for (const bool isSoup : { true, false })
  {
    for (const double off : { 1e-9, 1e-7, 5e-7, 1e-3 }) // [m]
    {
      std::uniform_real_distribution<double> by(-off, off);
      Mesh parts = sphere;
      std::map<int, int> upper;
      for (Triangle& corners : parts.triangles)
      {
        const bool isUp = sphere.points[at(corners[0])].z() > 0.0;
        for (int& corner : corners)
        {
          const Vector3d point =
            sphere.points[at(corner)] + Vector3d(by(random), by(random), by(random));
          const auto next = static_cast<int>(parts.points.size());
          const int copy = isSoup ? next
            : isUp                ? upper.try_emplace(corner, next).first->second
                                  : corner;
          copy == next ? parts.points.push_back(point) : void();
          corner = copy;
        }
      }
      const RepairedMesh mended = repairedOf(parts);
      if (off < 1e-4)
      {
        EXPECT_EQ(mended.points.size(), sphere.points.size()) << isSoup << off;
        EXPECT_TRUE(healthOf(mended).findings.empty()) << isSoup << off;
      }
      else
      {
        EXPECT_GT(mended.points.size(), sphere.points.size()) << isSoup << off;
      }
    }
  }
}

// two cubes side by side share a face, and a sheet of two sides encloses nothing
TEST(MeshRepair, JoinsBodiesThatShareAFace)
{
  Mesh both = cube();
  add(both, cube(), Vector3d::UnitX()); // its diagonals lie as those of the other
  const RepairedMesh bar = repairedOf(both);
  EXPECT_EQ(bar.removed, 4U);
  EXPECT_TRUE(healthOf(bar).findings.empty());
  EXPECT_EQ(healthOf(bar).pieces.size(), 1U);
  EXPECT_NEAR(volumeOf(bar.points, bar.triangles), 2.0, 1e-6);

  Mesh mirrored = cube(); // so that its diagonals are others
  for (Vector3d& point : mirrored.points)
  {
    point.y() = -point.y();
  }
  for (Triangle& t : mirrored.triangles)
  {
    std::swap(t[0], t[1]);
  }
  Mesh unlike = cube();
  add(unlike, mirrored, Vector3d::UnitX());
  const RepairedMesh second = repairedOf(unlike);
  EXPECT_TRUE(healthOf(second).findings.empty());
  EXPECT_NEAR(volumeOf(second.points, second.triangles), 2.0, 1e-6);

  const Mesh sheet{ .points = { Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY() },
    .triangles = { { 0, 1, 2 }, { 2, 1, 0 } } };
  EXPECT_EQ(repairedOf(sheet).triangles.size(), 1U);
}

TEST(MeshRepair, PartsBodiesThatTouch)
{
  for (const Vector3d& offset : { Vector3d(1.0, 1.0, 0.0), Vector3d(1.0, 1.0, 1.0) })
  {
    Mesh touching = cube();
    add(touching, cube(), offset);
    const RepairedMesh apart = repairedOf(touching);
    EXPECT_GT(apart.split, 0U);
    const MeshHealth health = healthOf(apart);
    EXPECT_TRUE(health.findings.empty()) << nameOf(health.findings.front().fault);
    ASSERT_EQ(health.pieces.size(), 2U);
    for (const MeshPiece& piece : health.pieces)
    {
      EXPECT_TRUE(piece.closed);
      EXPECT_NEAR(piece.volume, 1.0, 2e-3);
    }
  }
}

// a fin on an edge of a cube, which bounds nothing
TEST(MeshRepair, TakesAFinOffABody)
{
  Mesh mesh = cube();
  const auto a = static_cast<int>(mesh.points.size());
  const Triangle& side = mesh.triangles[0];
  const Vector3d middle(0.0, 0.0, -0.5); // of the cube
  const Vector3d edge = 0.5 * (mesh.points[at(side[0])] + mesh.points[at(side[1])]);
  mesh.points.emplace_back(middle + 3.0 * (edge - middle));
  mesh.triangles.push_back({ side[0], side[1], a });
  const MeshHealth health = healthOf(repairedOf(mesh));
  EXPECT_EQ(health.find(Fault::NonManifoldEdge), nullptr);
  EXPECT_EQ(health.find(Fault::NonManifoldPoint), nullptr);
  ASSERT_EQ(health.pieces.size(), 2U);
  EXPECT_TRUE(health.pieces[0].closed);
  EXPECT_NEAR(health.pieces[0].volume, 1.0, 2e-3);
  EXPECT_EQ(health.pieces[1].triangles, 1U);
}

// a point on an edge that only one of its triangles knows, with a triangle of no area between, and
// one that lies a hair beside another
TEST(MeshRepair, RemovesFlatTrianglesAndNeedles)
{
  Mesh mesh = makeSphere(0.03, 2);
  const double volume = volumeOf(mesh.points, mesh.triangles);
  const auto [a, b, c] = mesh.triangles[10];
  const auto m = static_cast<int>(mesh.points.size());
  mesh.points.emplace_back(0.5 * (mesh.points[at(a)] + mesh.points[at(b)]));
  mesh.triangles[10] = { a, m, c };
  mesh.triangles.push_back({ m, b, c });
  mesh.triangles.push_back({ a, b, m });
  const auto [d, e, f] = mesh.triangles[100];
  const auto n = m + 1;
  mesh.points.emplace_back(mesh.points[at(d)] + 1e-3 * (mesh.points[at(e)] - mesh.points[at(d)]) +
    1e-3 * (mesh.points[at(f)] - mesh.points[at(d)]));
  mesh.triangles[100] = { n, e, f };
  mesh.triangles.push_back({ d, e, n });
  mesh.triangles.push_back({ d, n, f });
  const MeshHealth before = palp::healthOf(mesh.points, mesh.triangles);
  ASSERT_NE(before.find(Fault::Degenerate), nullptr);
  ASSERT_NE(before.find(Fault::Sliver), nullptr);
  const RepairedMesh mended = repairedOf(mesh);
  EXPECT_GE(mended.slivers, 3U);
  EXPECT_TRUE(healthOf(mended).findings.empty());
  EXPECT_NEAR(volumeOf(mended.points, mended.triangles), volume, 1e-3 * volume);
}

// each of two needles has one end of its short side in the middle of an edge: that end goes
TEST(MeshRepair, TakesAPointAwayThatCutsAnEdgeNearItsEnd)
{
  Mesh sphere = makeSphere(0.06, 3);
  for (Eigen::Vector3d& x : sphere.points) // away from the origin, as a patient's axes are
  {
    x = (x + Eigen::Vector3d(0.005, -0.007, 0.9)).cast<float>().cast<double>();
  }
  const double volume = volumeOf(sphere.points, sphere.triangles);
  for (int i = 0; i < 40; ++i)
  {
    const auto [a, b, c] = sphere.triangles[at(31 * i)];
    for (const double part : { 1e-5, 1e-4, 1e-3, 9e-3, 0.991, 0.999, 0.9999, 0.99999 })
    {
      Mesh mesh = sphere;
      const auto m = static_cast<int>(mesh.points.size());
      mesh.points.emplace_back(
        mesh.points[at(a)] + part * (mesh.points[at(b)] - mesh.points[at(a)]));
      mesh.points.back() = mesh.points.back().cast<float>().cast<double>(); // as files round it
      for (std::size_t k = 0; k < sphere.triangles.size(); ++k)
      {
        Triangle& one = mesh.triangles[k];
        if (std::ranges::count(one, a) + std::ranges::count(one, b) == 2)
        {
          Triangle other = one;
          std::ranges::replace(one, a, m);
          std::ranges::replace(other, b, m);
          mesh.triangles.push_back(other);
        }
      }
      const RepairedMesh mended = repairedOf(mesh);
      EXPECT_EQ(mended.points.size(), sphere.points.size()) << i << ' ' << part;
      EXPECT_TRUE(healthOf(mended).findings.empty()) << i << ' ' << part;
      EXPECT_NEAR(volumeOf(mended.points, mended.triangles), volume, 1e-6 * volume);
    }
  }
}

// as CAD programs mesh them: nothing of their shape goes with the slivers
TEST(MeshRepair, KeepsCylindersAndPlatesOfLongTriangles)
{
  constexpr int kSides = 360;
  Mesh cylinder;
  for (const double z : { 0.0, 0.06 })
  {
    for (int i = 0; i < kSides; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * i / kSides;
      cylinder.points.emplace_back(0.03 * std::cos(angle), 0.03 * std::sin(angle), z);
    }
  }
  const int below = static_cast<int>(cylinder.points.size());
  cylinder.points.emplace_back(0.0, 0.0, 0.0);
  cylinder.points.emplace_back(0.0, 0.0, 0.06);
  for (int i = 0; i < kSides; ++i)
  {
    const int next = (i + 1) % kSides;
    cylinder.triangles.push_back({ below, next, i });
    cylinder.triangles.push_back({ below + 1, kSides + i, kSides + next });
    cylinder.triangles.push_back({ i, next, kSides + next });
    cylinder.triangles.push_back({ i, kSides + next, kSides + i });
  }
  const Mesh plate = makeBox({ 0.15, 0.15, 0.001 }, 0.2);
  for (const Mesh& mesh : { cylinder, plate })
  {
    ASSERT_NE(palp::healthOf(mesh.points, mesh.triangles).find(Fault::Sliver), nullptr);
    const double volume = volumeOf(mesh.points, mesh.triangles);
    const RepairedMesh mended = repairedOf(mesh);
    EXPECT_NEAR(volumeOf(mended.points, mended.triangles), volume, 1e-3 * volume);
  }
}

// whatever the triangles: what comes out is a manifold, or tells that it is none
TEST(MeshRepair, OfRandomTrianglesIsAManifold)
{
  int manifolds = 0;
  for (unsigned seed = 0; seed < 300; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-0.05, 0.05);
    Mesh mesh;
    const int points = std::uniform_int_distribution(4, 23)(random);
    std::uniform_int_distribution corner(0, points - 1);
    for (int i = 0; i < points; ++i)
    {
      mesh.points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    }
    for (int i = 0; i < 3 * points; ++i)
    {
      mesh.triangles.push_back({ corner(random), corner(random), corner(random) });
    }
    const RepairedMesh mended = repairedOf(mesh, 0.2);
    if (mended.splitLeft > 0) // of triangles by chance, which pass through each other everywhere
    {
      continue;
    }
    ++manifolds;
    const MeshHealth health = healthOf(mended);
    for (const Fault fault : { Fault::DuplicatePoint, Fault::UnusedPoint, Fault::DuplicateTriangle,
           Fault::NonManifoldEdge, Fault::NonManifoldPoint })
    {
      const Finding* one = health.find(fault);
      EXPECT_EQ(one, nullptr) << seed << ": " << nameOf(fault) << " " << (one ? one->count : 0);
    }
  }
  EXPECT_GE(manifolds, 200);
}

} // namespace
} // namespace palp::test
