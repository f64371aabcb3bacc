#include "haptics/units.h"
#include "tests/haptics/servo/work_over.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

const Vector3d kHalfAxes{ 50.0_mm, 35.0_mm, 25.0_mm };

Scene ellipsoidFor(const Tip& tip, LawMode mode)
{
  test::Mesh mesh = test::ball(1.0, 60);
  for (Vector3d& point : mesh.first)
  {
    point.array() *= kHalfAxes.array();
  }
  Scene scene;
  scene.surface = std::make_shared<const Surface>(test::makeSurface(std::move(mesh)));
  scene.law = ForceLaw(tip, makeMaterial(50.0_kPa, 0.45), { .mode = mode });
  scene.forceLimit = 1e3;
  return scene;
}

// so far below the top of an ellipsoid, along its normal
Vector3d below(double x, double y, double depth)
{
  const Vector3d a = kHalfAxes;
  const double z = a.z() * std::sqrt(1.0 - x * x / (a.x() * a.x()) - y * y / (a.y() * a.y()));
  const Vector3d place(x, y, z);
  return place - depth * (place.array() / a.array().square()).matrix().normalized();
}

// work that a tool of one axis gives on the way down at the top, along to (x, y), and up there, of
// that of pressing; the depth is the same all along
double gainOver(const Scene& scene, double x, double y)
{
  constexpr double kDepth = 2.0_mm;
  const auto at = [](const Vector3d& apex) { return ToolPose{ apex, -Vector3d::UnitZ() }; };
  const auto over = [&](double from, double to)
  {
    return [=](double t)
    { return at(below(x, y, kDepth) + (from + (to - from) * t) * Vector3d::UnitZ()); };
  };
  const double pressed = test::workOver(scene, 600,
    [&](double t) { return at(below(0.0, 0.0, kDepth) + 3.0_mm * (1.0 - t) * Vector3d::UnitZ()); });
  const double along =
    test::workOver(scene, 1500, [&](double t) { return at(below(x * t, y * t, kDepth)); });
  const double lifted = test::workOver(scene, 1200, over(0.0, 6.0_mm));
  return std::abs(pressed + along + lifted) / std::max(pressed, -lifted);
}

class TiltedLoop : public testing::TestWithParam<Tip>
{
};

// a flank or a rim turns against the body as the tool slides: that is felt, too
TEST_P(TiltedLoop, GivesNoEnergy)
{
  for (const LawMode mode : { LawMode::Exact, LawMode::Corrected })
  {
    const Scene scene = ellipsoidFor(GetParam(), mode);
    EXPECT_LT(gainOver(scene, 5.0_mm, 0.0), 0.02);
    EXPECT_LT(gainOver(scene, 15.0_mm, 8.0_mm), 0.02);
    EXPECT_LT(gainOver(scene, -10.0_mm, 12.0_mm), 0.02);
  }
}

TEST_P(TiltedLoop, NeverJumps)
{
  const Scene scene = ellipsoidFor(GetParam(), LawMode::Corrected);
  constexpr double kSlide = 0.02_mm;
  Vector3d before = Vector3d::Zero();
  for (double x = -15.0_mm; x < 15.0_mm; x += kSlide)
  {
    const Vector3d force = step(scene, { below(x, 0.1_mm, 2.0_mm), -Vector3d::UnitZ() }).force;
    if (!before.isZero())
    {
      ASSERT_LT((force - before).norm(), 5e-3 * force.norm()) << x;
    }
    before = force;
  }
}

INSTANTIATE_TEST_SUITE_P(Tips, TiltedLoop,
  testing::Values(Tip(SphereTip{ 10.0_mm }), Tip(ConeTip{ 60.0_deg, 20.0_mm }),
    Tip(ConeTip{ 45.0_deg, 10.0_mm }), Tip(PunchTip{ 3.0_mm }),
    Tip(TruncatedConeTip{ 60.0_deg, 4.0_mm, 20.0_mm }), Tip(ParaboloidTip{ 15.0_mm })));

} // namespace
} // namespace palp
