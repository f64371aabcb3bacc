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

  const auto changed = [](std::string text, const std::string& from, const std::string& to)
  { return text.replace(text.rfind(from), from.size(), to); };
  const std::string notANumber = changed(kStl, "100", "nan");
  const std::string infinite = changed(kObj, "v 100", "v inf");
  const std::string outOfRange = changed(kOff, "3 1 2 3", "3 1 2 9");
  const std::string negative = changed(kPly, "3 1 2 3", "3 1 -2 3");
  const std::string facetOfTwo = changed(kStl, "vertex", "corner");
  const std::string lessThanNone = changed(kOff, "3 1 2 3", "-3 1 2 3");
  const std::string flatPly = changed(kPly, "float y", "float v");
  const std::string moreInPly = changed(kPly, "element face 4", "element face 3");
  const std::string moreInOff = changed(kOff, "4 4 6", "4 3 6");
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
