#include "calibration/study/shipped_tables.h"
#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace palp::fem
{
namespace
{

std::string contents(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(in), {} };
}

// palp calibrate --tables: what the program ships is what it makes, byte for byte
TEST(SlowShippedTables, AreMadeAgain)
{
  const auto folder = test::freshFolder();
  makeShippedTables(folder, {}, [](const std::string&) {});
  int compared = 0;
  for (const auto& entry :
    std::filesystem::directory_iterator(std::filesystem::path(PALP_SOURCE_DIR) / "data/tables"))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(contents(folder / name) == contents(entry.path())) << name;
    ++compared;
  }
  EXPECT_EQ(compared, 11);
}

} // namespace
} // namespace palp::fem
