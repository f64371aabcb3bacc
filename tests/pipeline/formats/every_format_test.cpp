#include "tests/pipeline/surface_files.h"

#include "haptics/units.h"
#include "tests/pipeline/many_reader.h"
#include "tests/pipeline/sample_files.h"

#include <random>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

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
  ManyReader reader;
  for (std::size_t length = 0; length + 2 < whole.size(); length += whole.size() / 20)
  {
    try
    {
      const LoadedSurface surface = reader.read(write(GetParam().name, whole.substr(0, length)));
      EXPECT_FALSE(surface.notes.empty());
    }
    catch (const Error&)
    {
    }
  }
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
  ManyReader reader;
  for (std::size_t tenth = 0; tenth < 10; ++tenth)
  {
    try
    {
      const LoadedSurface surface =
        reader.read(write("cut" + name, whole.substr(0, whole.size() * tenth / 10)));
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
}

TEST_P(EveryWriter, NeverCrashesOnDamage)
{
  const std::string name = GetParam();
  const std::string whole = readAll(write("whole" + name, makeSphere(50.0_mm, 1)));
  std::mt19937 random(20); // any
  const auto below = [&](std::size_t n)
  { return std::uniform_int_distribution(0ul, n - 1)(random); };
  ManyReader reader;
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
      const Mesh mesh =
        meshOf(reader.read(write("damaged" + name, damaged), LengthUnit::Millimeter));
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
}

INSTANTIATE_TEST_SUITE_P(
  Kinds, EveryWriter, testing::Values("surface.vtp", "surface.stl", "surface.ply", "surface.obj"));

} // namespace
} // namespace palp::test
