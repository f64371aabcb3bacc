#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

// of the block on its base
std::string blockFile(const std::filesystem::path& file, const std::string& cell)
{
  return PALP_PROGRAM " organ " PALP_SHARE "/meshes/block_50.vtp "
                      "--support bonded:box:-60,-60,-55:60,60,-45 --cell " +
    cell + " --poisson 0.45 --out " + file.string();
}

// of a radius of 30 mm on a cylinder of 24 mm, its pole at z = 0 and 30 mm above the base
void writeDome(const std::filesystem::path& file)
{
  std::ofstream dome(file);
  constexpr int kAround = 40;
  constexpr int kSide = 12;
  constexpr int kCap = 16;
  // rings of radius and height [mm], the base first
  std::vector<std::pair<double, double>> rings;
  for (int i = 1; i <= kSide; ++i)
  {
    rings.emplace_back(24.0 * i / kSide, -30.0);
  }
  const double rim = std::asin(24.0 / 30.0);
  const double height = 30.0 * (std::cos(rim) - 1.0);
  for (int i = 1; i < 8; ++i)
  {
    rings.emplace_back(24.0, -30.0 + (height + 30.0) * i / 8.0);
  }
  for (int i = kCap; i > 0; --i)
  {
    rings.emplace_back(30.0 * std::sin(rim * i / kCap), 30.0 * (std::cos(rim * i / kCap) - 1.0));
  }
  dome << "v 0 0 -30\nv 0 0 0\n";
  for (const auto& [radius, z] : rings)
  {
    for (int k = 0; k < kAround; ++k)
    {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      dome << "v " << radius * std::cos(angle) << ' ' << radius * std::sin(angle) << ' ' << z
           << '\n';
    }
  }
  const auto at = [](std::size_t ring, int k)
  { return 3 + static_cast<int>(ring) * kAround + k % kAround; };
  for (int k = 0; k < kAround; ++k)
  {
    dome << "f 1 " << at(0, k + 1) << ' ' << at(0, k) << "\nf 2 " << at(rings.size() - 1, k) << ' '
         << at(rings.size() - 1, k + 1) << '\n';
    for (std::size_t ring = 1; ring < rings.size(); ++ring)
    {
      dome << "f " << at(ring - 1, k) << ' ' << at(ring - 1, k + 1) << ' ' << at(ring, k + 1) << ' '
           << at(ring, k) << '\n';
    }
  }
}

// beside an edge as in the middle of the block: what single places tell is what a run feels
TEST(OrganCommand, SinglePlacesAreFeltAsByAFile)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "block.organ";
  ASSERT_EQ(test::runCommand(blockFile(file, "10mm")).code, 0);
  const std::string block = " " PALP_SHARE "/meshes/block_50.vtp --poisson 0.45 ";
  for (const std::string place : { "--at 48,0,0 ", "--at 10,5,0 " })
  {
    const test::Finished told = test::runCommand(PALP_PROGRAM " organ" + block + place +
      "--cell 10mm --support bonded:box:-60,-60,-55:60,60,-45 --depth 4:4:1mm");
    ASSERT_EQ(told.code, 0) << told.err;
    std::string row = told.out.substr(told.out.find('\n') + 1);
    row = row.substr(0, row.rfind(',') + 1) + "0\n"; // in place of words
    std::istringstream text(told.out.substr(0, told.out.find('\n') + 1) + row);
    const double single = test::parseCsv(text)["force_N"].at(0);
    const auto out = folder.path() / "pressed";
    const test::Finished run = test::runCommand(PALP_PROGRAM " run" + block + place +
      "--depth 4mm --law corrected --material linear --samples-only --overwrite --out " +
      out.string() + " --organ " + file.string());
    ASSERT_EQ(run.code, 0) << run.err;
    const test::CsvTable samples = test::readCsv(out / "samples.csv");
    EXPECT_NEAR(single, std::ranges::max(samples["force_N"]), 0.005 * single) << place;

    // as far as it is the contact's own depth that E is told from
    const test::Finished fit =
      test::runCommand(PALP_PROGRAM " fit " + (out / "samples.csv").string() +
        " --tip sphere:10mm --poisson 0.45 --law exact --overwrite --out " +
        (folder.path() / "fit").string());
    ASSERT_EQ(fit.code, 0) << fit.err;
    const double young = std::stod(fit.out.substr(fit.out.find(": E ") + 4));
    if (place.starts_with("--at 10"))
    {
      EXPECT_NEAR(young, 50.0, 0.5);
    }
  }
}

// the curvature of the body counts, too: finite elements of a dome on a cylinder
TEST(OrganCommand, OfADomeIsThatOfElements)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "dome.obj";
  writeDome(file);
  const test::Finished run = test::runCommand(PALP_PROGRAM " organ " + file.string() +
    " --unit mm --cell 5mm --support bonded:direction:0,0,-1:30deg --at 0,0,0 --depth 1:4:1mm "
    "--poisson 0.45");
  ASSERT_EQ(run.code, 0) << run.err;
  const test::CsvTable elements =
    test::readCsv(PALP_SOURCE_DIR "/data/reference/organ_cap_R30.csv");
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  for (int depth = 1; std::getline(lines, line); ++depth)
  {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 7; ++i)
    {
      std::getline(cells, cell, ',');
    }
    const auto row = std::ranges::find_if(
      elements["depth_m"], [depth](double one) { return std::abs(one - 1e-3 * depth) < 1e-9; });
    ASSERT_NE(row, elements["depth_m"].end());
    const double force =
      elements["force_N"][static_cast<std::size_t>(row - elements["depth_m"].begin())];
    EXPECT_NEAR(std::stod(cell), force, 0.06 * force) << depth;
  }
}

TEST(OrganCommand, ADamagedFileIsRefusedAndOneByHandTaken)
{
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "block.organ";
  ASSERT_EQ(test::runCommand(blockFile(file, "25mm")).code, 0);
  const auto press = [&]
  {
    return test::runCommand(PALP_PROGRAM
      " run " PALP_SHARE
      "/meshes/block_50.vtp --at 10,5,0 --depth 1mm --samples-only --overwrite --out " +
      (folder.path() / "pressed").string() + " --organ " + file.string());
  };
  EXPECT_EQ(press().code, 0);
  std::string text = test::readAll(file);
  const std::size_t digit = text.find_last_of("123456789", text.rfind(",0\n"));
  text[digit] = text[digit] == '9' ? '8' : static_cast<char>(text[digit] + 1);
  std::ofstream(file) << text;
  const test::Finished refused = press();
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("is not as palp organ wrote it"), std::string::npos) << refused.err;
  const std::size_t seal = text.find("# sha256:");
  ASSERT_NE(seal, std::string::npos);
  std::ofstream(file) << text.erase(seal, text.find('\n', seal) + 1 - seal);
  EXPECT_EQ(press().code, 0);
}

} // namespace
} // namespace palp
