#include "haptics/devices/simulated/guided_tool.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kRadius = 10.0_mm;
const ToolPose kFar{ .apex = Vector3d(0, 0, 1.0) };

class GuidedToolTest : public ::testing::Test
{
protected:
  GuidedToolTest()
  {
    useSurface(test::block(Vector3d(120.0_mm, 120.0_mm, 30.0_mm), 24));
  }

  void useSurface(test::Mesh mesh)
  {
    scene_.surface = std::make_shared<const Surface>(test::makeSurface(std::move(mesh)));
    ++scene_.version;
    tool_.setScene(scene_);
  }

  void useTip(const Tip& tip)
  {
    scene_.law = ForceLaw(tip, Material{ 50e3, 0.33 });
    ++scene_.version;
    tool_.setScene(scene_);
  }

  [[nodiscard]] Contact contact() const
  {
    return findContact(*scene_.surface, scene_.law.tip(), pose_, scene_.rule);
  }

  /// @return  the greatest depth on the way [m]
  double run(int ticks)
  {
    double deepest = 0.0;
    for (int i = 0; i < ticks; ++i)
    {
      pose_ = tool_.advance(1.0_ms);
      deepest = std::max(deepest, contact().depth);
    }
    return deepest;
  }

  Scene scene_;
  GuidedTool tool_{ kFar };
  ToolPose pose_;
  Vector3d top_ = Vector3d::Zero();
};

TEST_F(GuidedToolTest, RestsUntilItsFirstTarget)
{
  run(10);
  EXPECT_EQ(pose_.apex, kFar.apex);
  EXPECT_EQ(pose_.velocity, Vector3d::Zero());
}

TEST_F(GuidedToolTest, HoversAboveItsPlaceAtOnce)
{
  tool_.moveTo({ .position = Vector3d(20.0_mm, 0, 0) });
  EXPECT_EQ(run(1), 0.0);
  EXPECT_EQ(pose_.apex, Vector3d(20.0_mm, 0, GuidedTool::kHover));
  EXPECT_EQ(pose_.velocity, Vector3d::Zero());
}

TEST_F(GuidedToolTest, PressesToItsDepthAtABoundedSpeedAndNeverBeyond)
{
  tool_.moveTo({ .depth = 4.0_mm });
  run(1);
  Vector3d last = pose_.apex;
  for (int i = 0; i < 500; ++i)
  {
    run(1);
    ASSERT_LE((pose_.apex - last).norm(), 1.5 * GuidedTool::kSpeed * 1.0_ms);
    ASSERT_NEAR((pose_.velocity * 1.0_ms - (pose_.apex - last)).norm(), 0.0, 1e-12);
    ASSERT_LE(contact().depth, 4.0_mm + 1e-5);
    last = pose_.apex;
  }
  EXPECT_NEAR(pose_.apex.z(), -4.0_mm, 0.01_mm); // the top is z = 0
  tool_.moveTo({ .depth = 1.0_mm });
  run(100);
  EXPECT_NEAR(pose_.apex.z(), -1.0_mm, 0.01_mm);
  tool_.moveTo({});
  run(100);
  EXPECT_EQ(pose_.apex, Vector3d(0, 0, GuidedTool::kHover));
}

// whatever the tick, on a plane and on a ball, down and up
TEST_F(GuidedToolTest, ChangesItsDepthAtTheSpeedOfItsTarget)
{
  constexpr double kDepth = 4.0_mm;
  const auto lineFrom = [this](double depth, double speed, double toDepth)
  {
    double most = 0.0;
    double time = 0.0;
    double first = -1.0; // time at the surface, or of the first tick
    tool_.moveTo({ .position = top_, .depth = depth, .speed = speed });
    for (int i = 0; time < 0.3 + 1.3 * std::max(depth, toDepth) / speed; ++i)
    {
      const double tick = i % 50 == 49 ? 17.0_ms : i % 7 == 3 ? 2.5_ms : 1.0_ms;
      pose_ = tool_.advance(tick);
      time += tick;
      const double now = contact().depth;
      if (now > 0.0 || toDepth > 0.0)
      {
        first = first < 0.0 ? time - (now > 0.0 && depth > 0.0 ? now / speed : tick) : first;
        const double line = depth > 0.0 ? std::min(depth, speed * (time - first))
                                        : std::max(0.0, toDepth - speed * (time - first));
        most = std::max(most, line > 0.0 ? std::abs(now - line) : 0.0);
      }
    }
    return first < 0.0 ? HUGE_VAL : most;
  };
  for (const double height : { 0.0, 50.0_mm })
  {
    height > 0.0 ? useSurface(test::ball(height, 48)) : void();
    top_ = Vector3d(0, 0, height);
    for (const double speed : { 0.01e-3, 1e-3, 10e-3, 100e-3, 1.0 })
    {
      const double depth = speed < 1e-3 ? 0.02_mm : kDepth;
      tool_.moveTo({ .position = top_ });
      run(300);
      EXPECT_LT(lineFrom(depth, speed, 0.0), 1e-6) << speed;
      EXPECT_NEAR(contact().depth, depth, 1e-7) << speed;
      EXPECT_LT(lineFrom(0.0, speed, depth), 1e-6) << speed;
      EXPECT_FALSE(contact().touching()) << speed;
    }
  }
}

