#include "data/shapes.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/obj_file.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

// by 3D Slicer's rules (vtkMRMLModelStorageNode): in the scene all is RAS; a file is LPS unless it
// says SPACE=RAS in the STL header, a PLY or OBJ comment, the legacy header or a field array

namespace palp
{
namespace
{

using Eigen::Vector3d;

// no two of its corners are each other's image by any change of sign
const std::vector<Vector3d> kCorners{ { 11, 22, 33 }, { 51, 20, 35 }, { 17, 63, 30 },
  { 21, 29, 77 } };
const std::vector<Triangle> kFaces{ { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };

double volume(const std::vector<Vector3d>& p)
{
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
}

// in the order of the corners above, by how far along (1, 2, 5) they lie
std::vector<Vector3d> sorted(std::vector<Vector3d> points, const Vector3d& sign)
{
  for (Vector3d& point : points)
  {
    point = point.cwiseProduct(sign);
  }
  std::ranges::sort(points, {}, [](const Vector3d& p) { return p.dot(Vector3d(1, 2, 5)); });
  return points;
}

class Space : public testing::Test
{
protected:
  template <typename Writer, typename Set>
  std::filesystem::path write(const std::string& name, Set set)
  {
    const std::filesystem::path file = folder_.path() / name;
    const auto mesh = makePolyData(kCorners, kFaces);
    vtkNew<Writer> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(mesh);
    set(*writer, *mesh);
    writer->Write();
    return file;
  }

  std::filesystem::path writeText(const std::string& name, const std::string& head)
  {
    const std::filesystem::path file = folder_.path() / name;
    test::writeObj(file, kCorners, kFaces, Vector3d::Ones(), head);
    return file;
  }

  // those of all kinds, as 3D Slicer writes them
  std::vector<std::filesystem::path> filesOf(const std::string& space)
  {
    const std::string header = "3D Slicer output. SPACE=" + space;
    const auto named = [&](const char* kind) { return space + kind; };
    const auto head = [&](auto& writer, vtkPolyData&) { writer.SetHeader(header.c_str()); };
    const auto text = [&](auto& writer, vtkPolyData&)
    {
      writer.SetHeader(header.c_str());
      writer.SetFileTypeToASCII();
    };
    const auto bytes = [&](auto& writer, vtkPolyData&)
    {
      writer.SetHeader(header.c_str());
      writer.SetFileTypeToBinary();
    };
    return { write<vtkSTLWriter>(named("_text.stl"), text),
      write<vtkSTLWriter>(named(".stl"), bytes), write<vtkPolyDataWriter>(named(".vtk"), head),
      write<vtkPLYWriter>(
        named(".ply"), [&](auto& writer, vtkPolyData&) { writer.AddComment("SPACE=" + space); }),
      write<vtkXMLPolyDataWriter>(named(".vtp"),
        [&](auto&, vtkPolyData& mesh)
        {
          vtkNew<vtkStringArray> field;
          field->SetName("SPACE");
          field->InsertNextValue(space);
          mesh.GetFieldData()->AddArray(field);
        }),
      writeText(named(".obj"), "# " + header + "\nmtllib a.mtl\n") };
  }

  test::TemporaryFolder folder_;
};

TEST_F(Space, OfAFileIsTurnedToLeftBackAndHead)
{
  for (const std::string space : { "RAS", "LPS" })
  {
    const Vector3d sign = space == "RAS" ? Vector3d(-1, -1, 1) : Vector3d(1, 1, 1);
    const std::vector<Vector3d> expected = sorted(kCorners, sign);
    for (const auto& file : filesOf(space))
    {
      const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter);
      EXPECT_EQ(surface.space, "LPS") << file;
      const std::vector<Vector3d> found = sorted(pointsOf(*surface.mesh), Vector3d(1e3, 1e3, 1e3));
      ASSERT_EQ(found.size(), expected.size()) << file;
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_LT((found[i] - expected[i]).norm(), 1e-4) << file;
      }
      // a half turn about the head's axis is no mirror
      EXPECT_EQ(surface.notes.back().find("turned to face"), std::string::npos) << file;
    }
  }
}

// of 60 mm, which without that may as well be 600
TEST_F(Space, AFileThatStatesItsAxesIsInMillimetersAsSlicerWritesIt)
{
  for (const auto& file : filesOf("LPS"))
  {
    EXPECT_EQ(readSurface(file).unit, LengthUnit::Millimeter) << file;
  }
  EXPECT_THROW((void)readSurface(writeText("plain.obj", "")), Error);
}

// mirrored against both
TEST_F(Space, OfOtherAxesIsRefused)
{
  for (const auto& file : filesOf("LAS"))
  {
    try
    {
      (void)readSurface(file, LengthUnit::Millimeter);
      ADD_FAILURE() << file;
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("its axes are 'LAS'"), std::string::npos)
        << error.what();
    }
  }
}

