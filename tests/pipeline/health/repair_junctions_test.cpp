// What meets at an edge that is not of two triangles: points of others on it, and fins.

#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"
#include "tests/pipeline/health/faulty_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

// divides a triangle at points of its own within its sides, their neighbors not knowing
void divide(Mesh& mesh, std::size_t triangle, const std::array<int, 3>& counts)
{
  const Triangle whole = mesh.triangles[triangle];
  const auto add = [&](const Vector3d& x)
  {
    mesh.points.push_back(x);
    return static_cast<int>(mesh.points.size()) - 1;
  };
  const auto point = [&](std::size_t k) { return mesh.points[at(whole[k % 3])]; };
  std::vector<int> around;
  for (std::size_t k = 0; k < 3; ++k)
  {
    around.push_back(whole[k]);
    for (int i = 1; i <= counts[k]; ++i)
    {
      const double share = static_cast<double>(i) / (counts[k] + 0.7);
      around.push_back(add((1.0 - share) * point(k) + share * point(k + 1)));
    }
  }
  const int middle = add((point(0) + point(1) + point(2)) / 3.0);
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    const Triangle part{ around[i], around[(i + 1) % around.size()], middle };
    i == 0 ? void(mesh.triangles[triangle] = part) : mesh.triangles.push_back(part);
  }
}

TEST(MeshRepair, CutsTrianglesAtPointsOfOthersOnTheirEdges)
{
  for (const Mesh& body : { cube(), makeBox({ 0.3, 0.1, 0.05 }, 0.02), makeSphere(0.03, 2) })
  {
    Mesh mesh = body;
    divide(mesh, 0, { 1, 2, 3 });
    divide(mesh, 1, { 0, 4, 1 }); // beside it on a cube
    divide(mesh, body.triangles.size() / 2, { 1, 0, 0 });
    ASSERT_FALSE(palp::healthOf(mesh.points, mesh.triangles).pieces.at(0).closed);
    const RepairedMesh mended = repairedOf(mesh);
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    ASSERT_EQ(health.pieces.size(), 1U);
    EXPECT_TRUE(health.pieces[0].closed);
    EXPECT_EQ(health.find(Fault::SelfIntersection), nullptr);
    const double volume = volumeOf(body.points, body.triangles);
    EXPECT_NEAR(health.pieces[0].volume, volume, 1e-6 * volume);
    EXPECT_GE(mended.cut, 8U);
    EXPECT_EQ(mended.triangles.size(), mesh.triangles.size() + mended.cut - mended.removed);
  }
}

// a sheet whose border has a point more than the one beside it, and an open border without
TEST(MeshRepair, LeavesOpenBordersWithoutJunctionsAsTheyAre)
{
  Mesh sheet;
  for (int i = 0; i < 5; ++i)
  {
    sheet.points.emplace_back(i, 0.0, 0.0);
    sheet.points.emplace_back(i + 0.25, 1.0, 0.0);
  }
  for (int i = 0; i < 8; ++i)
  {
    sheet.triangles.push_back(
      i % 2 == 0 ? Triangle{ i, i + 2, i + 1 } : Triangle{ i, i + 1, i + 2 });
  }
  const RepairedMesh same = repairedOf(sheet);
  EXPECT_EQ(same.cut, 0U);
  EXPECT_EQ(same.triangles.size(), sheet.triangles.size());
}

TEST(MeshRepair, LeavesABodyWholeWhereFinsStandOnIt)
{
  Mesh mesh = makeSphere(0.03, 3);
  const MeshPiece whole = palp::healthOf(mesh.points, mesh.triangles).pieces.at(0);
  const auto middle = static_cast<int>(mesh.points.size());
  mesh.points.emplace_back(0.0, 0.0, 0.0);
  mesh.points.emplace_back(0.06, 0.07, 0.08);
  for (const auto& [triangle, tip] : { std::pair(0, 0), { 200, 0 }, { 400, 1 }, { 600, 1 } })
  {
    const auto [a, b, c] = mesh.triangles[at(triangle)];
    mesh.triangles.push_back(
      triangle % 400 == 0 ? Triangle{ a, b, middle + tip } : Triangle{ b, a, middle + tip });
  }
  expectWhole(mesh, whole);
}

