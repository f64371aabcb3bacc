#include "calibration/study/shipped_tables.h"
#include "tests/support/process.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp::fem
{
namespace
{

// the numbers of a table, row after row; its column names and comments left out
std::vector<double> numbers(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::vector<double> found;
  for (std::string line; std::getline(in, line);)
  {
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
    {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      if (end != cell.c_str() && *end == '\0')
      {
        found.push_back(value);
      }
    }
  }
  return found;
}

// palp calibrate --tables: what the program ships is what it makes
TEST(SlowShippedTables, AreMadeAgain)
{
  const auto folder = test::freshFolder();
  makeShippedTables(folder, {}, [](const std::string&) {});
  int compared = 0;
  for (const auto& entry :
    std::filesystem::directory_iterator(std::filesystem::path(PALP_SOURCE_DIR) / "data/tables"))
  {
    const std::string name = entry.path().filename().string();
    const auto shipped = numbers(entry.path());
    const auto made = numbers(folder / name);
    ASSERT_EQ(made.size(), shipped.size()) << name;
    for (std::size_t i = 0; i < made.size(); ++i)
    {
      ASSERT_NEAR(made[i], shipped[i], 1e-3 * std::abs(shipped[i]) + 1e-5) << name << ' ' << i;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 11);
}

} // namespace
} // namespace palp::fem
