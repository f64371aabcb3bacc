#include "calibration/tables/surface_table.h"

#include "tests/calibration/indentation_case.h"

#include <filesystem>

namespace palp::fem
{
namespace
{

// a radius and a block that no table was made for
TEST(SlowSurfaceTable, ExtentOfAnotherSphereIsThatOfFreshElements)
{
  const SurfaceTable table =
    SurfaceTable::read(std::filesystem::path(PALP_SOURCE_DIR) / "data/tables/surface_sphere.csv");
  Case study{ .name = "another",
    .height = 40.0_mm,
    .tip = SphereTip{ 8.0_mm },
    .depths = depthRange(0.5_mm, 8.0_mm, 0.5_mm),
    .elementSize = 0.4_mm };
  for (const double threshold : { 0.3_mm, 0.5_mm, 1.0_mm })
  {
    const ExtentTable extents = table.extents({ 8.0_mm, 8.0_mm, study.height, 0.33 }, threshold);
    double worst = 0.0;
    for (const IndentationStep& step : completed(study).steps)
    {
      const double fresh = extentRadius(step.profile, threshold);
      const double found = extents.extentRadius(step.depth);
      EXPECT_NEAR(found, fresh, std::max(0.3_mm, 0.06 * fresh)) << threshold << ' ' << step.depth;
      worst = std::max(worst, std::abs(found - fresh));
    }
    RecordProperty("worst_mm_at_" + std::to_string(units::toMillimeters(threshold)),
      std::to_string(units::toMillimeters(worst)));
  }
}

} // namespace
} // namespace palp::fem