// without an area, as it hangs on a sphere by one edge
TEST(MeshRepair, LeavesOutWhatHangsOnAnEdgeWithoutAnArea)
{
  Mesh mesh = makeSphere(0.03, 2);
  const auto [a, b, c] = mesh.triangles[40];
  mesh.points.emplace_back(2.0 * mesh.points[at(a)] - mesh.points[at(b)]);
  mesh.triangles.push_back({ a, b, static_cast<int>(mesh.points.size()) - 1 });
  const RepairedMesh mended = repairedOf(mesh);
  EXPECT_EQ(mended.triangles.size(), mesh.triangles.size() - 1);
  EXPECT_TRUE(palp::healthOf(mended.points, mended.triangles).pieces.at(0).closed);
}

// points of the edges that lead from one along a direction
std::vector<int> pathOf(const Mesh& mesh, int start, const Vector3d& along, std::size_t most)
{
  std::vector<int> path{ start };
  while (path.size() < most)
  {
    int best = -1;
    for (const Triangle& t : mesh.triangles)
    {
      if (std::ranges::count(t, path.back()) == 0)
      {
        continue;
      }
      for (const int i : t)
      {
        const bool isAhead = std::ranges::count(path, i) == 0 &&
          (best < 0 || mesh.points[at(i)].dot(along) > mesh.points[at(best)].dot(along));
        best = isAhead ? i : best;
      }
    }
    path.push_back(best);
  }
  return path;
}

TEST(MeshRepair, LeavesABodyWholeWhereFinsOfManyTrianglesStandOnIt)
{
  const Mesh sphere = makeSphere(0.03, 3);
  const MeshPiece whole = palp::healthOf(sphere.points, sphere.triangles).pieces.at(0);
  for (const double reach : { 1.2, 0.8 }) // outward and inward
  {
    for (const std::size_t most : { 2U, 5U, 9U })
    {
      Mesh mesh = sphere;
      const std::vector<int> path = pathOf(sphere, 17, Vector3d(1.0, 0.3, 0.2), most);
      std::vector<int> below = path;
      for (int level = 1; level <= 3; ++level)
      {
        std::vector<int> above;
        for (const int i : path)
        {
          above.push_back(static_cast<int>(mesh.points.size()));
          mesh.points.emplace_back(std::pow(reach, level) * sphere.points[at(i)]);
        }
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
        {
          mesh.triangles.push_back({ below[i], below[i + 1], above[i] });
          mesh.triangles.push_back({ below[i + 1], above[i + 1], above[i] });
        }
        below = above;
      }
      expectWhole(mesh, whole);
    }
  }
}

// a seam that misses by up to a hundredth of its edges, as of parts that were rounded by
// themselves; what misses by more is left as it is
TEST(MeshRepair, SewsSeamsWholeOrLeavesThem)
{
  const Mesh sphere = makeSphere(0.05, 3);
  const MeshPiece whole = palp::healthOf(sphere.points, sphere.triangles).pieces.at(0);
  for (const double off : { 1e-7, 3e-6, 10e-6, 300e-6 }) // of edges of 6 to 8 mm
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-off, off);
    Mesh soup;
    for (const Triangle& t : sphere.triangles)
    {
      for (const int corner : t)
      {
        soup.points.push_back(
          sphere.points[at(corner)] + Vector3d(any(random), any(random), any(random)));
      }
      const auto n = static_cast<int>(soup.points.size());
      soup.triangles.push_back({ n - 3, n - 2, n - 1 });
    }
    const RepairedMesh mended = repairedOf(soup);
    EXPECT_EQ(mended.triangles.size(), sphere.triangles.size()) << off;
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    EXPECT_EQ(health.find(Fault::Sliver), nullptr) << off;
    if (off < 100e-6)
    {
      expectWhole(soup, whole);
    }
  }
}

