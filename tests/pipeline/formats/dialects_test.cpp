#include "tests/pipeline/surface_files.h"

#include "tests/pipeline/sample_files.h"

#include <array>

namespace palp::test
{
namespace
{

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
    expectCorner(load("corner.stl", text, LengthUnit::Millimeter), text);
  }
  const auto cut = write("cut.stl", std::string(kStl).substr(0, 300));
  EXPECT_NE(refusalOf(cut).find("cut off, it ends without endsolid"), std::string::npos);
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
    expectCorner(load("corner.obj", text, LengthUnit::Millimeter), text);
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
    expectCorner(load("corner.off", text, LengthUnit::Millimeter), text);
  }
  for (const auto& [text, words] : { std::pair{ std::string("4OFF\n") + numbers + faces,
                                       "three coordinates, not of other dimensions" },
         { std::string("OFF BINARY\n\1\2"), "an OFF file in text form" },
         { std::string("OFF\n4 4 6\n0 0 0 100 0 0\n0 100 0 0 0 100\n") + faces,
           "each stands in a line of its own" } })
  {
    const std::string refusal = refusalOf(write("bad.off", text), LengthUnit::Millimeter);
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
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
    expectCorner(load("corner.ply", text, LengthUnit::Millimeter), text);
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
  const LoadedSurface xml = load("tetra.vtu", kTetraVtu);
  for (const LoadedSurface& surface : { legacy, xml })
  {
    EXPECT_TRUE(surface.closed);
    EXPECT_EQ(meshOf(surface).triangles.size(), 6u);
    EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0 * 3.0, 1e-9); // by determinants
  }
}

} // namespace
} // namespace palp::test
