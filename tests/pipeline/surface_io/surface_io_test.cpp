#include "haptics/units.h"
#include "tests/pipeline/sample_files.h"
#include "tests/pipeline/surface_files.h"

#include <numbers>
#include <sstream>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

TEST_F(SurfaceFile, ThatSaysItsUnitIsBelieved)
{
  // 60 mm across: by its size this could be centimeters as well
  const Mesh sphere = makeSphere(30.0_mm, 3);
  const LoadedSurface surface = readSurface(write("sphere.vtp", sphere));
  EXPECT_EQ(surface.unit, LengthUnit::Millimeter);
  EXPECT_TRUE(mentions(surface, "taken in mm, as the file says"));
  EXPECT_THROW((void)readSurface(write("sphere.stl", sphere)), Error);
  const LoadedSurface other = readSurface(write("sphere.vtp", sphere), LengthUnit::Centimeter);
  EXPECT_EQ(other.unit, LengthUnit::Centimeter);
  EXPECT_TRUE(mentions(other, "taken in cm, as asked, though the file says mm"));
}

TEST_F(SurfaceFile, SaysItsAxesWhereTheyAreKnown)
{
  const Mesh sphere = makeSphere(30.0_mm, 1);
  const auto written = [&](const char* space)
  {
    const std::filesystem::path file = folder_.path() / "axes.vtp";
    writeSurface(file, *makePolyData(sphere.points, sphere.triangles), space);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    auto* array =
      vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray("SPACE"));
    return array ? std::string(array->GetValue(0)) : "none";
  };
  EXPECT_EQ(written("LPS"), "LPS");
  EXPECT_EQ(written(""), "none");
}

template <typename Reader>
void expectInMillimeters(const std::filesystem::path& file, const Mesh& mesh)
{
  writeSurface(file, *makePolyData(mesh.points, mesh.triangles));
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData& read = *reader->GetOutput();
  const std::vector<Vector3d> points = pointsOf(read);
  const std::vector<Triangle> triangles = trianglesOf(read);
  ASSERT_EQ(triangles.size(), mesh.triangles.size()) << file;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto at = [k](const auto& all, const Triangle& triangle)
      { return all[static_cast<std::size_t>(triangle[k])]; };
      const Vector3d expected = 1e3 * at(mesh.points, mesh.triangles[i]);
      ASSERT_LT((at(points, triangles[i]) - expected).norm(), 1e-5 * expected.norm()) << file;
    }
  }
}

// by readers of VTK, corner by corner
TEST_F(SurfaceFile, OfEachKindIsReadByOthers)
{
  const Mesh sphere = makeSphere(30.0_mm, 3);
  expectInMillimeters<vtkSTLReader>(folder_.path() / "ball.stl", sphere);
  expectInMillimeters<vtkOBJReader>(folder_.path() / "ball.obj", sphere);
  expectInMillimeters<vtkPLYReader>(folder_.path() / "ball.ply", sphere);
  expectInMillimeters<vtkXMLPolyDataReader>(folder_.path() / "ball.vtp", sphere);
}

TEST_F(SurfaceFile, WithSeamsIsClosedOnceCoincidentPointsAreMerged)
{
  // a cube with a normal for each side, which makes three points of each corner in VTK
  const LoadedSurface cube = load("cube.obj", R"(
v 0 0 0
v 100 0 0
v 100 100 0
v 0 100 0
v 0 0 100
v 100 0 100
v 100 100 100
v 0 100 100
vt 0 0
vn 0 0 -1
vn 0 0 1
vn 0 -1 0
vn 1 0 0
vn 0 1 0
vn -1 0 0
f 1/1/1 4/1/1 3/1/1 2/1/1
f 5/1/2 6/1/2 7/1/2 8/1/2
f 1/1/3 2/1/3 6/1/3 5/1/3
f 2/1/4 3/1/4 7/1/4 6/1/4
f 3/1/5 4/1/5 8/1/5 7/1/5
f 4/1/6 1/1/6 5/1/6 8/1/6
)");
  EXPECT_TRUE(cube.closed);
  EXPECT_EQ(meshOf(cube).points.size(), 8u);
  EXPECT_EQ(meshOf(cube).triangles.size(), 12u);
  EXPECT_NEAR(volume(meshOf(cube)), 0.1 * 0.1 * 0.1, 1e-9);
}

