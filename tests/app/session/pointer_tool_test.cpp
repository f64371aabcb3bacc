#include "app/session/pointer_tool.h"

#include "app/press/body.h"
#include "haptics/units.h"
#include "tests/app/session/pointer_bench.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;
using Shared = std::shared_ptr<const Surface>;

constexpr double kAllowed = 0.1_mm; // deeper than asked for
const Vector3d kAbove(0.02, 0.01, 1.0);

Shared shared(test::Mesh mesh)
{
  return std::make_shared<const Surface>(test::makeSurface(std::move(mesh)));
}

Vector3d onSphere(const Vector3d& p)
{
  return Vector3d((p.array() * (EIGEN_PI / 4.0)).tan()).normalized();
}

Shared block()
{
  return shared(test::block(Vector3d(100.0_mm, 100.0_mm, 30.0_mm), 20));
}

// 8 mm thick in its middle, nothing at its rim
Shared thinLobe()
{
  return shared(test::cubeMap(24,
    [](const Vector3d& p)
    { return Vector3d(onSphere(p).cwiseProduct(Vector3d(60.0_mm, 40.0_mm, 4.0_mm))); }));
}

// hills and hollows that the larger tools do not fit into
Shared irregular()
{
  return shared(test::cubeMap(30,
    [](const Vector3d& p)
    {
      const Vector3d n = onSphere(p);
      const double hills = std::sin(5.0 * n.x() + 1.0) * std::cos(6.0 * n.y());
      return Vector3d(50.0_mm * (1.0 + 0.25 * hills + 0.1 * std::sin(11.0 * n.z() * n.x())) * n);
    }));
}

Shared liver()
{
  setenv("PALP_DATA", PALP_SHARE, 1);
  static const Shared surface = loadBody({ { .bundled = "liver" } }, false).haptic;
  return surface;
}

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

// at once a millimetre, and 0.05 mm more with each pixel
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
  const Vector3d before = pointer.target()->place;
  pointer.hover(450, 400);
  EXPECT_DOUBLE_EQ(asked(), 4.0_mm);
  EXPECT_GT((pointer.target()->place - before).norm(), 5.0_mm);
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
  test::Mesh two = test::withCopyAt(
    test::block(Vector3d(20.0_mm, 20.0_mm, 20.0_mm), 4), Vector3d(60.0_mm, 0, 0));
  const Shared surface = shared(std::move(two));
  const auto down = [](double x, double y) // a pixel is 0.1 mm
  {
    return SightLine{ .origin = Vector3d(1e-4 * x, 1e-4 * y, 1.0),
      .direction = -Vector3d::UnitZ() };
  };
  PointerTool pointer(down);
  pointer.setSurface(surface);
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
double outsideBlock(const Vector3d& place)
{
  const Vector3d half(50.0_mm, 50.0_mm, 15.0_mm);
  const Vector3d beyond = (place + Vector3d(0, 0, 15.0_mm)).cwiseAbs() - half;
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

// a hand on a mouse: strokes, jumps, presses, notches, at a rate from a busy to a fast machine
void play(test::PointerBench& bench, double rate, unsigned seed, double duration)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto pixel = [&] { return 100.0 + 600.0 * share(random); };
  PointerTool& pointer = bench.pointer;
  Eigen::Vector2d at(400, 400);
  Eigen::Vector2d speed(0, 0); // [pixels/s]
  int down = -1;               // y of the button
  while (bench.now < duration)
  {
    bench.runTo(
      bench.now - std::log(1.0 - share(random)) / rate, share(random) < 0.02 ? 0.02 : 1e-3);
    const double what = share(random);
    speed =
      share(random) < 0.1 ? Eigen::Vector2d(2000 * share(random) - 1000, pixel() - 400) : speed;
    at += speed / rate;
    at = share(random) < 0.03 || (at.array() - 400).abs().maxCoeff() > 350
      ? Eigen::Vector2d(pixel(), pixel())
      : at;
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    if (what < 0.06 && down < 0)
    {
      down = y;
      pointer.press(x, y, bench.now);
    }
    else if (what < 0.12 && down >= 0)
    {
      down = -1;
      pointer.release(bench.now);
    }
    else if (what > 0.99)
    {
      pointer.letGo();
    }
    else if (what > 0.85)
    {
      pointer.wheel(what > 0.88 ? 1 : -1);
    }
    else if (down >= 0)
    {
      pointer.drag(down - y);
    }
    else
    {
      pointer.hover(x, y);
    }
  }
}

