// What repair may not take from a body, whatever else is wrong: it stays, or becomes, whole.

#include "tests/pipeline/health/faulty_meshes.h"

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

MeshPiece wholeOf(const Mesh& mesh)
{
  return palp::healthOf(mesh.points, mesh.triangles).pieces.at(0);
}

// of 0.1 x 0.08 x 0.06 m, with a wall across its middle
Mesh walledBox(const Mesh& box)
{
  Mesh mesh = box;
  const Mesh plate = makeBox({ 0.02, 0.08, 0.06 }, 0.01);
  for (const Triangle& t : plate.triangles)
  {
    if (std::ranges::all_of(t, [&](int i) { return plate.points[at(i)].x() > 0.009; }))
    {
      const auto n = static_cast<int>(mesh.points.size());
      for (const int i : t)
      {
        mesh.points.emplace_back(0.0, plate.points[at(i)].y(), plate.points[at(i)].z());
      }
      mesh.triangles.push_back({ n, n + 1, n + 2 });
    }
  }
  return mesh;
}

TEST(MeshRepair, SewsASoupWithABlemish)
{
  const Mesh sphere = makeSphere(0.05, 3);
  const MeshPiece whole = wholeOf(sphere);
  const auto [a, b, c] = sphere.triangles[40];
  Mesh twice = sphere;
  twice.triangles.insert(twice.triangles.end(), { { a, b, c }, { c, b, a } });
  Mesh fin = sphere;
  fin.points.emplace_back(1.1 * sphere.points[at(a)]);
  fin.triangles.push_back({ a, b, static_cast<int>(fin.points.size()) - 1 });
  Mesh shells = sphere;
  shells.triangles.insert(shells.triangles.end(), sphere.triangles.begin(), sphere.triangles.end());
  const Mesh box = makeBox({ 0.1, 0.08, 0.06 }, 0.01);
  for (const double off : { 1e-8, 1e-6, 3e-5 }) // of edges of 6 to 8 mm
  {
    expectWhole(soupOf(twice, off, 1), whole);
    expectWhole(soupOf(fin, off, 2), whole);
    expectWhole(soupOf(shells, off, 3), whole);
    expectWhole(soupOf(walledBox(box), off, 4), wholeOf(box));
  }
}

// halves of a ball, one of them moved off: sewn as a whole, or told
TEST(MeshRepair, SewsNoPartOfASeam)
{
  const Mesh sphere = makeSphere(0.05, 3);
  const MeshPiece whole = wholeOf(sphere);
  for (const double gap : { 7e-6, 7e-5, 12e-5, 5e-4 }) // of edges of 6 to 8 mm
  {
    Mesh halves = sphere;
    for (const Vector3d& point : sphere.points)
    {
      halves.points.emplace_back(point + gap * Vector3d::UnitZ());
    }
    for (Triangle& t : halves.triangles)
    {
      const auto height = [&](int i) { return sphere.points[at(i)].z(); };
      const bool isUp = height(t[0]) + height(t[1]) + height(t[2]) > 1e-9;
      for (int& corner : t)
      {
        corner += isUp ? static_cast<int>(sphere.points.size()) : 0;
      }
    }
    const RepairedMesh mended = repairedOf(halves);
    const MeshPiece piece = palp::healthOf(mended.points, mended.triangles).pieces.at(0);
    const bool isSewn = gap < 4e-4;
    EXPECT_EQ(piece.closed, isSewn) << gap;
    EXPECT_EQ(mended.seamsLeft > 0, !isSewn) << gap;
    EXPECT_EQ(piece.triangles == whole.triangles, isSewn) << gap;
  }
}

// every triangle there twice, where the one of a copy is three, or two are turned to the other
// diagonal
TEST(MeshRepair, OpensNoShellThatIsThereTwice)
{
  const Mesh box = makeBox({ 0.06, 0.06, 0.06 }, 0.015);
  Mesh split = box;
  split.triangles.insert(split.triangles.end(), box.triangles.begin() + 1, box.triangles.end());
  const auto [a, b, c] = box.triangles[0];
  const auto n = static_cast<int>(split.points.size());
  split.points.emplace_back((box.points[at(a)] + box.points[at(b)] + box.points[at(c)]) / 3.0);
  split.triangles.insert(split.triangles.end(), { { a, b, n }, { b, c, n }, { c, a, n } });

  Mesh flipped = box;
  const Triangle& other = box.triangles[1]; // the rest of a square, or beside it in its plane
  const auto isShared = [&](int i) { return std::ranges::count(box.triangles[0], i) > 0; };
  ASSERT_EQ(std::ranges::count_if(other, isShared), 2);
  const int far = *std::ranges::find_if_not(other, isShared);
  const auto k = std::ranges::find_if(
                   box.triangles[0], [&](int i) { return std::ranges::count(other, i) == 0; }) -
    box.triangles[0].begin();
  const Triangle& one = box.triangles[0];
  const int near = one[static_cast<std::size_t>(k)];
  const int second = one[static_cast<std::size_t>(k + 1) % 3];
  const int third = one[static_cast<std::size_t>(k + 2) % 3];
  flipped.triangles.insert(flipped.triangles.end(), box.triangles.begin() + 2, box.triangles.end());
  flipped.triangles.insert(
    flipped.triangles.end(), { { near, second, far }, { near, far, third } });
  for (const Mesh& mesh : { split, flipped })
  {
    const RepairedMesh mended = repairedOf(mesh);
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    ASSERT_EQ(health.pieces.size(), 1U);
    EXPECT_TRUE(health.pieces[0].closed);
    EXPECT_NEAR(health.pieces[0].volume, 0.06 * 0.06 * 0.06, 1e-9);
  }
}

TEST(MeshRepair, LeavesOutAWallWhoseTrianglesAreTurnedByChance)
{
  const Mesh box = makeBox({ 0.1, 0.08, 0.06 }, 0.01);
  const MeshPiece whole = wholeOf(box);
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    std::mt19937 random(seed);
    Mesh mesh = walledBox(box);
    for (Triangle& t : mesh.triangles)
    {
      random() % 10 < 2 + seed % 6 ? std::swap(t[0], t[1]) : void(); // 20 to 70 %
    }
    expectWhole(mesh, whole);
  }
}

// inward along the plane of a side beside the edge that they stand on
TEST(MeshRepair, TakesFinsInThePlaneOfASideOffABody)
{
  const Mesh box = makeBox({ 0.06, 0.05, 0.04 }, 0.01);
  const MeshPiece whole = wholeOf(box);
  for (const double depth : { 0.001, 0.005, 0.02 })
  {
    Mesh mesh = box;
    for (std::size_t i = 0; i < box.triangles.size(); i += 7)
    {
      const auto& [a, b, c] = box.triangles[i];
      const Vector3d middle = 0.5 * (box.points[at(a)] + box.points[at(b)]);
      mesh.points.emplace_back(middle - depth * unitNormal(box.points, box.triangles[i]));
      mesh.triangles.push_back({ a, b, static_cast<int>(mesh.points.size()) - 1 });
    }
    expectWhole(mesh, whole);
    const RepairedMesh mended = repairedOf(mesh);
    const MeshHealth health = palp::healthOf(mended.points, mended.triangles);
    EXPECT_EQ(health.find(Fault::DuplicatePoint), nullptr) << depth;
  }
}

} // namespace
} // namespace palp::test