// people write it so, too
TEST_F(Space, IsKnownHoweverItIsSpelled)
{
  for (const char* line : { "# SPACE = RAS", "# space=ras", "# 3D Slicer output. Space= RAS;" })
  {
    const auto file = writeText("spelled.obj", std::string(line) + '\n');
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter);
    EXPECT_EQ(surface.space, "LPS") << line;
    EXPECT_LT(1e3 * surface.mesh->GetBounds()[0], -50.0) << line;
  }
  for (const char* line : { "# MYSPACE=RAS", "# SPACE=RASX", "# space=the last frontier" })
  {
    const auto file = writeText("other.obj", std::string(line) + '\n');
    EXPECT_EQ(readSurface(file, LengthUnit::Millimeter).space, "") << line;
  }
}

TEST_F(Space, OrAUnitThatIsNotKnownIsRefused)
{
  const auto refusal = [this](const char* field, const char* word)
  {
    const auto file = write<vtkXMLPolyDataWriter>("word.vtp",
      [&](auto&, vtkPolyData& mesh)
      {
        vtkNew<vtkStringArray> words;
        words->SetName(field);
        words->InsertNextValue(word);
        mesh.GetFieldData()->AddArray(words);
      });
    try
    {
      (void)readSurface(file, std::nullopt);
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const char* word : { "IJK", "foo", "scanner-xyz" })
  {
    EXPECT_NE(refusal("SPACE", word).find(std::string("its axes are '") + word), std::string::npos);
  }
  for (const char* word : { "ras", "left-posterior-superior", "LPS" })
  {
    EXPECT_EQ(refusal("SPACE", word).find("its axes"), std::string::npos) << word;
  }
  for (const char* word : { "inch", "MM" })
  {
    EXPECT_NE(
      refusal("LengthUnit", word).find(std::string("its unit, '") + word), std::string::npos);
  }
}

TEST_F(Space, StaysUnknownWhereTheFileNamesNone)
{
  const auto plain = writeText("plain.obj", "");
  const auto late = writeText("late.obj", "v 0 0 0\n# SPACE=RAS\n"); // no header
  const auto color = writeText("color.obj", "# COLORSPACE=sRGB\n");
  for (const auto& file : { plain, late, color })
  {
    const LoadedSurface surface = readSurface(file, LengthUnit::Millimeter);
    EXPECT_EQ(surface.space, "");
    EXPECT_GT(1e3 * surface.mesh->GetBounds()[1], 50.0);
  }
}

TEST_F(Space, IsWrittenWhere3DSlicerLooks)
{
  const auto mesh = makePolyData(std::vector<Vector3d>{ 1e-3 * kCorners[0], 1e-3 * kCorners[1],
                                   1e-3 * kCorners[2], 1e-3 * kCorners[3] },
    kFaces);
  const auto written = [&](const std::string& name, const std::string& space)
  {
    writeSurface(folder_.path() / name, *mesh, space);
    return test::readAll(folder_.path() / name);
  };
  const std::string word = "SPACE=LPS";
  EXPECT_NE(written("a.stl", "LPS").substr(0, 80).find(word), std::string::npos);
  EXPECT_FALSE(written("a.stl", "LPS").starts_with("solid")); // the mark of text
  EXPECT_NE(written("a.ply", "LPS").find("\ncomment " + word + "\n"), std::string::npos);
  EXPECT_TRUE(written("a.obj", "LPS").starts_with("# " + word + "\n"));
  EXPECT_NE(written("a.vtp", "LPS").find("Name=\"SPACE\""), std::string::npos);
  for (const char* name : { "b.stl", "b.ply", "b.obj", "b.vtp" })
  {
    EXPECT_EQ(written(name, "").find("SPACE"), std::string::npos) << name;
  }
  for (const char* name : { "a.stl", "a.ply", "a.obj", "a.vtp" })
  {
    const LoadedSurface back = readSurface(folder_.path() / name, LengthUnit::Millimeter);
    EXPECT_EQ(back.space, "LPS") << name;
    const auto points = sorted(pointsOf(*back.mesh), Vector3d(1e3, 1e3, 1e3));
    EXPECT_NEAR(std::abs(volume(points)), std::abs(volume(kCorners)), 1e-2) << name;
    EXPECT_LT((points[0] - sorted(kCorners, { 1, 1, 1 })[0]).norm(), 1e-4) << name;
  }
}

} // namespace
} // namespace palp