struct Stream
{
  std::string name;
  Shared (*surface)();
  double rate; // [1/s]
};

class EventStream : public ::testing::TestWithParam<Stream>
{
};

TEST_P(EventStream, RecordsNoSampleDeeperThanAskedForOrThanHalfTheThickness)
{
  const Shared surface = GetParam().surface();
  const std::vector<Tip> tips{ SphereTip{ 10.0_mm }, SphereTip{ 3.0_mm }, ConeTip{ 0.7, 10.0_mm },
    PunchTip{ 5.0_mm } };
  std::mt19937 random(7);
  std::normal_distribution<double> component;
  unsigned seed = 0;
  int touching = 0;
  for (const Tip& tip : tips)
  {
    test::PointerBench bench(
      surface, tip, Vector3d(component(random), component(random), component(random)));
    play(bench, GetParam().rate, ++seed, 6.0);
    EXPECT_LT(bench.excess(), kAllowed) << "tip " << tip.index() << ", seed " << seed;
    for (std::size_t i = 1; i < bench.ticks.size(); ++i)
    {
      const Contact& contact = bench.ticks[i].sample.contact;
      touching += contact.touching() ? 1 : 0;
      if (contact.depth > bench.ticks[i - 1].sample.contact.depth)
      {
        ASSERT_LT(contact.depth, 0.5 * contact.thickness + kAllowed) << bench.ticks[i].time;
      }
    }
  }
  EXPECT_GT(touching, 1000);
}

INSTANTIATE_TEST_SUITE_P(All, EventStream,
  ::testing::Values(Stream{ "LiverSlow", liver, 5.0 }, Stream{ "Liver", liver, 60.0 },
    Stream{ "LiverFast", liver, 200.0 }, Stream{ "LobeSlow", thinLobe, 5.0 },
    Stream{ "Lobe", thinLobe, 60.0 }, Stream{ "BlockSlow", block, 8.0 },
    Stream{ "BlockFast", block, 200.0 }, Stream{ "IrregularSlow", irregular, 5.0 },
    Stream{ "Irregular", irregular, 60.0 }),
  [](const auto& each) { return each.param.name; });

// what a held press did on the liver: jumps of one event each, and strokes in steps of 4 pixels
TEST(HeldPress, FollowsTheLiverOverJumpsAndStrokes)
{
  test::PointerBench bench(liver(), SphereTip{ 10.0_mm }, kAbove);
  bench.pointer.hover(400, 400);
  bench.pointer.wheel(8);
  bench.run(0.3);
  ASSERT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.02_mm);
  for (const int x : { 330, 470, 350, 500, 400, 320, 480 })
  {
    bench.pointer.hover(x, 400 + (x % 3) * 20);
    bench.run(0.5);
    ASSERT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.02_mm) << x;
  }
  for (const double speed : { 200.0, 400.0 }) // [pixels/s]
  {
    for (int x = 480; x > 330; x -= 4)
    {
      bench.pointer.hover(x, 400);
      bench.run(4.0 / speed);
      EXPECT_NEAR(bench.newest().contact.depth, 4.0_mm, 0.2_mm) << speed << ' ' << x;
    }
    bench.pointer.hover(480, 400);
    bench.run(0.5);
  }
  EXPECT_LT(bench.excess(), kAllowed);
}

} // namespace
} // namespace palp
