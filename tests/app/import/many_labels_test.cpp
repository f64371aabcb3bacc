#include "tests/support/label_images.h"
#include "tests/support/process.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tuple>

namespace palp
{
namespace
{

// a ball in each of 64 cells of 10 voxels, none as large as another
int ballAt(int x, int y, int z)
{
  const int cell = x / 10 + 4 * (y / 10) + 16 * (z / 10);
  const double off = std::hypot(x % 10 - 4.5, y % 10 - 4.5, z % 10 - 4.5);
  return off < 2.0 + 2.7 * (cell * 7 % 64) / 64.0 ? cell + 1 : 0;
}

test::Finished import(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " import " + arguments);
}

// several processes read them, some labels each
TEST(ManyLabels, AreMadeAsEachAloneIs)
{
  const test::TemporaryFolder folder;
  const std::string image = test::writeLabels(folder.path() / "many.mha", 40, ballAt).string();
  const std::filesystem::path all = folder.path() / "all";
  const test::Finished finished = import(image + " --out " + all.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto organs = nlohmann::json::parse(test::readAll(all / "import.json"))["organs"];
  ASSERT_EQ(organs.size(), 64U);
  for (std::size_t i = 0; i < organs.size(); ++i)
  {
    EXPECT_EQ(organs.at(i)["label"], std::to_string(i + 1));
  }
  for (const std::string label : { "1", "28", "64" })
  {
    const std::filesystem::path alone = folder.path() / label;
    ASSERT_EQ(import(image + " --label " + label + " --out " + alone.string()).code, 0);
    const std::string name = "label_" + label + ".vtp";
    EXPECT_EQ(test::readAll(all / name), test::readAll(alone / name)) << label;
  }
}

// label 1 is a block, label 2 two bars of 7 and 3 voxels
TEST(ManyLabels, ThatAreCrumbsAreLeftOutUnlessTheyAreAskedFor)
{
  const test::TemporaryFolder folder;
  const auto image = test::writeLabels(folder.path() / "crumbs.mha", 20,
    [](int x, int y, int z)
    {
      const bool isBar = z == 17 && ((y == 3 && x < 7) || (y == 9 && x < 3));
      return isBar ? 2 : x > 4 && x < 15 && y > 4 && y < 15 && z > 2 && z < 12 ? 1 : 0;
    });
  const std::filesystem::path made = folder.path() / "made";
  const test::Finished all = import(image.string() + " --out " + made.string());
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_NE(all.err.find("label 2: left out, what hangs together of it has less than eight voxels"),
    std::string::npos)
    << all.err;
  EXPECT_TRUE(std::filesystem::exists(made / "label_1.vtp"));
  EXPECT_FALSE(std::filesystem::exists(made / "label_2.vtp"));
  const auto organs = nlohmann::json::parse(test::readAll(made / "scene.json"))["organs"];
  EXPECT_EQ(organs.size(), 1U);
  const test::Finished asked =
    import(image.string() + " --label 1,2 --out " + (folder.path() / "asked").string());
  EXPECT_EQ(asked.code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "asked"));
}

TEST(ManyLabels, AreToldApartByTheCaseOfTheirNames)
{
  const test::TemporaryFolder folder;
  const auto image = test::writeLayers(folder.path() / "case.seg.nrrd", 5,
    "Segment0_Name:=Liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment1_Name:=liver\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n",
    [](int i) {
      return std::string{ i < 32 ? '\1' : '\0', i % 4 < 2 && i / 16 < 3 ? '\1' : '\0' };
    });
  for (const auto& [name, voxels, code] :
    { std::tuple("Liver", 32, 0), { "liver", 24, 0 }, { "LIVER", 0, 2 } })
  {
    const std::filesystem::path made = folder.path() / name;
    const test::Finished finished =
      import(image.string() + " --unit mm --label " + name + " --out " + made.string());
    EXPECT_EQ(finished.code, code) << finished.err;
    if (code == 0)
    {
      const auto told = nlohmann::json::parse(test::readAll(made / "import.json"));
      EXPECT_EQ(told["organs"].at(0)["voxels"], voxels) << name;
    }
  }
}

// of three labels the third is called as the value of the first
TEST(ManyLabels, ANumberIsAValueBeforeItIsAName)
{
  const test::TemporaryFolder folder;
  const auto image = test::writeLabels(folder.path() / "a.mha", 16,
    [](int x, int y, int z)
    {
      const bool isIn = y > 2 && y < 13 && z > 2 && z < 13;
      return !isIn || x < 2 || x > 13 ? 0 : x < 8 ? 1 : x < 12 ? 2 : 3;
    });
  const std::filesystem::path names = folder.path() / "names.json";
  std::ofstream(names) << R"({"1": "liver", "2": "spleen", "3": "1"})";
  for (const auto& [label, voxels] : { std::pair("liver", "600"), { "1", "600" }, { "3", "200" },
         { "liver+spleen", "1000" }, { "spleen", "400" } })
  {
    const std::filesystem::path made = folder.path() / label;
    const test::Finished finished = import(image.string() + " --names " + names.string() +
      " --label " + label + " --out " + made.string());
    ASSERT_EQ(finished.code, 0) << finished.err;
    const auto told = nlohmann::json::parse(test::readAll(made / "import.json"));
    EXPECT_EQ(std::to_string(told["organs"].at(0)["voxels"].get<int>()), voxels) << label;
  }
}

TEST(ManyLabels, WhatIsNotFeltByItsNameIsTold)
{
  const test::TemporaryFolder folder;
  const auto image = test::writeLabels(folder.path() / "a.mha", 16,
    [](int x, int y, int z) {
      return y < 3 || y > 12 || z < 3 || z > 12 || x < 2 ? 0 : x < 6 ? 1 : x < 10 ? 2 : 3;
    });
  const std::filesystem::path names = folder.path() / "names.json";
  std::ofstream(names) << R"({"1": "skin", "2": "liver", "3": "ribs"})";
  const test::Finished finished = import(
    image.string() + " --names " + names.string() + " --out " + (folder.path() / "out").string());
  EXPECT_NE(
    finished.err.find("by their names: skin (see-through), ribs (only shown);"), std::string::npos)
    << finished.err;
}

} // namespace
} // namespace palp