// so that what others know of them stays theirs
TEST_F(SurfaceFile, KeepsTheOrderOfItsPoints)
{
  const LoadedSurface surface = load("tetrahedron.off",
    "OFF\n6 4 0\n0 0 0\n9 9 9\n80 0 0\n0 80 0\n80 0 0\n0 0 80\n" // one without a triangle, one
                                                                 // twice
    "3 5 3 0\n3 4 5 0\n3 3 5 2\n3 0 3 4\n",
    LengthUnit::Millimeter);
  const std::vector<Vector3d> points = meshOf(surface).points;
  const std::vector<Vector3d> expected = { { 0, 0, 0 }, { 0.08, 0, 0 }, { 0, 0.08, 0 },
    { 0, 0, 0.08 } };
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT((points[i] - expected[i]).norm(), 1e-8) << i;
  }
}

TEST_F(SurfaceFile, OfStripsAndPolygonsBecomesTriangles)
{
  const LoadedSurface strip = load("strip.vtk", R"(# vtk DataFile Version 3.0
a strip and a pentagon
ASCII
DATASET POLYDATA
POINTS 8 float
0 0 0  0 100 0  100 0 0  100 100 0  200 0 0  200 100 0  0 200 0  100 250 0
POLYGONS 1 6
5 1 3 5 7 6
TRIANGLE_STRIPS 1 7
6 0 1 2 3 4 5
)");
  EXPECT_EQ(meshOf(strip).triangles.size(), 4u + 3u);
  // strip 200 x 100, pentagon by the shoelace formula 20000 mm^2
  EXPECT_NEAR(area(meshOf(strip)), 0.02 + 0.02, 1e-8);
}

TEST_F(SurfaceFile, ThatFacesInwardsIsTurned)
{
  std::string inward = kOff;
  for (const auto& [from, to] : { std::pair{ "3 0 2 1", "3 0 1 2" }, { "3 0 1 3", "3 0 3 1" },
         { "3 0 3 2", "3 0 2 3" }, { "3 1 2 3", "3 1 3 2" } })
  {
    inward.replace(inward.find(from), 7, to);
  }
  const LoadedSurface surface = load("inward.off", inward);
  EXPECT_GT(volume(meshOf(surface)), 0.0);
  EXPECT_TRUE(closedAndOriented(meshOf(surface)));
  EXPECT_TRUE(mentions(surface, "4 triangles turned to face outwards"));
}

TEST_F(SurfaceFile, WhoseTrianglesDisagreeIsMadeConsistent)
{
  std::string mixed = kOff;
  mixed.replace(mixed.find("3 0 1 3"), 7, "3 0 3 1");
  const LoadedSurface surface = load("mixed.off", mixed);
  EXPECT_TRUE(closedAndOriented(meshOf(surface)));
  EXPECT_GT(volume(meshOf(surface)), 0.0);
  EXPECT_TRUE(mentions(surface, "1 triangle turned"));
}

TEST_F(SurfaceFile, OfTwoPiecesTurnsEachOutwards)
{
  Mesh two = makeSphere(30.0_mm, 2);
  const int count = static_cast<int>(two.points.size());
  for (int i = 0; i < count; ++i)
  {
    two.points.push_back(two.points[i] + 100.0_mm * Vector3d::UnitX());
  }
  for (const Triangle& t : makeSphere(30.0_mm, 2).triangles)
  {
    two.triangles.push_back({ t[0] + count, t[2] + count, t[1] + count }); // inside out
  }
  const LoadedSurface surface = readSurface(write("two.vtp", two));
  EXPECT_TRUE(surface.closed);
  EXPECT_NEAR(volume(meshOf(surface)), 2.0 * volume(makeSphere(30.0_mm, 2)), 1e-9);
}

TEST_F(SurfaceFile, ThatIsOpenLoadsWithAWarning)
{
  const LoadedSurface surface = readSurface(write("grid.vtp", makeGrid(5, 100.0_mm)));
  EXPECT_FALSE(surface.closed);
  EXPECT_TRUE(mentions(surface, "warning: grid.vtp: open: 16 edges"));
  for (const auto& [a, b, c] : meshOf(surface).triangles) // still up, as it was written
  {
    const auto points = pointsOf(*surface.mesh);
    EXPECT_GT((points[b] - points[a]).cross(points[c] - points[a]).z(), 0.0);
  }
}

TEST_F(SurfaceFile, ThatIsNoManifoldLoadsWithAWarning)
{
  // a fin on the corner
  std::string fin = kOff;
  fin.replace(fin.find("4 4 6"), 5, "5 5 0");
  fin.replace(fin.find("3 0 2 1"), 0, "-50 -50 0\n");
  fin += "3 0 1 4\n";
  const LoadedSurface surface = load("fin.off", fin);
  EXPECT_FALSE(surface.closed);
  EXPECT_EQ(meshOf(surface).triangles.size(), 5u);
  EXPECT_TRUE(mentions(surface, "not a manifold: 1 edge has more than two triangles"));
}

