#include "pipeline/fitted_surfaces.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"
#include "tests/support/csv_table.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::DentedSurface;

const std::filesystem::path kData = std::filesystem::path(PALP_SOURCE_DIR) / "data";

test::CsvTable table(const std::string& name)
{
  std::ifstream in(kData / name);
  EXPECT_TRUE(in) << name;
  return test::parseCsv(in);
}

FittedSurfaces fitted(const std::string& name)
{
  return FittedSurfaces::read(kData / "tables" / (name + "_surface.csv"));
}

struct Case
{
  const char* table;
  const char* profiles;
  Tip tip;
};

class AgainstFiniteElements : public ::testing::TestWithParam<Case>
{
};
INSTANTIATE_TEST_SUITE_P(FittedSurfaces, AgainstFiniteElements,
  ::testing::Values(Case{ "sphere_r10_h50", "calib_sphere_R10__NH_h0.5", SphereTip{ 10.0_mm } },
    Case{ "cone45_r10_h50", "calib_cone45__NH_h0.5", BluntConeTip{ 45.0_deg, 0.3_mm, 10.0_mm } }),
  [](const auto& with) { return std::string(with.param.table); });

// the mesh as drawn, against profiles that another program computed: RMS over the surface from the
// axis to 40 mm, in per cent of the depth
TEST_P(AgainstFiniteElements, IsWithinThreePerCentOnTheMesh)
{
  const FittedSurfaces surfaces = fitted(GetParam().table);
  const test::CsvTable profiles =
    table(std::string("reference/") + GetParam().profiles + "__profiles.csv");
  DentedSurface surface = test::plane(240, 0.5_mm);
  for (const double depth : { 2.5_mm, 5.0_mm, 7.5_mm, 10.0_mm })
  {
    Press press = test::pressAt(
      Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), GetParam().tip, depth, 30.0_mm);
    press.fitted = surfaces.at(depth);
    ASSERT_TRUE(press.fitted);
    surface.press(press);
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < profiles["delta_m"].size(); ++i)
    {
      const double radius = profiles["r_ref_m"][i] + profiles["ur_m"][i];
      if (std::abs(profiles["delta_m"][i] - depth) > 1e-9 || radius > 40.0_mm)
      {
        continue;
      }
      // along the row of mesh points through the axis, linear as it is drawn
      const double at = 120.0 + radius / 0.5_mm;
      const auto below = static_cast<std::size_t>(at);
      const std::size_t row = 120 * 241;
      const double low = DentedSurface::at(surface.points, row + below).z();
      const double high = DentedSurface::at(surface.points, row + below + 1).z();
      const double drawn = low + (at - static_cast<double>(below)) * (high - low);
      sum += std::pow(drawn - profiles["uz_m"][i], 2);
      ++count;
    }
    ASSERT_GT(count, 20);
    const double rms = std::sqrt(sum / count) / depth;
    RecordProperty("rms_percent_" + std::to_string(depth), std::to_string(100.0 * rms));
    EXPECT_LE(rms, 0.03) << "depth " << depth;
  }
}

TEST(FittedSurfaces, GoesThroughItsRowsAndToNothing)
{
  const FittedSurfaces surfaces(
    { { 1.0, 3.0, 50.0, 0.5, 0.3, 0.3, 0.2 }, { 2.0, 4.0, 52.0, 1.0, 0.5, 0.5, 0.4 } });
  EXPECT_DOUBLE_EQ(surfaces.at(1.0_mm)->inner, 3.0_mm);
  EXPECT_DOUBLE_EQ(surfaces.at(2.0_mm)->sink, 1.0_mm);
  EXPECT_DOUBLE_EQ(surfaces.at(1.5_mm)->outer, 51.0_mm);
  EXPECT_DOUBLE_EQ(surfaces.at(0.5_mm)->sink, 0.25_mm);
  EXPECT_FALSE(surfaces.at(0.0));
  EXPECT_FALSE(surfaces.at(2.1_mm));
}

TEST(FittedSurfaces, RefusesWhatIsNoTable)
{
  const std::vector<double> row{ 1.0, 3.0, 50.0, 0.5, 0.3, 0.3, 0.2 };
  EXPECT_THROW(FittedSurfaces({ row }), Error);
  EXPECT_THROW(FittedSurfaces({ row, row }), Error);
  EXPECT_THROW(FittedSurfaces({ row, { 2.0, 3.0 } }), Error);
}

} // namespace
} // namespace palp
