#include "calibration/tables/surface_table.h"

#include "haptics/error.h"
#include "tests/calibration/indentation_case.h"
#include "tests/support/process.h"

#include <fstream>
#include <functional>

namespace palp::fem
{
namespace
{

using namespace units::literals;

std::filesystem::path shipped(const std::string& name)
{
  return std::filesystem::path(PALP_SOURCE_DIR) / "data/tables" / name;
}

// finite elements at a place between all points of the grid
TEST(SurfaceTable, InterpolatesBetweenItsPlaces)
{
  const SurfaceTable table = SurfaceTable::read(shipped("surface_sphere.csv"));
  const double radius = 8.0_mm;
  Case study{ .name = "between",
    .width = 400.0_mm,
    .length = 400.0_mm,
    .height = 32.0_mm,
    .tip = SphereTip{ radius },
    .material = { 5.0_kPa, 0.27 },
    .depths = { 2.0_mm, 5.2_mm },
    .elementSize = 0.4_mm };
  for (const IndentationStep& step : completed(study).steps)
  {
    const SurfaceTable::Indentation position{ step.depth, radius, study.height, 0.27 };
    EXPECT_TRUE(table.covers(position));
    for (const double r : { 0.0, 3.0_mm, 9.0_mm, 14.0_mm, 25.0_mm })
    {
      EXPECT_NEAR(table.sinkAt(position, r), sinkOf(step, r), 0.02 * step.depth) << r;
    }
    for (const double threshold : { 0.3_mm, 0.5_mm, 1.0_mm })
    {
      const double extent = extentRadius(step.profile, threshold);
      EXPECT_NEAR(table.extentRadius(position, threshold), extent, std::max(0.3_mm, 0.04 * extent));
    }
  }
}

// the paper's blocks; under 10 mm the free sides, 5.6 radii away, let the surface sink further out
TEST(SurfaceTable, GivesTheExtentsOfTheShippedTables)
{
  const SurfaceTable table = SurfaceTable::read(shipped("surface_sphere.csv"));
  for (const auto& [name, radius] :
    { std::pair{ "sphere_r6_h30.csv", 6.0_mm }, std::pair{ "sphere_r10_h50.csv", 10.0_mm } })
  {
    const ExtentTable extents = table.extents({ 10.0_mm, radius, 5.0 * radius, 0.33 }, 0.5_mm);
    const ExtentTable papers = ExtentTable::read(shipped(name));
    for (const ExtentTable::Extent& row : papers.rows())
    {
      // deeper than the radius it is an estimate
      const double fraction = radius == 10.0_mm || row.depth > radius ? 0.08 : 0.04;
      EXPECT_NEAR(extents.extentRadius(row.depth), row.extentRadius,
        std::max(0.3_mm, fraction * row.extentRadius))
        << name << ' ' << row.depth;
    }
  }
}

TEST(SurfaceTable, SaysWhereItIsOutsideItsGrid)
{
  const SurfaceTable table = SurfaceTable::read(shipped("surface_sphere.csv"));
  EXPECT_TRUE(table.covers({ 5.0_mm, 10.0_mm, 50.0_mm, 0.33 }));
  EXPECT_FALSE(table.covers({ 15.0_mm, 10.0_mm, 50.0_mm, 0.33 }));
  EXPECT_FALSE(table.covers({ 5.0_mm, 10.0_mm, 10.0_mm, 0.33 }));
  EXPECT_FALSE(table.covers({ 5.0_mm, 10.0_mm, 50.0_mm, 0.5 }));
  // clamped to the border
  EXPECT_EQ(table.sinkAt({ 5.0_mm, 10.0_mm, 10.0_mm, 0.33 }, 12.0_mm),
    table.sinkAt({ 5.0_mm, 10.0_mm, 20.0_mm, 0.33 }, 12.0_mm));
  EXPECT_EQ(table.extentRadius({ 0.4_mm, 10.0_mm, 50.0_mm, 0.33 }, 0.5_mm), 0.0);
}

// the shipped table with line 20 changed
std::filesystem::path changed(const std::function<std::string(const std::string&)>& change)
{
  const auto file = test::freshFolder() / "table.csv";
  std::ifstream in(shipped("surface_sphere.csv"));
  std::ofstream out(file);
  std::string before;
  std::string line;
  for (int i = 0; std::getline(in, line); ++i)
  {
    out << (i == 20 ? change(before) : line + '\n');
    before = line;
  }
  return file;
}

TEST(SurfaceTable, RefusesAnIncompleteGrid)
{
  EXPECT_THROW((void)SurfaceTable::read(changed([](const std::string&) { return ""; })), Error);
}

// as many rows as the grid has places, one of them twice
TEST(SurfaceTable, RefusesAPlaceThatIsGivenTwice)
{
  EXPECT_THROW(
    (void)SurfaceTable::read(changed([](const std::string& before) { return before + '\n'; })),
    Error);
}

} // namespace
} // namespace palp::fem
