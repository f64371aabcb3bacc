#include "app/session/pointer_tool.h"

#include "haptics/units.h"
#include "tests/app/session/pointer_rig.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

using PointerToolTest = PointerRig;

TEST_F(PointerToolTest, AsksForNothingBeforeItIsOverTheBody)
{
  pointer.wheel(3);
  pointer.press(5, 5, 0.0);
  pointer.drag(100);
  EXPECT_FALSE(pointer.target());
  pointer.hover(400, 400);
  ASSERT_TRUE(pointer.target());
  EXPECT_EQ(asked(), 0.0);
}

TEST_F(PointerToolTest, PressesBesideTheBodyTouchNothing)
{
  pointer.hover(400, 400);
  pointer.press(5, 5, 0.0);
  pointer.drag(100);
  EXPECT_EQ(asked(), 0.0);
}

// at once a millimeter, and 0.05 mm more with each pixel
TEST_F(PointerToolTest, AButtonPressesAndADragGoesDeeper)
{
  pointer.press(400, 400, 0.0);
  EXPECT_DOUBLE_EQ(asked(), 1.0_mm);
  pointer.drag(60);
  EXPECT_DOUBLE_EQ(asked(), 4.0_mm);
  pointer.drag(-30);
  EXPECT_EQ(asked(), 0.0);
  pointer.release(2.0);
  EXPECT_EQ(asked(), 0.0);
}

TEST_F(PointerToolTest, AClickIsSeenForAMoment)
{
  bench.runTo(0.1);
  pointer.press(400, 400, 0.1);
  bench.runTo(0.15);
  pointer.release(0.15);
  pointer.hover(401, 399); // a hand that trembles
  bench.runTo(0.1 + PointerTool::kShortest);
  EXPECT_NEAR(bench.newest().contact.depth, 1.0_mm, 0.05_mm);
  bench.run(0.05);
  EXPECT_FALSE(bench.newest().contact.touching());
}

// as fast as a double click, each as a click by itself is
TEST_F(PointerToolTest, QuickClicksAreOnePressEach)
{
  for (int i = 0; i < 5; ++i)
  {
    pointer.press(400 + 8 * i, 400, bench.now);
    bench.run(0.08);
    pointer.release(bench.now);
    bench.run(0.12);
  }
  bench.run(0.5);
  int presses = 0;
  double apart = 1.0; // [s] since the tool touched
  for (const test::Tick& tick : bench.ticks)
  {
    const bool touches = tick.sample.contact.touching();
    presses += touches && apart > 0.02 ? 1 : 0;
    apart = touches ? 0.0 : apart + 1e-3;
  }
  EXPECT_EQ(presses, 5);
  EXPECT_FALSE(bench.newest().contact.touching());
}

TEST_F(PointerToolTest, ADragEndsWithItsButton)
{
  pointer.press(400, 400, 0.0);
  pointer.drag(40);
  pointer.release(0.05);
  EXPECT_EQ(asked(), 0.0);
}

TEST_F(PointerToolTest, TheWheelHoldsADepthWhileThePointerMoves)
{
  pointer.hover(400, 400);
  pointer.wheel(8);
  EXPECT_DOUBLE_EQ(asked(), 4.0_mm);
  const Vector3d before = pointer.target()->position;
  pointer.hover(450, 400);
  EXPECT_DOUBLE_EQ(asked(), 4.0_mm);
  EXPECT_GT((pointer.target()->position - before).norm(), 5.0_mm);
  pointer.wheel(-3);
  EXPECT_DOUBLE_EQ(asked(), 2.5_mm);
  pointer.press(450, 400, 1.0); // goes on from there
  EXPECT_DOUBLE_EQ(asked(), 2.5_mm);
  pointer.drag(10);
  EXPECT_DOUBLE_EQ(asked(), 3.0_mm);
  pointer.wheel(1); // deeper, and the drag goes on
  pointer.drag(20);
  EXPECT_DOUBLE_EQ(asked(), 4.0_mm);
  pointer.release(2.0);
  EXPECT_DOUBLE_EQ(asked(), 2.5_mm);
}

TEST_F(PointerToolTest, StopsAtHalfOfTheThickness)
{
  pointer.hover(400, 400);
  pointer.wheel(100);
  EXPECT_NEAR(asked(), 15.0_mm, 1e-9);
  pointer.wheel(-1);
  EXPECT_NEAR(asked(), 14.5_mm, 1e-9);
  pointer.press(400, 400, 0.0);
  pointer.drag(1000);
  EXPECT_NEAR(asked(), 15.0_mm, 1e-9);
}