// of 1 m, with edges around it at a height
Mesh cutCube(double across)
{
  Mesh mesh;
  for (const double z : { -0.5, across, 0.5 })
  {
    for (const auto& [x, y] : { std::pair(-0.5, -0.5), { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } })
    {
      mesh.points.emplace_back(x, y, z);
    }
  }
  const auto quad = [&](int a, int b, int c, int d)
  {
    mesh.triangles.push_back({ a, b, c });
    mesh.triangles.push_back({ a, c, d });
  };
  quad(3, 2, 1, 0);
  quad(8, 9, 10, 11);
  for (int level = 0; level < 8; level += 4)
  {
    for (int k = 0; k < 4; ++k)
    {
      const int next = (k + 1) % 4;
      quad(level + k, level + next, level + 4 + next, level + 4 + k);
    }
  }
  return mesh;
}

// each turned as by chance: the chambers at the ends stay
TEST(MeshRepair, LeavesOutSeveralWallsWithinABody)
{
  const Mesh box = makeBox({ 0.1, 0.08, 0.06 }, 0.01);
  const MeshPiece whole = palp::healthOf(box.points, box.triangles).pieces.at(0);
  for (unsigned seed = 0; seed < 24; ++seed)
  {
    std::mt19937 random(seed);
    Mesh mesh = box;
    for (int wall = 0; wall < 1 + static_cast<int>(seed % 4U); ++wall)
    {
      const double x = -0.04 + 0.02 * wall + 0.01 * static_cast<double>(random() % 2U);
      const bool isTurned = random() % 2U == 0U;
      const Mesh plate = makeBox({ 0.02, 0.08, 0.06 }, 0.01);
      for (const Triangle& t : plate.triangles)
      {
        const auto isAt = [&](int i) { return plate.points[at(i)].x() > 0.009; };
        if (std::ranges::all_of(t, isAt))
        {
          const auto n = static_cast<int>(mesh.points.size());
          for (const int i : t)
          {
            mesh.points.emplace_back(x, plate.points[at(i)].y(), plate.points[at(i)].z());
          }
          mesh.triangles.push_back(
            isTurned ? Triangle{ n, n + 1, n + 2 } : Triangle{ n + 2, n + 1, n });
        }
      }
    }
    expectWhole(mesh, whole);
  }
}

TEST(MeshRepair, LeavesOutWallsWithinABody)
{
  for (const bool isTurned : { false, true })
  {
    Mesh mesh = cutCube(0.1);
    const MeshPiece whole = palp::healthOf(mesh.points, mesh.triangles).pieces.at(0);
    ASSERT_TRUE(whole.closed);
    for (const Triangle& wall : { Triangle{ 4, 5, 6 }, { 4, 6, 7 } })
    {
      mesh.triangles.push_back(isTurned ? Triangle{ wall[2], wall[1], wall[0] } : wall);
    }
    expectWhole(mesh, whole);
  }
}

// both know the lines where they cross
TEST(MeshRepair, JoinsBodiesThatOverlapAlongCommonEdges)
{
  const Mesh box = makeBox({ 0.1, 0.08, 0.06 }, 0.01);
  for (const auto& [offset, volume] : { std::pair(Vector3d(0.05, 0.04, 0.03), 900e-6),
         { Vector3d(0.05, 0.0, 0.0), 720e-6 }, { Vector3d(0.07, 0.04, 0.0), 888e-6 } })
  {
    Mesh mesh = box;
    add(mesh, box, offset);
    const RepairedMesh mended = repairedOf(mesh);
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    ASSERT_EQ(health.pieces.size(), 1U) << offset.transpose();
    EXPECT_TRUE(health.pieces[0].closed) << offset.transpose();
    EXPECT_NEAR(health.pieces[0].volume, volume, 1e-3 * volume) << offset.transpose();
  }
}

} // namespace
} // namespace palp::test
