#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/servo/work_over.h"
#include "tests/support/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kSpacing = 4.0_mm;
constexpr double kEdge = 30.0_mm; // of the top, from its middle

// What a block gives way at places of its top and side, more toward the edge between them as a
// wedge does, and each by some tenths as it comes: no energy may hang on how well they agree.
std::shared_ptr<const ComplianceField> roughField(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> some(0.7, 1.3);
  std::vector<PlacedCompliance> places;
  const auto add = [&](const Vector3d& position, const Vector3d& normal, const Vector3d& way)
  {
    const double distance = std::max(0.5_mm, (kEdge * Vector3d::UnitX() - position).dot(way));
    const double wedge = 0.05 * some(random);
    PlacedCompliance& place = places.emplace_back();
    place.position = position;
    place.normal = normal;
    place.constant = 40.0 * some(random) + wedge / distance;
    place.slope = wedge / (2.0 * distance * distance) * way;
    place.bend = 4e4 * some(random);
    place.edge = distance < 20.0_mm ? 1.0 / distance : 0.0;
  };
  for (int i = 0; i < 9; ++i)
  {
    for (int k = -9; k <= 9; ++k)
    {
      const double away = kSpacing * (i + 0.4 * some(random));
      const double along = kSpacing * (k + 0.4 * some(random));
      add({ kEdge - away, along, 0.0 }, Vector3d::UnitZ(), Vector3d::UnitX());
      add({ kEdge, along, -away }, Vector3d::UnitX(), Vector3d::UnitZ());
    }
  }
  return std::make_shared<const ComplianceField>(places, kSpacing, 0.45);
}

class OrganRim : public testing::TestWithParam<Tip>
{
};

TEST_P(OrganRim, NoWayThereAndBackGivesEnergy)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(
    test::makeSurface(test::block({ 2.0 * kEdge, 80.0_mm, 40.0_mm }, 24)));
  scene.law = ForceLaw(GetParam(), makeMaterial(50.0_kPa, 0.45),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  scene.forceLimit = 1e3;
  double most = 0.0;
  for (const unsigned seed : { 1U, 2U, 3U })
  {
    scene.series = seriesBodyOf(roughField(seed), scene.law);
    for (const double away : { -3.0_mm, -1.0_mm, 0.5_mm, 1.45_mm, 2.0_mm, 4.0_mm, 9.0_mm })
    {
      for (const double turn : { 0.0, 0.7, 1.6, 3.0 }) // along the edge to across it
      {
        const Vector3d from(kEdge - away, -3.0_mm, 2.0_mm);
        const Vector3d drag = 7.0_mm * Vector3d(-std::sin(turn), std::cos(turn), 0.0);
        const Vector3d down = -6.0_mm * Vector3d::UnitZ();
        const auto leg = [&](const Vector3d& begin, const Vector3d& move)
        {
          return test::workOver(scene, 400,
            [&](double t)
            { return ToolPose{ .apex = begin + t * move, .axis = -Vector3d::UnitZ() }; });
        };
        const double pressed = leg(from, down);
        const double dragged = leg(from + down, drag);
        const double lifted = leg(from + down + drag, -down);
        const double peak = std::max(pressed, pressed + dragged);
        ASSERT_GT(peak, 1e-5);
        const double gain = std::abs(pressed + dragged + lifted) / peak;
        EXPECT_LT(gain, 3e-3) << away << ' ' << turn << ' ' << seed;
        most = std::max(most, gain);
      }
    }
  }
  RecordProperty("most_percent", std::to_string(100.0 * most));
}

INSTANTIATE_TEST_SUITE_P(Tips, OrganRim,
  testing::Values(
    SphereTip{ 10.0_mm }, SphereTip{ 4.0_mm }, SphereTip{ 25.0_mm }, ParaboloidTip{ 10.0_mm }));

} // namespace
} // namespace palp
