#include "tests/support/process.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace palp
{
namespace
{

// a ball in each of 64 cells of 10 voxels of 5 mm, none as large as another
std::filesystem::path writeBalls(const std::filesystem::path& file)
{
  std::ofstream out(file, std::ios::binary);
  out << "NDims = 3\nElementSpacing = 5 5 5\nDistanceUnits = mm\nDimSize = 40 40 40\n"
         "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  for (int i = 0; i < 40 * 40 * 40; ++i)
  {
    const int x = i % 40;
    const int y = i / 40 % 40;
    const int z = i / 1600;
    const int cell = x / 10 + 4 * (y / 10) + 16 * (z / 10);
    const double off = std::hypot(x % 10 - 4.5, y % 10 - 4.5, z % 10 - 4.5);
    out << (off < 2.0 + 2.7 * (cell * 7 % 64) / 64.0 ? static_cast<char>(cell + 1) : '\0');
  }
  return file;
}

test::Finished import(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " import " + arguments);
}

// several processes read them, some labels each
TEST(ManyLabels, AreMadeAsEachAloneIs)
{
  const test::TemporaryFolder folder;
  const std::string image = writeBalls(folder.path() / "many.mha").string();
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

} // namespace
} // namespace palp