TEST_F(GuidedToolTest, SlidesOverThePlaneAtItsDepth)
{
  tool_.moveTo({ .depth = 3.0_mm });
  run(300);
  tool_.moveTo({ .position = Vector3d(30.0_mm, 10.0_mm, 0), .depth = 3.0_mm });
  for (int i = 0; i < 400; ++i)
  {
    run(1);
    ASSERT_NEAR(contact().depth, 3.0_mm, 0.02_mm) << i;
  }
  EXPECT_NEAR((pose_.apex - Vector3d(30.0_mm, 10.0_mm, -3.0_mm)).norm(), 0.0, 0.05_mm);
}

// from the top to the bottom there is no way along the surface
TEST_F(GuidedToolTest, LiftsToReachTheOtherSide)
{
  tool_.moveTo({ .depth = 3.0_mm });
  run(300);
  tool_.moveTo(
    { .position = Vector3d(0, 0, -30.0_mm), .normal = -Vector3d::UnitZ(), .depth = 3.0_mm });
  EXPECT_LE(run(400), 3.0_mm + 1e-5);
  EXPECT_NEAR(pose_.apex.z(), -27.0_mm, 0.02_mm);
  EXPECT_NEAR(pose_.axis.z(), 1.0, 1e-6);
}

TEST_F(GuidedToolTest, StopsAtHalfOfTheThickness)
{
  useSurface(test::block(Vector3d(120.0_mm, 120.0_mm, 8.0_mm), 24));
  for (const Tip& tip : { Tip{ SphereTip{ kRadius } }, Tip{ PunchTip{ 4.0_mm } } })
  {
    useTip(tip);
    tool_.moveTo({ .depth = 20.0_mm });
    EXPECT_LE(run(600), 4.0_mm + 1e-5);
    EXPECT_NEAR(contact().depth, 4.0_mm, 0.25_mm); // at the middle a flat end feels both sides
    tool_.moveTo({});
    run(100);
  }
}

// a narrow slit: the tool would have to go through its walls
TEST_F(GuidedToolTest, StaysAwayFromWhereItDoesNotFit)
{
  test::Mesh two =
    test::withCopyAt(test::block(Vector3d(60.0_mm, 60.0_mm, 40.0_mm), 12), Vector3d(66.0_mm, 0, 0));
  useSurface(std::move(two));
  tool_.moveTo({ .position = Vector3d(30.0_mm, 0, -20.0_mm), .normal = Vector3d::UnitX() });
  EXPECT_EQ(run(10), 0.0);
  tool_.moveTo(
    { .position = Vector3d(30.0_mm, 0, -20.0_mm), .normal = Vector3d::UnitX(), .depth = 2.0_mm });
  EXPECT_EQ(run(500), 0.0);
}

// a tip whose widest part would be deep inside where the last one touched
TEST_F(GuidedToolTest, WithdrawsAtOnceWhereAnotherTipIsTooDeep)
{
  useSurface(test::sheet(100.0_mm, 60, [](double x, double y) { return 15.0 * (x * x + y * y); }));
  useTip(SphereTip{ 2.0_mm });
  tool_.moveTo({ .depth = 3.0_mm });
  run(300);
  ASSERT_NEAR(contact().depth, 3.0_mm, 0.02_mm);
  useTip(SphereTip{ 40.0_mm }); // wider than the hollow
  ASSERT_GT(contact().depth, 3.2_mm);
  EXPECT_LE(run(500), 3.0_mm + 1e-5);
}

TEST_F(GuidedToolTest, MovesAlikeWhateverTheTick)
{
  std::array<double, 2> reached{};
  for (const double tick : { 1.0_ms, 4.0_ms })
  {
    GuidedTool tool(kFar);
    tool.setScene(scene_);
    tool.moveTo({ .depth = 5.0_mm });
    for (double time = 0.0; time < 60.0_ms; time += tick)
    {
      pose_ = tool.advance(tick);
    }
    reached[tick > 1.0_ms] = pose_.apex.z();
  }
  EXPECT_NEAR(reached[0], reached[1], 0.6_mm); // a first-order method: of the order of a tick
}

TEST_F(GuidedToolTest, AllocatesNothing)
{
  tool_.moveTo({ .depth = 5.0_mm });
  const test::AllocationGuard guard;
  run(50);
  tool_.moveTo({ .position = Vector3d(20.0_mm, 0, 0), .depth = 3.0_mm });
  run(200);
  tool_.moveTo({});
  run(100);
  EXPECT_EQ(guard.count(), 0u);
}

TEST_F(GuidedToolTest, IgnoresWhatIsNotFinite)
{
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  tool_.moveTo({ .position = Vector3d(kNaN, 0, 0) });
  tool_.moveTo({ .depth = kNaN });
  run(3);
  EXPECT_EQ(pose_.apex, kFar.apex);
  tool_.moveTo({ .depth = 5.0_mm });
  for (const double tick : { kNaN, -1.0, 0.0, HUGE_VAL })
  {
    EXPECT_TRUE(tool_.advance(tick).apex.allFinite());
  }
  EXPECT_THROW(GuidedTool({ .apex = Vector3d(kNaN, 0, 0) }), Error);
}

} // namespace
} // namespace palp
