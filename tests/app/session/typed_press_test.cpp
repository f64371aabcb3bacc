#include "app/session/pointer_tool.h"

#include "haptics/units.h"
#include "tests/app/session/pointer_rig.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

// a press at a place, as it is typed
class TypedPressTest : public PointerRig
{
protected:
  // how far a depth is off the line of a speed, down and up, at most [m]
  [[nodiscard]] double offLine(double depth, double speed) const
  {
    double most = 0.0;
    const Sample* first = nullptr;
    const Sample* last = nullptr; // at the depth
    for (const Tick& tick : bench.ticks)
    {
      const Sample& now = tick.sample;
      if (!now.contact.touching())
      {
        continue;
      }
      first = first != nullptr ? first : &now;
      last = now.contact.depth > depth - 1e-7 ? &now : last;
      const double down = first->contact.depth + speed * (now.time - first->time);
      const double up = last != nullptr ? depth - speed * (now.time - last->time) : HUGE_VAL;
      most =
        std::max(most, std::abs(now.contact.depth - std::max(0.0, std::min({ depth, down, up }))));
    }
    return first != nullptr ? most : HUGE_VAL;
  }
};

// down, a rest, and up, as deep as it was told and no deeper
TEST_F(TypedPressTest, GoesToItsDepthAndBack)
{
  pointer.hover(400, 400);
  bench.run(0.5);
  for (const auto& [depth, speed] :
    { std::pair(4.0_mm, 0.01), std::pair(0.3_mm, 0.002), std::pair(8.0_mm, 0.2) })
  {
    bench.ticks.clear();
    const SurfacePoint place{ .position = { 6.0_mm, -3.0_mm, pointer.target()->position.z() },
      .normal = Eigen::Vector3d::UnitZ() };
    pointer.pressAt(place, depth, speed);
    bench.run(0.5 * depth / speed);
    EXPECT_TRUE(pointer.pressesByItself());
    pointer.hover(500, 300); // which leads it nowhere
    bench.run(1.5 * depth / speed + PointerTool::kShortest + 0.5);
    EXPECT_FALSE(pointer.pressesByItself());
    double deepest = 0.0;
    for (const Tick& tick : bench.ticks)
    {
      deepest = std::max(deepest, tick.sample.contact.depth);
      if (tick.sample.contact.touching())
      {
        EXPECT_LT((tick.sample.pose.apex - place.position).head<2>().norm(), 1e-6);
      }
    }
    EXPECT_LE(deepest, depth + 1e-6);
    EXPECT_NEAR(deepest, depth, 0.01_mm);
    EXPECT_FALSE(bench.newest().contact.touching());
  }
}

// a machine that does much else leads it now and then: what it rests is longer, and nothing else
TEST_F(TypedPressTest, IsAStraightLineHoweverLateItIsLed)
{
  constexpr double kDepth = 4.0_mm;
  constexpr double kSpeed = 0.02;
  pointer.hover(400, 400);
  bench.run(0.5);
  for (const double late : { 0.001, 0.03, 0.3, 2.0 })
  {
    bench.ticks.clear();
    bench.led = late;
    pointer.pressAt({ pointer.target()->position, pointer.target()->normal }, kDepth, kSpeed);
    bench.run(2.0 * kDepth / kSpeed + PointerTool::kShortest + 1.0 + 20.0 * late);
    EXPECT_FALSE(pointer.pressesByItself());
    EXPECT_LT(offLine(kDepth, kSpeed), 1e-6) << late;
    const auto rests = [](const Tick& tick) { return tick.sample.contact.depth > kDepth - 1e-7; };
    EXPECT_GE(1e-3 * static_cast<double>(std::ranges::count_if(bench.ticks, rests)),
      PointerTool::kShortest - 0.002)
      << late;
  }
}

// or a servo thread without a processor: the press is one, however few its samples
TEST_F(TypedPressTest, IsWholeHoweverLateTheServoIs)
{
  pointer.hover(400, 400);
  bench.run(0.5);
  for (const double tick : { 0.01, 0.04, 0.2 })
  {
    bench.ticks.clear();
    pointer.pressAt({ pointer.target()->position, pointer.target()->normal }, 2.0_mm, 0.02);
    bench.runTo(bench.now + 2.0 + 40.0 * tick, tick);
    EXPECT_FALSE(pointer.pressesByItself());
    EXPECT_LT(offLine(2.0_mm, 0.02), 1e-6) << tick;
    EXPECT_FALSE(bench.newest().contact.touching());
  }
}

TEST_F(TypedPressTest, EndsWhenTheHandTakesOver)
{
  const auto begin = [&]
  {
    pointer.hover(400, 400);
    bench.run(0.2);
    pointer.pressAt({ pointer.target()->position, pointer.target()->normal }, 4.0_mm, 0.01);
    bench.run(0.5);
    EXPECT_GT(bench.newest().contact.depth, 2.0_mm);
  };
  begin();
  pointer.letGo();
  EXPECT_EQ(asked(), 0.0);
  begin();
  pointer.press(420, 400, bench.now);
  EXPECT_EQ(asked(), 0.0); // it lifts from there before
  bench.run(0.2);
  EXPECT_DOUBLE_EQ(asked(), PointerTool::kTouch);
  pointer.letGo();
  begin();
  pointer.wheel(1);
  EXPECT_DOUBLE_EQ(asked(), PointerTool::kDepthPerNotch);
}

} // namespace
} // namespace palp
