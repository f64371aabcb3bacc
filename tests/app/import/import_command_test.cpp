#include "haptics/surface/sampling/deviation.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/dicom_series.h"
#include "tests/support/label_images.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using nlohmann::json;

// the liver with vessels and nodules: label map, names and exact surfaces, made once
const std::filesystem::path& phantom()
{
  static const std::filesystem::path folder = []
  {
    const std::filesystem::path made = test::freshFolder() / "phantom";
    const test::Finished finished =
      test::runCommand(PALP_PROGRAM " phantom liver --voxel 1.5mm --out " + made.string());
    EXPECT_EQ(finished.code, 0) << finished.err;
    return made;
  }();
  return folder;
}

Surface surfaceOf(const std::filesystem::path& file)
{
  const LoadedSurface loaded = readSurface(file);
  EXPECT_EQ(loaded.space, "LPS");
  EXPECT_TRUE(loaded.closed);
  return { pointsOf(*loaded.mesh), trianglesOf(*loaded.mesh) };
}

class ImportCommand : public testing::Test
{
protected:
  test::Finished import(const std::string& arguments)
  {
    return test::runCommand(PALP_PROGRAM " import " + arguments);
  }

  test::Finished importPhantom(const std::string& arguments)
  {
    return import((phantom() / "liver.mha").string() + " --names " +
      (phantom() / "liver.ctbl").string() + " " + arguments + " --out " + out_.string());
  }

  [[nodiscard]] json read(const char* name) const
  {
    return json::parse(test::readAll(out_ / name));
  }

  [[nodiscard]] std::vector<std::string> files() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(out_))
    {
      names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
  }

  std::filesystem::path write(
    const std::string& name, int side, const std::function<int(int, int, int)>& valueOf)
  {
    return test::writeLabels(folder_.path() / name, side, valueOf);
  }

  // a block of label 1 up to the border, a smaller one of 2 and a voxel of 3
  std::filesystem::path blocks()
  {
    return write("blocks.mha", 24,
      [](int x, int y, int z)
      {
        const bool isMiddle = y > 5 && y < 18 && z > 5 && z < 18;
        return x == 20 && y == 2 && z == 2 ? 3
          : isMiddle && x < 10             ? 1
          : isMiddle && x > 12 && x < 20   ? 2
                                           : 0;
      });
  }

  // as a CT: air, a ball of soft tissue, in it a ball of bone
  std::filesystem::path scan()
  {
    return write("scan.mha", 32,
      [](int x, int y, int z)
      {
        const double r = std::hypot(x - 15.5, y - 15.5, z - 15.5);
        const int noise = (7 * x + 11 * y + 13 * z) % 9;
        return (r < 5.0 ? 900 : r < 11.0 ? 40 : -1000) + noise;
      });
  }

  test::TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "out";
};

// against the surfaces of the formulas, which the label map was made of
TEST_F(ImportCommand, MakesTheOrgansOfALabelMap)
{
  const test::Finished finished = importPhantom("--components all");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(files(),
    (std::vector<std::string>{ "import.json", "liver.vtp", "liver_haptic.vtp", "nodules.vtp",
      "scene.json", "vessels.vtp" }));
  // a mask tells a surface to half a voxel; where parts meet, to another half
  for (const char* name : { "vessels", "nodules" })
  {
    const Surface made = surfaceOf(out_ / (std::string(name) + ".vtp"));
    const Surface exact = surfaceOf(phantom() / (std::string(name) + ".vtp"));
    EXPECT_LT(deviation(made, exact).rootMeanSquare, 1.5_mm) << name;
  }
}

