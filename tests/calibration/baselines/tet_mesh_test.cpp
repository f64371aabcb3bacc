#include "calibration/baselines/tet_mesh.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace palp::fem
{
namespace
{

using namespace units::literals;

using Face = std::array<int, 3>;

std::map<Face, int> facesOf(const TetMesh& mesh)
{
  std::map<Face, int> faces;
  for (const auto& tet : mesh.tets)
  {
    for (std::size_t left = 0; left < 4; ++left)
    {
      Face face{};
      std::size_t n = 0;
      for (std::size_t a = 0; a < 4; ++a)
      {
        if (a != left)
        {
          face[n++] = tet[a];
        }
      }
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  return faces;
}

// Table 1, with 15842 where it prints 15482
TEST(TetMesh, SurfacesHaveThePapersNumbers)
{
  struct Row
  {
    int n;
    std::size_t vertices, edges, triangles;
  };
  for (const Row& row : { Row{ 40, 1600, 4641, 3042 }, Row{ 50, 2500, 7301, 4802 },
         Row{ 60, 3600, 10561, 6962 }, Row{ 70, 4900, 14421, 9522 }, Row{ 80, 6400, 18881, 12482 },
         Row{ 90, 8100, 23941, 15842 }, Row{ 100, 10000, 29601, 19602 } })
  {
    const TetMesh mesh = blockTets(100.0_mm, 50.0_mm, row.n, 2);
    EXPECT_EQ(mesh.surface.size(), row.vertices);
    EXPECT_EQ(mesh.triangles.size(), row.triangles);
    std::set<std::pair<int, int>> edges;
    for (const auto& t : mesh.triangles)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        edges.insert(std::minmax(t[a], t[(a + 1) % 3]));
      }
    }
    EXPECT_EQ(edges.size(), row.edges);
  }
}

TEST(TetMesh, TetrahedraFillTheBlockFaceToFace)
{
  const TetMesh mesh = blockTets(100.0_mm, 50.0_mm, 8, 5);
  double sum = 0.0;
  for (const auto& tet : mesh.tets)
  {
    sum += volume(mesh.positions, tet);
  }
  EXPECT_NEAR(sum, 5e-4, 1e-16);
  EXPECT_EQ(mesh.bonded.size(), 64u);

  const auto faces = facesOf(mesh);
  std::size_t outer = 0;
  for (const auto& [face, count] : faces)
  {
    ASSERT_LE(count, 2);
    outer += count == 1 ? 1 : 0;
  }
  EXPECT_EQ(outer, 2u * (2 * 7 * 7 + 4 * 7 * 4)); // two triangles on each outer side of a cell
  for (Face face : mesh.triangles)
  {
    std::sort(face.begin(), face.end());
    EXPECT_EQ(faces.at(face), 1); // a face of the body, and on its outside
  }
}

TEST(TetMesh, SurfaceTrianglesFaceUpwardsAndCoverTheTop)
{
  const TetMesh mesh = blockTets(100.0_mm, 50.0_mm, 6, 3);
  double area = 0.0;
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3d u = mesh.positions.col(t[1]) - mesh.positions.col(t[0]);
    const Eigen::Vector3d v = mesh.positions.col(t[2]) - mesh.positions.col(t[0]);
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, 0.01, 1e-15);
}

std::string refusal(const TetMesh& mesh)
{
  try
  {
    check(mesh);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadMesh);
    return error.what();
  }
  return "";
}

TEST(TetMesh, UnusableMeshesAreRefusedInOneSentence)
{
  const TetMesh good = blockTets(1.0, 1.0, 3, 3);
  EXPECT_EQ(refusal(good), "");

  TetMesh mesh = good;
  mesh.bonded.clear();
  EXPECT_NE(refusal(mesh).find("no bonded node"), std::string::npos);
  mesh = good;
  mesh.surface.clear();
  EXPECT_NE(refusal(mesh).find("no surface node"), std::string::npos);
  EXPECT_NE(refusal(TetMesh{}).find("no tetrahedron"), std::string::npos);
  mesh = good;
  mesh.tets[3][1] = 27;
  EXPECT_NE(refusal(mesh).find("tetrahedron 3 has a node"), std::string::npos);
  mesh = good;
  mesh.positions(2, 13) = NAN;
  EXPECT_NE(refusal(mesh).find("not a finite number"), std::string::npos);
  mesh = good;
  mesh.positions.conservativeResize(3, 28);
  mesh.positions.col(27).setZero();
  EXPECT_NE(refusal(mesh).find("belongs to no tetrahedron"), std::string::npos);
}

// the top layer squeezed: refused once it is a sheet, not before
TEST(TetMesh, SliversAreRefused)
{
  TetMesh mesh = blockTets(1.0, 1.0, 2, 2);
  for (const double height : { 1e-1, 1e-2, 1e-4, 0.0 })
  {
    mesh.positions.row(2) =
      (mesh.positions.row(2).array() > -0.5).select(0.0, mesh.positions.row(2));
    for (const int i : mesh.bonded)
    {
      mesh.positions(2, i) = -height;
    }
    EXPECT_EQ(refusal(mesh).find("sliver") != std::string::npos, height < 1e-3) << height;
  }
}

TEST(TetMesh, ImpossibleBlocksAreRefused)
{
  EXPECT_THROW((void)blockTets(0.0, 1.0, 3, 3), Error);
  EXPECT_THROW((void)blockTets(1.0, NAN, 3, 3), Error);
  EXPECT_THROW((void)blockTets(1.0, 1.0, 1, 3), Error);
  EXPECT_THROW((void)blockTets(1.0, 1.0, 3, 1), Error);
}

} // namespace
} // namespace palp::fem
