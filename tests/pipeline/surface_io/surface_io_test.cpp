#include "pipeline/surface_io/surface_io.h"

#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "tests/data/topology.h"
#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <sstream>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

Mesh meshOf(const LoadedSurface& surface)
{
  return { pointsOf(*surface.mesh), trianglesOf(*surface.mesh) };
}

bool mentions(const LoadedSurface& surface, const std::string& words)
{
  return std::any_of(surface.notes.begin(), surface.notes.end(),
    [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

class Files : public testing::Test
{
protected:
  std::filesystem::path write(const std::string& name, const std::string& content)
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

  std::filesystem::path write(const std::string& name, const Mesh& mesh)
  {
    const std::filesystem::path file = folder_.path() / name;
    writeSurface(file, *makePolyData(mesh.points, mesh.triangles));
    return file;
  }

  LoadedSurface load(const std::string& name, const std::string& content, UnitChoice unit = {})
  {
    return readSurface(write(name, content), unit);
  }

  TemporaryFolder folder_;
};

// a corner cut off a cube, 100 mm along each axis, written by hand
const char* const kStl = R"(solid corner
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 100 0
vertex 100 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 100 0 0
vertex 0 0 100
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 100
vertex 0 100 0
endloop
endfacet
facet normal 0.577 0.577 0.577
outer loop
vertex 100 0 0
vertex 0 100 0
vertex 0 0 100
endloop
endfacet
endsolid corner
)";
const char* const kObj = R"(# corner
v 0 0 0
v 100 0 0
v 0 100 0
v 0 0 100
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
)";
const char* const kPly = R"(ply
format ascii 1.0
comment corner
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
100 0 0
0 100 0
0 0 100
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";
const char* const kOff = R"(OFF
# corner
4 4 6

0 0 0
1e2 0 0
0 1.0e+2 0
0 0 100   # with colors
3 0 2 1  255 0 0
3 0 1 3
3 0 3 2
3 1 2 3
)";
const char* const kVtk = R"(# vtk DataFile Version 3.0
corner
ASCII
DATASET POLYDATA
POINTS 4 float
0 0 0 100 0 0 0 100 0 0 0 100
POLYGONS 4 16
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";
const char* const kVtp = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="4" NumberOfPolys="4">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 100 0 0 0 100 0 0 0 100</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">
0 2 1 0 1 3 0 3 2 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray></Polys>
</Piece></PolyData></VTKFile>
)";

struct Sample
{
  const char* name;
  const char* content;
};

void PrintTo(const Sample& sample, std::ostream* out)
{
  *out << sample.name;
}

class EveryFormat
  : public Files
  , public testing::WithParamInterface<Sample>
{
};

TEST_P(EveryFormat, GivesTheCornerOfACubeInMeters)
{
  const LoadedSurface surface = load(GetParam().name, GetParam().content);
  const Mesh mesh = meshOf(surface);
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(surface.closed);
  EXPECT_TRUE(closedAndOriented(mesh));
  EXPECT_EQ(surface.unit, LengthUnit::Millimeter);
  EXPECT_NEAR(volume(mesh), 0.1 * 0.1 * 0.1 / 6.0, 1e-10); // single precision
  ASSERT_EQ(surface.notes.size(), 2u);
  EXPECT_EQ(surface.notes[0],
    std::string(GetParam().name) +
      ": 4 points, 4 triangles, closed, 100 x 100 x 100 mm; coordinates taken in mm, a guess");
  EXPECT_TRUE(mentions(surface,
    std::string("warning: ") + GetParam().name + ": the file names no unit; mm is the only one"));
}

TEST_P(EveryFormat, IsReadInTheUnitThatIsAsked)
{
  const LoadedSurface surface = load(GetParam().name, GetParam().content, LengthUnit::Centimeter);
  EXPECT_TRUE(extent(meshOf(surface)).isApprox(Vector3d::Constant(1.0), 1e-6));
  EXPECT_TRUE(mentions(surface, "taken in cm, as asked"));
}