TEST_F(ImportCommand, WritesASceneOfOrgans)
{
  ASSERT_EQ(importPhantom("--label 1,vessels").code, 0);
  const json scene = read("scene.json");
  EXPECT_EQ(scene.at("palp_scene"), 1);
  ASSERT_EQ(scene.at("organs").size(), 2U);
  const std::map<std::string, std::string> roles{ { "liver", "press" }, { "vessels", "show" } };
  for (const json& organ : scene.at("organs"))
  {
    const std::string name = organ.at("name");
    EXPECT_EQ(organ.at("role"), roles.at(name));
    EXPECT_TRUE(std::filesystem::exists(out_ / organ.at("file").get<std::string>()));
    EXPECT_EQ(organ.at("color").get<std::string>().size(), 7U);
  }
  EXPECT_EQ(scene.at("organs").at(0).at("tissue").at("name"), "healthy_liver");
  EXPECT_EQ(scene.at("organs").at(0).at("haptic"), "liver_haptic.vtp");
  EXPECT_FALSE(scene.at("organs").at(1).contains("haptic")) << "few points as it is";
}

// as a scene and a disk take them
TEST_F(ImportCommand, NamesEachOrganAndFileOnce)
{
  std::ofstream(folder_.path() / "names.json")
    << R"({"1": "Liver, left \"lobe\"", "2": "Liver, left \"lobe\""})";
  ASSERT_EQ(import(blocks().string() + " --label 1,2 --names " +
              (folder_.path() / "names.json").string() + " --out " + out_.string())
              .code,
    0);
  EXPECT_EQ(files(),
    (std::vector<std::string>{
      "import.json", "liver__left__lobe_.vtp", "liver__left__lobe__2.vtp", "scene.json" }));
  const json organs = read("scene.json").at("organs");
  EXPECT_EQ(organs.at(0).at("name"), "Liver_ left _lobe_");
  EXPECT_EQ(organs.at(1).at("name"), "Liver_ left _lobe__2");
  EXPECT_EQ(organs.at(1).at("file"), "liver__left__lobe__2.vtp");
}

TEST_F(ImportCommand, TellsInItsManifestWhereAllIsFrom)
{
  const auto image = blocks();
  const test::Finished finished = import(image.string() + " --out " + out_.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.err.find("label 3 has 1 voxel, too few"), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("label 1: it reaches the border"), std::string::npos) << finished.err;
  EXPECT_EQ(finished.err.find("label 2: it reaches"), std::string::npos) << finished.err;
  const json manifest = read("import.json");
  EXPECT_EQ(manifest.at("source").at("sha256").get<std::string>(),
    test::runCommand("sha256sum " + image.string()).out.substr(0, 64));
  EXPECT_EQ(manifest.at("frame"), "LPS");
  ASSERT_EQ(manifest.at("organs").size(), 2U);
  const std::array voxels{ 10 * 12 * 12, 7 * 12 * 12 };
  for (std::size_t i = 0; i < 2; ++i)
  {
    const json& organ = manifest.at("organs").at(i);
    const double milliliters = 0.125 * voxels[i];
    EXPECT_EQ(organ.at("voxels"), voxels[i]);
    EXPECT_NEAR(organ.at("voxels_ml"), milliliters, 1e-9);
    EXPECT_NEAR(organ.at("surface_ml"), milliliters, 0.01 * milliliters);
    EXPECT_LE(organ.at("shown").at("deviation_mm"), 2.5 * std::sqrt(3.0) + 1e-3);
    const LoadedSurface made = readSurface(out_ / organ.at("file").get<std::string>());
    EXPECT_TRUE(made.closed);
  }
}

// as a liver with what lies in it
TEST_F(ImportCommand, JoinsLabelsToOneOrgan)
{
  ASSERT_EQ(importPhantom("--label liver+vessels+3").code, 0);
  EXPECT_EQ(files(),
    (std::vector<std::string>{ "import.json", "liver.vtp", "liver_haptic.vtp", "scene.json" }));
  const Surface exact = surfaceOf(phantom() / "liver.vtp");
  for (const char* name : { "liver.vtp", "liver_haptic.vtp" })
  {
    const Deviation apart = deviation(surfaceOf(out_ / name), exact);
    EXPECT_LT(apart.rootMeanSquare, 0.35 * 1.5_mm) << name;
    EXPECT_LT(apart.largest, 2.0 * 1.5_mm) << name;
  }
}

