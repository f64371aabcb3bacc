#include "app/import/organ_level.h"
#include "app/import/organ_look.h"
#include "app/import/organ_names.h"
#include "data/shapes.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace palp
{
namespace
{

void nowhere(const std::string& /*behind*/, vtkPolyData& /*mesh*/)
{
}

// else one would be felt where the other is shown
TEST(NameFiles, GivesNoneTheNameOfTheCoarserLevelOfAnother)
{
  const std::vector<std::vector<std::string>> lists = { { "liver", "liver_haptic", "LIVER" },
    { "liver_haptic", "Liver", "liver haptic" }, { "a", "a_haptic", "a_haptic_haptic", "a_2" },
    { "", "label_2_haptic", "" } };
  for (const std::vector<std::string>& names : lists)
  {
    std::vector<FileOrgan> organs(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      organs[i].name = names[i];
      organs[i].label = std::to_string(i + 1);
    }
    std::vector<std::string> files;
    nameFiles(organs, files, "image");
    std::set<std::string> all;
    for (const std::string& file : files)
    {
      EXPECT_TRUE(all.insert(file).second) << file;
      EXPECT_TRUE(all.insert(file + kHaptic).second) << file;
    }
    std::set<std::string> shown;
    for (const FileOrgan& organ : organs)
    {
      EXPECT_TRUE(shown.insert(organ.name).second) << organ.name;
    }
  }
}

// the files of a disk may not tell them apart, but who reads a list does
TEST(NameFiles, CallsOrgansAsTheFileDoesWhereThoseDiffer)
{
  std::vector<FileOrgan> organs(4);
  organs[0].name = "Liver";
  organs[1].name = "liver";
  organs[2].name = "liver, right";
  organs[3].name = "liver";
  std::vector<std::string> files;
  nameFiles(organs, files, "image");
  EXPECT_EQ(files, (std::vector<std::string>{ "liver", "liver_2", "liver__right", "liver_3" }));
  EXPECT_EQ(organs[0].name, "Liver");
  EXPECT_EQ(organs[1].name, "liver");
  EXPECT_EQ(organs[3].name, "liver_2");
}

// of letters that take two bytes each, of which none may be cut in half
TEST(NameFiles, KeepsLettersBeyondAscii)
{
  std::vector<FileOrgan> organs(2);
  organs[0].name = "Foie été";
  for (int i = 0; i < 40; ++i)
  {
    organs[1].name += i == 0 ? "a" : "é";
  }
  std::vector<std::string> files;
  nameFiles(organs, files, "image");
  EXPECT_EQ(files[0], "foie_été");
  EXPECT_EQ(organs[1].name.size(), 59U); // 29 of them and the first
  EXPECT_EQ(organs[1].name.substr(57), "é");
}

// a label as thin as a voxel has no smooth surface that is sound
TEST(ImportedOrgan, TellsOfASurfaceThatPassesThroughItself)
{
  const test::TemporaryFolder folder;
  for (const bool isNoisy : { true, false })
  {
    const std::filesystem::path file = folder.path() / (std::to_string(isNoisy) + ".mha");
    std::ofstream out(file, std::ios::binary);
    out << "ObjectType = Image\nNDims = 3\nDimSize = 40 15 15\nElementType = MET_UCHAR\n"
           "ElementSpacing = 2 2 2\nDistanceUnits = mm\nElementDataFile = LOCAL\n";
    std::minstd_rand noise(1);
    for (int i = 0; i < 40 * 15 * 15; ++i)
    {
      const bool isIn = std::abs(i % 40 - 20) < 15 && std::abs(i / 40 % 15 - 7) < 5 &&
        std::abs(i / 600 - 7) < 5 && !(isNoisy && noise() % 2 == 0);
      out << (isIn ? '\1' : '\0');
    }
    out.close();
    FileOrgans found = readFileOrgans(file, {}, false);
    const ImportedOrgan organ =
      importedOrgan(std::move(found.organs.at(0)), file, LengthUnit::Millimeter, nowhere);
    const auto tells = [](const std::string& warning)
    { return warning.find("passes through itself") != warning.npos; };
    EXPECT_EQ(std::ranges::any_of(organ.warnings, tells), isNoisy);
  }
}

// where three triangles meet in an edge there is no coarser level, which a small organ needs not
TEST(ImportedOrgan, TellsWhyALargeOneHasNoCoarserLevel)
{
  for (const int subdivisions : { 3, 6 }) // 642 and 40,962 points
  {
    Mesh ball = makeSphere(50.0, subdivisions);
    const auto [a, b, c] = ball.triangles.front();
    ball.points.emplace_back(1.05 * ball.points[static_cast<std::size_t>(a)]);
    ball.triangles.push_back({ a, b, static_cast<int>(ball.points.size()) - 1 });
    FileOrgan organ;
    organ.name = "ball";
    organ.surface.points = organ.from = ball.points;
    organ.surface.triangles = ball.triangles;
    organ.voxel = 1.0;
    const ImportedOrgan found = importedOrgan(organ, "ball.mha", LengthUnit::Millimeter, nowhere);
    EXPECT_FALSE(found.felt);
    const auto tells = [](const std::string& warning)
    { return warning.find("no coarser level, so what is shown is felt") != warning.npos; };
    EXPECT_EQ(std::ranges::any_of(found.warnings, tells), subdivisions == 6);
    const auto isOther = [](const std::string& warning)
    { return warning.find("does not fit its neighbors") != warning.npos; };
    EXPECT_TRUE(std::ranges::none_of(found.warnings, isOther));
  }
}

// of 180 ml in an image of 288 mm, and in one of 120 mm that may as well be of 1.2 m
TEST(UnitOfList, IsGuessedWhereOneAloneGivesTheSizeOfOrgans)
{
  std::string note;
  for (const auto& [field, words] :
    { std::pair(288.0, "volumes are by mm"), { 120.0, "give --unit mm for volumes" } })
  {
    FileOrgans found;
    found.organs.resize(1);
    found.organs[0].voxelVolume = 180e3;
    found.organs[0].surface.field = field;
    const UnitChoice unit = unitOfList(found, std::nullopt, "image.mha", note);
    EXPECT_EQ(unit.has_value(), field > 200.0) << field;
    EXPECT_NE(note.find(words), std::string::npos) << note;
    found.unit = "cm";
    EXPECT_EQ(unitOfList(found, std::nullopt, "image.mha", note), LengthUnit::Centimeter);
  }
}

// names of TotalSegmentator, 3D Slicer and of people
TEST(LookOf, IsByAWordNotByAPartOfOne)
{
  const std::vector<std::pair<const char*, const char*>> tissues = { { "liver", "healthy_liver" },
    { "Liver 2", "healthy_liver" }, { "LIVER", "healthy_liver" }, { "liver_tumor", "hcc" },
    { "LiverTumors", "hcc" }, { "subcutaneous_fat", "fat" }, { "HCC lesion", "hcc" },
    { "torso fat", "fat" }, { "delivery tube", "" }, { "sulfate", "" }, { "Father", "" },
    { "moleskin", "" }, { "antibody", "" }, { "hcc", "hcc" }, { "liver_metastasis", "metastasis" },
    { "Liver Metastases", "metastasis" }, { "fibrosis_f4", "fibrosis_f4" },
    { "liver_cirrhosis", "cirrhosis" }, { "cirrhotic liver", "cirrhosis" },
    { "Liver (cirrhosis)", "cirrhosis" }, { "hemangioma_2", "hemangioma" },
    { "hepatocellular carcinoma", "hcc" }, { "kidney_tumor", "" }, { "brain tumor", "" },
    { "lung_nodule_left", "" }, { "tumor3", "hcc" }, { "body", "" }, { "liver1", "healthy_liver" },
    { "kidney_cyst_left", "" }, { "", "" }, { "tumor_free_liver", "" },
    { "liver_without_lesions", "" }, { "liver_fat", "" }, { "fatty liver", "" },
    { "fatal_lesion", "" }, { "skull", "" }, { "not liver", "" }, { "whole liver with tumor", "" },
    { "fat_free_mass", "" }, { "skin_lesion", "" }, { "liver phantom", "" },
    { "liver ablation zone", "" }, { "hcc metastasis", "" }, { "liver cyst", "" },
    { "liver and spleen", "" }, { "whole liver", "healthy_liver" }, { "tumor of the liver", "hcc" },
    { "Liver segment 4", "healthy_liver" }, { "\xc3\xa9 liver", "healthy_liver" } };
  for (const auto& [name, tissue] : tissues)
  {
    const char* const found = lookOf(name).tissue;
    EXPECT_STREQ(found == nullptr ? "" : found, tissue) << name;
  }
  for (const char* bone :
    { "skull", "vertebrae_L1", "ribs", "rib_left_12", "Bones", "femur_right" })
  {
    EXPECT_STREQ(lookOf(bone).role, "show") << bone;
  }
  for (const char* organ : { "fibrib", "trombone", "ovein" })
  {
    EXPECT_STREQ(lookOf(organ).role, "press") << organ;
  }
}

} // namespace
} // namespace palp