TEST_F(PointerToolTest, LetsGoWithoutTheSurface)
{
  const auto hold = [this]
  {
    pointer.hover(400, 400);
    pointer.wheel(4);
    ASSERT_DOUBLE_EQ(asked(), 2.0_mm);
  };
  hold();
  pointer.hover(5, 5);
  EXPECT_EQ(asked(), 0.0);
  pointer.hover(400, 400);
  EXPECT_EQ(asked(), 0.0);
  hold();
  pointer.letGo();
  EXPECT_EQ(asked(), 0.0);
  hold();
  pointer.press(400, 400, 0.0);
  pointer.drag(30);
  pointer.letGo();
  pointer.drag(40); // of a button that is still down
  EXPECT_EQ(asked(), 0.0);
}

// two bodies beside each other: no event need tell of the gap between them
TEST(PointerTool, LetsGoInAGapThatNoEventTellsOf)
{
  test::Mesh two =
    test::withCopyAt(test::block(Vector3d(20.0_mm, 20.0_mm, 20.0_mm), 4), Vector3d(60.0_mm, 0, 0));
  const Shared surface = shared(std::move(two));
  const auto down = [](double x, double y) // a pixel is 0.1 mm
  {
    return SightLine{ .origin = Vector3d(1e-4 * x, 1e-4 * y, 1.0),
      .direction = -Vector3d::UnitZ() };
  };
  PointerTool pointer(down);
  pointer.setSurfaces({ surface });
  pointer.hover(0, 0);
  pointer.wheel(4);
  pointer.hover(50, 20); // on the same one
  EXPECT_DOUBLE_EQ(pointer.target()->depth, 2.0_mm);
  pointer.hover(600, 0);
  EXPECT_EQ(pointer.target()->depth, 0.0);

  pointer.hover(0, 0);
  pointer.wheel(4);
  pointer.turnView(); // the way between the two is none of the pointer's
  pointer.hover(600, 0);
  EXPECT_DOUBLE_EQ(pointer.target()->depth, 2.0_mm);
}

// distance of a place to a block whose top is z = 0, by hand
double outsideBlock(const Vector3d& position)
{
  const Vector3d half(50.0_mm, 50.0_mm, 15.0_mm);
  const Vector3d beyond = (position + Vector3d(0, 0, 15.0_mm)).cwiseAbs() - half;
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

// the depth from another formula than the contact search; about its edges the search rounds a body
// over one and a half edge lengths of the mesh
TEST(PointerTool, IsNoDeeperThanAskedForByTheGeometryOfABlock)
{
  constexpr double kRadius = 10.0_mm;
  test::PointerBench bench(block(), SphereTip{ kRadius }, Vector3d(1.0, 0.7, 0.9));
  std::mt19937 random(1);
  std::uniform_int_distribution<int> pixel(150, 650);
  for (int i = 0; i < 40; ++i)
  {
    bench.pointer.hover(pixel(random), pixel(random));
    bench.pointer.wheel(bench.pointer.target() && bench.pointer.target()->depth > 0.0 ? 0 : 12);
    bench.run(0.15);
  }
  const auto depth = [=](const Sample& sample)
  {
    const Vector3d center = sample.pose.apex - kRadius * sample.pose.axis;
    const Vector3d side = (center + Vector3d(0, 0, 15.0_mm)).cwiseAbs();
    const int beside = (side.x() > 40.0_mm) + (side.y() > 40.0_mm) + (side.z() > 5.0_mm);
    return beside > 1 ? 0.0 : kRadius - outsideBlock(center);
  };
  EXPECT_LT(bench.excess(depth), kAllowed);
  EXPECT_LT(bench.excess(), kAllowed);
  double deepest = 0.0;
  for (const test::Tick& tick : bench.ticks)
  {
    deepest = std::max(deepest, depth(tick.sample));
  }
  EXPECT_NEAR(deepest, 6.0_mm, kAllowed); // it did press
}

TEST(PointerTool, IsNoDeeperThanAskedForByTheGeometryOfABall)
{
  constexpr double kBall = 50.0_mm;
  constexpr double kRadius = 10.0_mm;
  test::PointerBench bench(shared(test::ball(kBall, 48)), SphereTip{ kRadius }, kAbove);
  bench.pointer.hover(400, 400);
  bench.pointer.wheel(8);
  bench.run(0.2);
  for (int i = 1; i <= 60; ++i) // 5 events a second, up to 10 mm apart
  {
    bench.pointer.hover(400 + static_cast<int>(120 * std::sin(0.4 * i)),
      400 + static_cast<int>(120 * std::sin(0.31 * i)));
    bench.run(0.2);
    ASSERT_GT(bench.newest().contact.depth, 3.9_mm); // still held, and there
  }
  const auto depth = [=](const Sample& sample)
  { return kRadius + kBall - (sample.pose.apex - kRadius * sample.pose.axis).norm(); };
  EXPECT_LT(bench.excess(depth), kAllowed);
}

} // namespace
} // namespace palp