TEST_F(ImportCommand, ListsTheLabelsWhereNoFolderIsNamed)
{
  const test::Finished finished = import(blocks().string());
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(finished.out, "label,name,voxels,volume_ml\n1,,1440,180\n2,,1008,126\n3,,1,0.125\n");
  std::string text = test::readAll(blocks());
  const std::string unit = "DistanceUnits = mm\n";
  text.erase(text.find(unit), unit.size());
  std::ofstream(folder_.path() / "none.mha", std::ios::binary) << text;
  const test::Finished without = import((folder_.path() / "none.mha").string());
  EXPECT_EQ(without.out, "label,name,voxels,volume_ml\n1,,1440,\n2,,1008,\n3,,1,\n");
  EXPECT_NE(without.err.find("names no unit; give --unit mm"), std::string::npos) << without.err;
}

// MetaImage by ITK names no unit, and by its own size the lesion would be one of 40 mm
TEST_F(ImportCommand, TakesALesionInTheUnitOfItsImage)
{
  const auto image = write("lesion.mha", 110,
    [](int x, int y, int z) { return (x == 9 || x == 10) && y / 2 == 20 && z / 2 == 40 ? 1 : 0; });
  std::string text = test::readAll(image);
  const std::string sides = "ElementSpacing = 5 5 5\nDistanceUnits = mm\n";
  text.replace(text.find(sides), sides.size(), "ElementSpacing = 2 2 2.5\n");
  std::ofstream(image, std::ios::binary) << text;
  const test::Finished finished = import(image.string() + " --out " + out_.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.err.find("names no unit; mm is"), std::string::npos) << finished.err;
  const json organ = read("import.json").at("organs").at(0);
  EXPECT_NEAR(organ.at("voxels_ml"), 8 * 2.0 * 2.0 * 2.5 * 1e-3, 1e-9);
  double middle[3];
  readSurface(out_ / "label_1.vtp").mesh->GetCenter(middle);
  EXPECT_LT(
    (Eigen::Vector3d(middle) - Eigen::Vector3d(19.0, 81.0, 201.25) * 1.0_mm).norm(), 0.2_mm);
}

