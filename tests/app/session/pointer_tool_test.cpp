#include "app/session/pointer_tool.h"

#include "haptics/units.h"
#include "tests/app/session/pointer_bench.h"
#include "tests/app/session/pressed_bodies.h"
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

class PointerToolTest : public ::testing::Test
{
protected:
  [[nodiscard]] double asked() const
  {
    return bench.pointer.target() ? bench.pointer.target()->depth : -1.0;
  }

  test::PointerBench bench{ block(), SphereTip{ 10.0_mm }, kAbove };
  PointerTool& pointer = bench.pointer;
};

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

// down, a rest, and up, as deep as it was told and no deeper
TEST_F(PointerToolTest, APressByItselfGoesToItsDepthAndBack)
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
    bench.run(1.5 * depth / speed + PointerTool::kShortest + 0.2);
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

// a machine that does much else leads it now and then
TEST_F(PointerToolTest, APressByItselfLeavesOutNothingWhereItIsLedLate)
{
  pointer.hover(400, 400);
  bench.run(0.5);
  for (const double late : { 0.001, 0.03, 0.3, 2.0 })
  {
    pointer.pressAt({ pointer.target()->position, pointer.target()->normal }, 4.0_mm, 0.01);
    double time = bench.now;
    double rest = 0.0;
    double before = 0.0;
    for (int i = 0; i < 5000 && pointer.pressesByItself(); ++i)
    {
      pointer.lead(time);
      pointer.lead(time); // nothing moved in between
      EXPECT_LE(std::abs(asked() - before), 0.05 * 0.01 + 1e-12) << late;
      rest += asked() == before && asked() == 4.0_mm ? std::min(late, 0.05) : 0.0;
      before = asked();
      time += late;
    }
    EXPECT_FALSE(pointer.pressesByItself());
    EXPECT_GE(rest, PointerTool::kShortest - 1e-9) << late;
  }
}

TEST_F(PointerToolTest, APressByItselfEndsWhenTheHandTakesOver)
{
  const auto begin = [&]
  {
    pointer.hover(400, 400);
    bench.run(0.2);
    pointer.pressAt({ pointer.target()->position, pointer.target()->normal }, 4.0_mm, 0.01);
    bench.run(0.3);
    EXPECT_GT(asked(), 2.0_mm);
  };
  begin();
  pointer.letGo();
  EXPECT_EQ(asked(), 0.0);
  begin();
  pointer.press(420, 400, bench.now);
  EXPECT_DOUBLE_EQ(asked(), PointerTool::kTouch);
  pointer.letGo();
  begin();
  pointer.wheel(1);
  EXPECT_DOUBLE_EQ(asked(), PointerTool::kDepthPerNotch);
}

} // namespace
} // namespace palp
