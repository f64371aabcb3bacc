#include "tests/pipeline/surface_files.h"

#include "haptics/units.h"
#include "tests/pipeline/sample_files.h"

#include <random>

namespace palp::test
{
namespace
{

using namespace units::literals;

struct BadFile
{
  std::string name;
  std::string content;
  ErrorCode code;
  std::string words;
};

std::vector<BadFile> badFiles()
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

  std::string facetOfTwo = kStl;
  facetOfTwo.replace(facetOfTwo.rfind("vertex"), 6, "vertx");
  std::string lessThanNone = kOff;
  lessThanNone.replace(lessThanNone.find("3 1 2 3"), 1, "-3");
  std::string flatPly = kPly;
  flatPly.replace(flatPly.find("float y"), 7, "float v");

  std::string moreInPly = kPly;
  moreInPly.replace(moreInPly.find("element face 4"), 14, "element face 3");
  std::string moreInOff = kOff;
  moreInOff.replace(moreInOff.find("4 4 6"), 5, "4 3 6");
  std::string moreInStl(84 + 2 * 50, '\0'); // two triangles
  moreInStl[80] = 1;

  std::vector<BadFile> cases = {
    { "more.ply", moreInPly, ErrorCode::BadFile, "goes on behind all that its header counts" },
    { "more.off", moreInOff, ErrorCode::BadFile, "goes on behind the 3 faces" },
    { "more.stl", moreInStl, ErrorCode::BadFile, "2 triangles where its header counts 1" },
    { "two.stl", facetOfTwo, ErrorCode::BadFile, "its facet 4 has 2 vertices" },
    { "less.off", lessThanNone, ErrorCode::BadFile, "a face has -3 corners" },
    { "flat.ply", flatPly, ErrorCode::BadFile, "its vertices have no y" },
    { "empty.stl", "", ErrorCode::BadFile, "empty" },
    { "nan.stl", notANumber, ErrorCode::BadMesh, "not a usable number" },
    { "inf.obj", infinite, ErrorCode::BadMesh, "inf.obj:3: 'inf' is not a usable number" },
    { "range.off", outOfRange, ErrorCode::BadFile,
      "range.off:12: a face refers to vertex 9, out of range (0 to 3)" },
    { "negative.ply", negative, ErrorCode::BadFile, "export" },
    { "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ErrorCode::BadMesh, "no triangles" },
    { "zero.off", "OFF\n0 0 0\n", ErrorCode::BadMesh, "no triangles" },
    { "lines.obj", "v 0 0 0\nv 100 0 0\nv 200 0 0\nf 1 2 3\n", ErrorCode::BadMesh, "area" },
    { "short.off", "OFF\n4 4 6\n0 0 0\n", ErrorCode::BadFile, "ends after line 3" },
    { "word.off", "OFF\n4 4 6\n0 0 zero\n", ErrorCode::BadFile, "word.off:3: expected" },
    { "corner.step", kStl, ErrorCode::BadFile, "a CAD model; export its surface as .stl" },
    { "scene.glb", kStl, ErrorCode::BadFile, "a scene of glTF; export its mesh as .ply" },
    { "part.3mf", kStl, ErrorCode::BadFile, "a package of 3MF; save its mesh as .stl" },
    { "two.hdr", kStl, ErrorCode::BadFile, "in two files; save it as one .nii" },
    { "one.dcm", kStl, ErrorCode::BadFile, "no DICOM file" },
    { "corner.xyz", kStl, ErrorCode::BadFile, "give a surface (.stl, .obj" },
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
  return cases;
}

// each is refused in one line that starts with the file and ends with what to do
TEST_F(SurfaceFile, ThatIsBadIsRefusedInOneSentence)
{
  for (const BadFile& bad : badFiles())
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

} // namespace
} // namespace palp::test