// as a scanner gives it: 12 bits from -1024 on, in files of no order
TEST_F(ImportCommand, TakesAFolderOfDicomImages)
{
  const test::DicomGrid grid{ 24, 24, 14, { -23.0, -23.0, 300.0 }, Eigen::Vector3d::UnitX(),
    Eigen::Vector3d::UnitY(), 2.0, 2.0, 2.5 };
  const Eigen::Vector3d middle =
    writeDicom(folder_.path(), "ct", grid, "--write-xfer-little", { .series = "1.2.3.1" });
  const test::Finished finished = import((folder_.path() / "ct/").string() + " --threshold " +
    std::to_string(static_cast<int>(test::kDicomLevel)) + ":3071 --out " + out_.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(read("scene.json").at("organs").at(0).at("name"), "ct");
  const LoadedSurface ball = readSurface(out_ / "ct.vtp");
  EXPECT_EQ(ball.space, "LPS");
  for (const Eigen::Vector3d& point : pointsOf(*ball.mesh))
  {
    EXPECT_NEAR((point - middle).norm(), 1e-3 * test::kDicomRadius, 2.0_mm);
  }
}

TEST_F(ImportCommand, ProposesWhatMayBeMeantOfAScan)
{
  const auto image = scan();
  const std::string line = image.string() + " --out " + out_.string();
  const test::Finished asked = import(line);
  EXPECT_EQ(asked.code, 2);
  EXPECT_NE(asked.out.find("--threshold 200:3071 --out " + out_.string()), std::string::npos)
    << asked.out;
  EXPECT_FALSE(std::filesystem::exists(out_));
  const test::Finished bone = import(line + " --threshold 200:3071");
  ASSERT_EQ(bone.code, 0) << bone.err;
  std::uint64_t inside = 0;
  for (int i = 0; i < 32 * 32 * 32; ++i)
  {
    inside += std::hypot(i % 32 - 15.5, i / 32 % 32 - 15.5, i / 1024 - 15.5) < 5.0;
  }
  EXPECT_EQ(read("import.json").at("organs").at(0).at("voxels"), inside);
  EXPECT_EQ(import(line + " --level 450 --overwrite").code, 0);
}

TEST_F(ImportCommand, TakesAsManyPiecesAsAreAskedFor)
{
  const auto image = write("balls.mha", 32,
    [](int x, int y, int z)
    {
      const double near = std::hypot(x - 8, y - 15, z - 15);
      const double far = std::hypot(x - 24, y - 15, z - 15);
      const bool isSpeck = x == 3 && y == 29 && z == 29;
      return near < 6.0 || far < 5.0 || isSpeck ? 1 : 0;
    });
  double one = 0.0;
  for (const auto& [components, balls] :
    { std::pair("largest", 1), { "1", 1 }, { "2", 2 }, { "all", 2 } })
  {
    const std::string line = image.string() + " --overwrite --components " + components;
    const std::string told = import(line + " --out " + out_.string()).err;
    const auto says = [&](const char* what) { return told.find(what) != std::string::npos; };
    EXPECT_EQ(says("the others have 35 % of its volume"), balls == 1); // 485 of 1381 voxels
    EXPECT_FALSE(says("few voxels are smoothed away")) << "the speck is no piece";
    const double volume = read("import.json").at("organs").at(0).at("surface_ml");
    one = balls == 1 ? volume : one;
    const double expected = balls == 1 ? one : one * (1.0 + std::pow(5.0 / 6.0, 3));
    EXPECT_NEAR(volume, expected, 0.05 * expected) << components;
  }
}

TEST_F(ImportCommand, RefusesInOneSentenceAndLeavesNothing)
{
  const std::string image = blocks().string();
  const std::string surface = PALP_SHARE "/meshes/sphere_30.vtp";
  for (const auto& [arguments, words] :
    { std::pair(image + " --label 9", "no label 9 in it"),
      { image + " --label 1,2,1", "names 1 twice" },
      { image + " --label 1+", "'1+' lacks a label beside its +" },
      { image + " --label 3", "has 1 voxel, too few for a surface" },
      { image + " --threshold 5", "write it as LOW:HIGH" },
      { image + " --threshold 5:1", "write the lower value first" },
      { image + " --threshold 5:7", "no voxel has a value from 5 to 7" },
      { image + " --components 0", "give largest, all, or 1" },
      { image + " --series 1", "no folder of DICOM images" },
      { surface, "a surface already, not an image" }, { std::string("missing.nii"), "not found" } })
  {
    const test::Finished finished = import(arguments + " --out " + out_.string());
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.err.find(words), std::string::npos) << arguments << ": " << finished.err;
    EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
    EXPECT_FALSE(std::filesystem::exists(out_)) << arguments;
  }
}

TEST_F(ImportCommand, ReplacesAnEarlierImportAsAWhole)
{
  const std::string line = blocks().string() + " --out " + out_.string();
  ASSERT_EQ(import(line + " --label 1,2").code, 0);
  EXPECT_EQ(import(line + " --label 2").code, 2);
  ASSERT_EQ(import(line + " --label 2 --overwrite").code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{ "import.json", "label_2.vtp", "scene.json" }));
  // and what somebody else called like one of its organs
  std::ofstream(out_ / "label_1.vtp") << "mine";
  std::ofstream(out_ / "label_2_haptic.vtp") << "mine, too";
  const test::Finished told = import(line + " --label 1,2 --overwrite");
  EXPECT_NE(told.err.find("will replace label_1.vtp, label_2_haptic.vtp"), std::string::npos);
  EXPECT_EQ(test::readAll(out_ / "label_2_haptic.vtp"), "mine, too") << "there is no new one";
  std::filesystem::remove(out_ / "import.json"), std::filesystem::remove(out_ / "scene.json");
  const test::Finished refused = import(line + " --label 1");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("label_1.vtp already; pass --overwrite"), std::string::npos);
}

} // namespace
} // namespace palp