TEST_F(SurfaceFile, LosesTrianglesWhoseCornersCoincide)
{
  std::string degenerate = kOff;
  degenerate.replace(degenerate.find("4 4 6"), 5, "4 6 0");
  degenerate += "3 1 1 2\n3 3 3 3\n";
  const LoadedSurface surface = load("degenerate.off", degenerate);
  EXPECT_EQ(meshOf(surface).triangles.size(), 4u);
  EXPECT_TRUE(surface.closed);
  EXPECT_TRUE(mentions(surface, "2 triangles whose corners coincide dropped"));
}

// two cones base to base: 60,000 triangles share each apex, and one triangle stands 1e9 mm away
TEST_F(SurfaceFile, OfAnyShapeIsMadeReadyInTimeThatGrowsAsItsSize)
{
  constexpr int count = 60'000;
  std::ostringstream text;
  text << "v 0 0 50\nv 0 0 -50\nv 1e9 0 0\nv 1e9 1e9 0\nv 1e9 0 1e9\nf 3 4 5\n";
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / count;
    text << "v " << 100.0 * std::cos(angle) << ' ' << 100.0 * std::sin(angle) << " 0\n";
    const int a = 6 + i;
    const int b = 6 + (i + 1) % count;
    text << "f 1 " << a << ' ' << b << "\nf 2 " << a << ' ' << b << '\n'; // half face inwards
  }
  const LoadedSurface surface = load("cones.obj", text.str(), LengthUnit::Millimeter);
  EXPECT_TRUE(mentions(surface, "open: 3 edges"));
  EXPECT_TRUE(mentions(surface, "60000 triangles turned to face as their neighbors"));
  const Mesh mesh = meshOf(surface);
  const Surface made(mesh.points, mesh.triangles);
  EXPECT_EQ(made.neighbors(0).size(), count); // points keep their order
  EXPECT_NEAR(made.normals()[0].z(), 1.0, 1e-3);
}

TEST(SurfaceLibrary, MapsNoWindowSystem)
{
  std::ifstream maps("/proc/self/maps");
  std::string line;
  while (std::getline(maps, line))
  {
    for (const char* library : { "libX11", "libGL", "libOpenGL", "libEGL", "libQt", "libxcb" })
    {
      EXPECT_EQ(line.find(library), std::string::npos) << line;
    }
  }
}

// as sin(pi) makes the pole of a ball out of longitudes and latitudes
TEST_F(SurfaceFile, PointsThatRoundingPartsAreOne)
{
  for (const double ring : { 0.0, 5e-15, 1e-12, 1e-9 })
  {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "ball.off";
    {
      constexpr int kAround = 24;
      constexpr int kRings = 12; // the last of them is the pole
      std::ofstream out(file);
      out.precision(17);
      out << "OFF\n" << 1 + kAround * kRings << ' ' << kAround * (2 * kRings - 1) << " 0\n0 0 40\n";
      for (int i = 1; i <= kRings; ++i)
      {
        const double polar = std::numbers::pi * i / kRings;
        const double radius = i == kRings ? ring : 40.0 * std::sin(polar);
        for (int k = 0; k < kAround; ++k)
        {
          const double angle = 2.0 * std::numbers::pi * k / kAround;
          out << radius * std::cos(angle) << ' ' << radius * std::sin(angle) << ' '
              << 40.0 * std::cos(polar) << '\n';
        }
      }
      for (int k = 0; k < kAround; ++k)
      {
        const int next = (k + 1) % kAround;
        out << "3 0 " << 1 + k << ' ' << 1 + next << '\n';
        for (int i = 0; i + 1 < kRings; ++i)
        {
          const int a = 1 + i * kAround;
          out << "3 " << a + k << ' ' << a + kAround + k << ' ' << a + kAround + next << "\n3 "
              << a + k << ' ' << a + kAround + next << ' ' << a + next << '\n';
        }
      }
    }
    const LoadedSurface ball = readSurface(file, LengthUnit::Millimeter);
    EXPECT_TRUE(ball.closed) << ring;
    EXPECT_EQ(ball.mesh->GetNumberOfPoints(), 2 + 24 * 11) << ring;
  }
}

} // namespace
} // namespace palp::test
