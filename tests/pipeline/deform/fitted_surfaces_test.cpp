#include "pipeline/deform/fitted_surfaces.h"

#include "calibration/study/study.h"
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

// RMS between the mesh as drawn and a deformed profile, over the surface from the axis to 40 mm
double rmsOnMesh(const FittedSurfaces& surfaces, const Tip& tip, double depth,
  const std::vector<Eigen::Vector2d>& profile)
{
  static DentedSurface surface = test::plane(240, 0.5_mm);
  Press press =
    test::pressAt(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), tip, depth, 30.0_mm);
  press.fitted = surfaces.at(depth);
  EXPECT_TRUE(press.fitted);
  surface.press(press);
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector2d& point : profile)
  {
    if (point.x() > 40.0_mm)
    {
      continue;
    }
    // along the row of mesh points through the axis, linear as it is drawn
    const double at = 120.0 + point.x() / 0.5_mm;
    const auto below = static_cast<std::size_t>(at);
    const std::size_t row = 120 * 241;
    const double low = DentedSurface::at(surface.points, row + below).z();
    const double high = DentedSurface::at(surface.points, row + below + 1).z();
    const double drawn = low + (at - static_cast<double>(below)) * (high - low);
    sum += std::pow(drawn - point.y(), 2);
    ++count;
  }
  EXPECT_GT(count, 20);
  return std::sqrt(sum / count);
}

// profiles that another program computed
TEST_P(AgainstFiniteElements, IsWithinThreePerCentOnTheMesh)
{
  const test::CsvTable table =
    ::palp::table(std::string("reference/") + GetParam().profiles + "__profiles.csv");
  for (const double depth : { 2.5_mm, 5.0_mm, 7.5_mm, 10.0_mm })
  {
    std::vector<Eigen::Vector2d> profile;
    for (std::size_t i = 0; i < table["delta_m"].size(); ++i)
    {
      if (std::abs(table["delta_m"][i] - depth) < 1e-9)
      {
        profile.emplace_back(table["r_ref_m"][i] + table["ur_m"][i], table["uz_m"][i]);
      }
    }
    const double rms = rmsOnMesh(fitted(GetParam().table), GetParam().tip, depth, profile) / depth;
    RecordProperty("rms_percent_" + std::to_string(depth), std::to_string(100.0 * rms));
    EXPECT_LE(rms, 0.03) << "depth " << depth;
  }
}

// shallow, where those have no profile: our own elements, finer than those of the table
TEST_P(AgainstFiniteElements, IsWithinThreePerCentAtOneMillimeter)
{
  const fem::Case shallow{
    .tip = GetParam().tip, .depths = { 0.5_mm, 1.0_mm }, .elementSize = 0.25_mm
  };
  const fem::Outcome outcome = calibrate(shallow);
  ASSERT_EQ(outcome.steps.size(), 2U) << outcome.error;
  const fem::IndentationStep& pressed = outcome.steps.back();
  std::vector<Eigen::Vector2d> profile;
  for (const fem::IndentationStep::Point& point : pressed.profile)
  {
    profile.emplace_back(point.radius + point.ur, point.uz);
  }
  const double rms = rmsOnMesh(fitted(GetParam().table), GetParam().tip, 1.0_mm, profile) / 1.0_mm;
  RecordProperty("rms_percent", std::to_string(100.0 * rms));
  EXPECT_LE(rms, 0.03);
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
}

// with the tool, by no more than the tool, and no place comes up again
TEST(FittedSurfaces, SinkOnBeyondTheLastRow)
{
  for (const char* name : { "sphere_r10_h50", "sphere_r6_h30", "cone45_r10_h50", "cone45_r6_h30" })
  {
    const double radius = std::string(name).find("_r6") == std::string::npos ? 10.0_mm : 6.0_mm;
    const FittedSurfaces surfaces =
      FittedSurfaces::read(kData / "tables" / (std::string(name) + "_surface.csv"), 1.0, radius);
    const double step = 0.02_mm;
    for (double depth = surfaces.deepest(); depth < 2.5 * surfaces.deepest(); depth += step)
    {
      const SurfaceProfile before = *surfaces.at(depth);
      const SurfaceProfile after = *surfaces.at(depth + step);
      for (double at = after.inner; at < 60.0_mm; at += 0.5_mm)
      {
        const double sunk = after.sinkAt(at) - before.sinkAt(at);
        ASSERT_LE(sunk, 1.001 * step) << name << " at " << depth << ", " << at;
        ASSERT_GE(sunk, -1e-12) << name << " at " << depth << ", " << at;
      }
    }
  }
}

// the block of the elements ends at 56 mm; what cannot be seen stays at rest
TEST(FittedSurfaces, EndWhereASinkIsNone)
{
  const double scale = 2.0;
  const FittedSurfaces large =
    FittedSurfaces::read(kData / "tables" / "sphere_r10_h50_surface.csv", scale);
  const FittedSurfaces whole = fitted("sphere_r10_h50");
  EXPECT_LT(large.at(1.3_mm)->reach(), 55.0_mm);
  for (const double depth : { 0.5_mm, 2.0_mm, 5.0_mm, 10.0_mm })
  {
    SurfaceProfile full = *whole.at(depth);
    const SurfaceProfile drawn = full;
    full.rest = 0.0;
    for (double radius = full.inner; radius < full.outer; radius += 0.1_mm)
    {
      EXPECT_NEAR(drawn.sinkAt(radius), full.sinkAt(radius), 0.015 * depth) << radius;
    }
    EXPECT_EQ(drawn.sinkAt(drawn.reach() + 1e-6), 0.0);
  }
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