TEST_P(EveryFormat, SurvivesBeingCutOff)
{
  const std::string whole = GetParam().content;
  testing::internal::CaptureStderr();
  for (std::size_t length = 0; length + 2 < whole.size(); length += whole.size() / 20)
  {
    try
    {
      const LoadedSurface surface = load(GetParam().name, whole.substr(0, length));
      EXPECT_FALSE(surface.notes.empty());
    }
    catch (const Error&)
    {
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(ByHand, EveryFormat,
  testing::Values(Sample{ "corner.stl", kStl }, Sample{ "corner.obj", kObj },
    Sample{ "corner.ply", kPly }, Sample{ "corner.off", kOff }, Sample{ "corner.vtk", kVtk },
    Sample{ "CORNER.VTP", kVtp }));

class EveryWriter
  : public Files
  , public testing::WithParamInterface<const char*>
{
};

TEST_P(EveryWriter, GivesBackWhatWasWritten)
{
  const Mesh block = makeBox({ 100.0_mm, 80.0_mm, 30.0_mm }, 10.0_mm);
  const LoadedSurface surface = readSurface(write(GetParam(), block));
  const Mesh mesh = meshOf(surface);
  EXPECT_TRUE(surface.closed);
  EXPECT_EQ(mesh.points.size(), block.points.size());
  EXPECT_EQ(mesh.triangles.size(), block.triangles.size());
  EXPECT_NEAR(volume(mesh), 100.0_mm * 80.0_mm * 30.0_mm, 1e-9);
  EXPECT_TRUE(extent(mesh).isApprox(Vector3d(100.0_mm, 80.0_mm, 30.0_mm), 1e-6));
}

TEST_P(EveryWriter, GivesTheSameBytesEveryTime)
{
  const Mesh block = makeBox({ 100.0_mm, 80.0_mm, 30.0_mm }, 10.0_mm);
  EXPECT_EQ(readAll(write(std::string("a") + GetParam(), block)),
    readAll(write(std::string("b") + GetParam(), block)));
}

// what counts its content at the start must be missed when it is cut off
TEST_P(EveryWriter, IsRefusedWhenCutOffAtAnyTenth)
{
  const std::string name = GetParam();
  const std::string whole = readAll(write("whole" + name, makeSphere(50.0_mm, 3)));
  testing::internal::CaptureStderr();
  for (std::size_t tenth = 0; tenth < 10; ++tenth)
  {
    try
    {
      const LoadedSurface surface = load("cut" + name, whole.substr(0, whole.size() * tenth / 10));
      // OBJ has no counts and no end: what is there is taken, and is open
      EXPECT_EQ(name, "surface.obj") << tenth;
      EXPECT_TRUE(mentions(surface, "warning")) << tenth;
    }
    catch (const Error& error)
    {
      EXPECT_TRUE(
        std::string(error.what()).starts_with((folder_.path() / ("cut" + name)).string()));
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(EveryWriter, NeverCrashesOnDamage)
{
  const std::string name = GetParam();
  const std::string whole = readAll(write("whole" + name, makeSphere(50.0_mm, 1)));
  std::mt19937 random(20); // any
  const auto below = [&](std::size_t n)
  { return std::uniform_int_distribution(0ul, n - 1)(random); };
  testing::internal::CaptureStderr();
  for (int round = 0; round < 60; ++round)
  {
    std::string damaged = whole;
    for (int i = 0; i < 1 + round % 5; ++i)
    {
      // the head of a file is where damage tells most
      const std::size_t reach = round % 2 == 0 ? damaged.size() : std::min(damaged.size(), 400ul);
      damaged[below(reach)] ^= static_cast<char>(1 << below(8));
    }
    try
    {
      const Mesh mesh = meshOf(load("damaged" + name, damaged, LengthUnit::Millimeter));
      for (const Triangle& t : mesh.triangles)
      {
        for (const int corner : t)
        {
          ASSERT_TRUE(mesh.points.at(static_cast<std::size_t>(corner)).allFinite());
        }
      }
    }
    catch (const Error& error)
    {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(
  Kinds, EveryWriter, testing::Values("surface.vtp", "surface.stl", "surface.ply", "surface.obj"));

using SurfaceFile = Files;

TEST_F(SurfaceFile, ThatSaysItsUnitIsBelieved)
{
  // 60 mm across: by its size this could be centimeters as well
  const Mesh sphere = makeSphere(30.0_mm, 3);
  const LoadedSurface surface = readSurface(write("sphere.vtp", sphere));
  EXPECT_EQ(surface.unit, LengthUnit::Millimeter);
  EXPECT_TRUE(mentions(surface, "taken in mm, as the file says"));
  EXPECT_THROW((void)readSurface(write("sphere.stl", sphere)), Error);
  EXPECT_EQ(
    readSurface(write("sphere.vtp", sphere), LengthUnit::Centimeter).unit, LengthUnit::Centimeter);
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
  EXPECT_EQ(made.neighbors(3).size(), count); // behind the lone triangle's three points
  EXPECT_NEAR(made.normals()[3].z(), 1.0, 1e-3);
}

TEST_F(SurfaceFile, OfStlInTheWaysThatProgramsWriteItIsRead)
{
  std::string capitals = kStl;
  std::ranges::transform(
    capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string apart = kStl;
  apart.replace(apart.find("endsolid"), 8, "end solid");
  std::string returns = kStl;
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& text : { capitals, apart, returns, " \n" + std::string(kStl) })
  {
    const LoadedSurface surface = load("corner.stl", text, LengthUnit::Millimeter);
    EXPECT_TRUE(surface.closed);
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-10);
  }
  const std::string cut = std::string(kStl).substr(0, 300);
  try
  {
    (void)load("cut.stl", cut);
    ADD_FAILURE();
  }
  catch (const Error& error)
  {
    EXPECT_NE(
      std::string(error.what()).find("cut off, it ends without endsolid"), std::string::npos);
  }
}

TEST_F(SurfaceFile, OfObjInTheWaysThatProgramsWriteItIsRead)
{
  const auto with = [](std::string text, const std::string& from, const std::string& to)
  {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  std::string returns = kObj;
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& text : { "\xEF\xBB\xBF" + std::string(kObj),
         with(kObj, "\n", " # a remark\n"), with(kObj, "\n", "\r\n"), returns,
         with(kObj, "f 1 3 2", "f -4 -2 -3"), with(kObj, "f 1 3 2", "f 1/7 3//9 2/7/9"),
         with(kObj, "f 1 3 2", "f 1 3 \\\n2"), with(kObj, "v ", "v\t"), with(kObj, "100", "+1.0E2"),
         "f 4 3 2\n" + with(kObj, "f 2 3 4", "g x"), with(kObj, " 0\n", " 0 1.0\n"),
         "o s\ns off\nvt 0 0\nl 1 2\n" + std::string(kObj) })
  {
    const LoadedSurface surface = load("corner.obj", text, LengthUnit::Millimeter);
    EXPECT_TRUE(surface.closed) << text;
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-10) << text;
  }
}

TEST_F(SurfaceFile, OfOffInTheWaysThatProgramsWriteItIsRead)
{
  const std::string numbers = "4 4 6\n0 0 0\n100 0 0\n0 100 0\n0 0 100\n";
  const std::string faces = "3 0 2 1 255 0 0\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  std::string returns = "OFF\n" + numbers + faces;
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& text : { "\xEF\xBB\xBFOFF\n" + numbers + faces, "off\n" + numbers + faces,
         "OFF " + numbers + faces, "# first\n\nOFF # kind\n" + numbers + faces, returns,
         "STOFF\n4 4 6\n0 0 0 .1 .2\n100 0 0 0 0\n0 100 0 1 1\n0 0 100 0 1\n" + faces,
         "STCNOFF\n4 4\n0 0 0 0 0 1 9 9 9 1 0 0\n100 0 0 0 0 1 9 9 9 1 0 0\n"
         "0 100 0 0 0 1 9 9 9 1 0 0\n0 0 100 0 0 1 9 9 9 1 0 0\n" +
           faces })
  {
    const LoadedSurface surface = load("corner.off", text, LengthUnit::Millimeter);
    EXPECT_TRUE(surface.closed) << text;
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-10) << text;
  }
  for (const auto& [text, words] : { std::pair{ std::string("4OFF\n") + numbers + faces,
                                       "three coordinates, not of other dimensions" },
         { std::string("OFF BINARY\n\1\2"), "an OFF file in text form" },
         { std::string("OFF\n4 4 6\n0 0 0 100 0 0\n0 100 0 0 0 100\n") + faces,
           "each stands in a line of its own" } })
  {
    try
    {
      (void)load("bad.off", text, LengthUnit::Millimeter);
      ADD_FAILURE() << text;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

// of either byte order, among elements and properties that nobody needs
TEST_F(SurfaceFile, OfBinaryPlyIsReadWhateverElseItHolds)
{
  for (const bool big : { false, true })
  {
    std::string text = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\r\nelement camera 1\r\nproperty double f\r\n"
      "element vertex 4\r\nproperty uchar red\r\nproperty double z\r\nproperty float x\r\n"
      "property int16 y\r\nelement face 4\r\nproperty list uchar float texcoord\r\n"
      "property list uint8 uint16 vertex_index\r\nend_header\r\n";
    const auto put = [&](auto value)
    {
      std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
      text += big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
    };
    put(1.0);
    for (const std::array<int, 3>& p :
      { std::array{ 0, 0, 0 }, { 100, 0, 0 }, { 0, 100, 0 }, { 0, 0, 100 } })
    {
      put(std::uint8_t{ 7 });
      put(double(p[2]));
      put(float(p[0]));
      put(std::int16_t(p[1]));
    }
    for (const std::array<int, 3>& t :
      { std::array{ 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } })
    {
      put(std::uint8_t{ 1 });
      put(0.5F);
      put(std::uint8_t{ 3 });
      for (const int corner : t)
      {
        put(std::uint16_t(corner));
      }
    }
    const LoadedSurface surface = load("corner.ply", text, LengthUnit::Millimeter);
    EXPECT_TRUE(surface.closed);
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-10);
  }
}

// two tetrahedra with one face in common: six faces outside, of the volumes of both
TEST_F(SurfaceFile, OfAVolumeMeshIsItsOuterSurface)
{
  const LoadedSurface legacy = load("tetra.vtk", R"(# vtk DataFile Version 3.0
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0 100 0 0 0 100 0 0 0 100 100 100 100
CELLS 2 10
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 2
10 10
)");
  const LoadedSurface xml = load("tetra.vtu", R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="5" NumberOfCells="2">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">
0 0 0 100 0 0 0 100 0 0 0 100 100 100 100</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 1 2 3 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10 10</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)");
  for (const LoadedSurface& surface : { legacy, xml })
  {
    EXPECT_TRUE(surface.closed);
    EXPECT_EQ(meshOf(surface).triangles.size(), 6u);
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0 * 3.0, 1e-9); // by determinants
  }
}

// each is refused in one line that starts with the file and ends with what to do
TEST_F(SurfaceFile, ThatIsBadIsRefusedInOneSentence)
{
  std::string garbage(5000, '\0');
  std::mt19937 random(7);
  std::generate(garbage.begin(), garbage.end(), [&] { return static_cast<char>(random()); });

  std::string notANumber = kStl;
  notANumber.replace(notANumber.find("100"), 3, "nan");
  std::string infinite = kObj;
  infinite.replace(infinite.find("100"), 3, "inf");
  std::string outOfRange = kOff;
  outOfRange.replace(outOfRange.find("3 1 2 3"), 7, "3 1 2 9");
  std::string negative = kPly;
  negative.replace(negative.find("3 1 2 3"), 7, "3 1 -2 3");
  std::string flat = kObj;
  std::replace(flat.begin(), flat.end(), '1', '0');

  struct Case
  {
    std::string name;
    std::string content;
    ErrorCode code;
    std::string words;
  };
  std::vector<Case> cases = {
    { "empty.stl", "", ErrorCode::BadFile, "empty" },
    { "nan.stl", notANumber, ErrorCode::BadMesh, "not a usable number" },
    { "inf.obj", infinite, ErrorCode::BadMesh, "inf.obj:3: 'inf' is not a usable number" },
    { "range.off", outOfRange, ErrorCode::BadFile,
      "range.off:12: a face refers to point 9, out of range (0 to 3)" },
    { "negative.ply", negative, ErrorCode::BadFile, "export" },
    { "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ErrorCode::BadMesh, "no triangles" },
    { "zero.off", "OFF\n0 0 0\n", ErrorCode::BadMesh, "no triangles" },
    { "lines.obj", "v 0 0 0\nv 100 0 0\nv 200 0 0\nf 1 2 3\n", ErrorCode::BadMesh, "area" },
    { "short.off", "OFF\n4 4 6\n0 0 0\n", ErrorCode::BadFile, "ends after line 3" },
    { "word.off", "OFF\n4 4 6\n0 0 zero\n", ErrorCode::BadFile, "word.off:3: expected" },
    { "corner.step", kStl, ErrorCode::BadFile, "give a surface (.stl, .obj" },
    { "noending", kStl, ErrorCode::BadFile, "give a surface (.stl, .obj" },
    { "really_stl.ply", kStl, ErrorCode::BadFile, "not a PLY file" },
    { "really_stl.vtk", kStl, ErrorCode::BadFile, "not a legacy VTK file" },
    { "really_stl.vtp", kStl, ErrorCode::BadFile, "not a VTP file" },
    { "really_stl.off", kStl, ErrorCode::BadFile, "expected OFF" },
    { "really_stl.obj", kStl, ErrorCode::BadFile, "not an OBJ file" },
    { "really_obj.stl", kObj, ErrorCode::BadFile, "not an STL file" },
    { "html.vtp", "<html><body>not found</body></html>", ErrorCode::BadFile, "VTP" },
  };
  for (const char* kind : { ".stl", ".obj", ".ply", ".off", ".vtk", ".vtp" })
  {
    cases.push_back({ std::string("garbage") + kind, garbage, ErrorCode::BadFile, "" });
  }

  for (const Case& bad : cases)
  {
    const std::filesystem::path file = write(bad.name, bad.content);
    testing::internal::CaptureStderr();
    try
    {
      (void)readSurface(file, LengthUnit::Millimeter);
      ADD_FAILURE() << bad.name << " was taken";
    }
    catch (const Error& error)
    {
      const std::string text = error.what();
      EXPECT_EQ(error.code(), bad.code) << text;
      EXPECT_TRUE(text.starts_with(file.string() + ":")) << text;
      EXPECT_NE(text.find("; "), std::string::npos) << text;
      EXPECT_NE(text.find(bad.words), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << bad.name;
  }
}

TEST_F(SurfaceFile, ThatIsMissingOrADirectoryIsRefused)
{
  EXPECT_THROW((void)readSurface(folder_.path() / "absent.stl"), Error);
  std::filesystem::create_directory(folder_.path() / "folder.stl");
  EXPECT_THROW((void)readSurface(folder_.path() / "folder.stl"), Error);
}

TEST_F(SurfaceFile, ThatCannotBeWrittenIsAnError)
{
  const Mesh grid = makeGrid(3, 100.0_mm);
  testing::internal::CaptureStderr();
  EXPECT_THROW(write("no/such/folder.vtp", grid), Error);
  EXPECT_THROW(write("surface.step", grid), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "surface.step"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
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

} // namespace
} // namespace palp::test
