#include "haptics/devices/simulated/scripted_device.h"

#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kPeriod = 1.0_ms;
const Vector3d kDown = -Vector3d::UnitZ();

// 5 mm into a block whose upper face is z = 0, and 40 mm along it; it lasts a second
const ScriptedPath kSlide({ { .time = 3.0, .apex = Vector3d(0.0, 0.0, 5.0_mm) },
  { .time = 3.2, .apex = Vector3d(0.0, 0.0, -5.0_mm) },
  { .time = 4.0, .apex = Vector3d(40.0_mm, 0.0, -5.0_mm) } });

ToolPose turn(ScriptedDevice& device)
{
  return *device.exchange(Vector3d::Zero(), kPeriod);
}

ToolPose turns(ScriptedDevice& device, int ticks)
{
  ToolPose pose;
  for (int tick = 0; tick < ticks; ++tick)
  {
    pose = turn(device);
  }
  return pose;
}

PlayOrder soughtTo(double place, bool plays = false)
{
  return { .plays = plays, .place = place, .seeks = 1 };
}

TEST(PlayedDevice, WithoutAnOrderGoesAsThePath)
{
  ScriptedDevice device(kSlide);
  for (int tick = 1; tick < 1000; ++tick)
  {
    const ToolPose pose = turn(device);
    EXPECT_NEAR(device.reached(), kPeriod * tick, 1e-12);
    const ToolPose known = kSlide.poseAt(3.0 + device.reached(), kDown);
    ASSERT_EQ(pose.apex, known.apex);
    ASSERT_EQ(pose.velocity, known.velocity);
  }
  EXPECT_EQ(turns(device, 10).velocity, Vector3d::Zero());
  EXPECT_EQ(device.reached(), 1.0);
}

// its velocity is what its places say
TEST(PlayedDevice, MovesAsFastAsItIsPlayed)
{
  for (const double speed : { 0.1, 0.5, 1.0, 2.0, 4.0 })
  {
    ScriptedDevice device(kSlide);
    device.play({ .speed = speed });
    ToolPose before = turn(device);
    for (int tick = 2; speed * tick < 999; ++tick)
    {
      const ToolPose pose = turn(device);
      const Vector3d moved = (pose.apex - before.apex) / kPeriod;
      const double last = 1e3 * device.reached();
      if (last - speed > 200.0 || last < 200.0) // not around the corner
      {
        ASSERT_LT((moved - pose.velocity).norm(), 1e-9) << speed << ' ' << tick;
      }
      before = pose;
    }
  }
}

TEST(PlayedDevice, RestsWhereItIsPausedAndGoesOnFromThere)
{
  ScriptedDevice device(kSlide);
  const ToolPose before = turns(device, 300);
  device.play({ .plays = false });
  for (int tick = 0; tick < 500; ++tick)
  {
    const ToolPose pose = turn(device);
    ASSERT_EQ(pose.apex, before.apex);
    ASSERT_EQ(pose.velocity, Vector3d::Zero());
  }
  device.play({ .speed = 4.0 });
  EXPECT_NEAR(turn(device).apex.x(), before.apex.x() + 4 * 50e-3 * kPeriod, 1e-12);
}

TEST(PlayedDevice, IsTakenOffTheTissueToAFarPlace)
{
  ScriptedDevice device(kSlide);
  (void)turns(device, 300);
  device.play(soughtTo(0.8));
  const Vector3d there = kSlide.poseAt(3.8, kDown).apex;
  int lifted = 0;
  for (ToolPose pose = turn(device); pose.apex != there; pose = turn(device))
  {
    ASSERT_NEAR(pose.apex.z(), there.z() + ScriptedDevice::kLift, 1e-12);
    ASSERT_EQ(pose.velocity, Vector3d::Zero());
    ASSERT_LT(++lifted, 30);
  }
  EXPECT_GE(lifted, 20); // a bounce
  EXPECT_EQ(device.reached(), 0.8);
  device.play({ .place = 0.8, .seeks = 1 });
  EXPECT_NEAR(turns(device, 100).apex.x(), there.x() + 100 * 50e-3 * kPeriod, 1e-12);
}

// a step by a key, or a slow drag of the slider
TEST(PlayedDevice, SlidesToThePlaceNextToIt)
{
  ScriptedDevice device(kSlide);
  (void)turns(device, 500);
  device.play({ .plays = false });
  PlayOrder order = soughtTo(0.5);
  for (int step = 0; step < 20; ++step)
  {
    order.place += 0.010;
    ++order.seeks;
    device.play(order);
    const ToolPose pose = turn(device);
    ASSERT_LT((pose.apex - kSlide.poseAt(3.0 + order.place, kDown).apex).norm(), 1e-15);
    ASSERT_EQ(pose.velocity, Vector3d::Zero());
  }
}

TEST(PlayedDevice, LoopsLiftTheToolUnlessThePathIsClosed)
{
  const std::vector<PathKnot> open{ { .time = 0.0, .apex = Vector3d(0.0, 0.0, -2.0_mm) },
    { .time = 0.1, .apex = Vector3d(8.0_mm, 0.0, -2.0_mm) } };
  std::vector<PathKnot> closed = open;
  closed.push_back({ .time = 0.2, .apex = open.front().apex });
  for (const auto& [knots, isClosed] : { std::pair(open, false), std::pair(closed, true) })
  {
    ScriptedDevice device{ ScriptedPath(knots) };
    device.play({ .loops = true });
    int lifts = 0;
    int inTissue = 0;
    bool wasIn = true;
    for (int tick = 0; tick < 2000; ++tick)
    {
      const bool isIn = turn(device).apex.z() < 0.0;
      lifts += wasIn && !isIn ? 1 : 0;
      inTissue += isIn ? 1 : 0;
      wasIn = isIn;
    }
    EXPECT_EQ(lifts, isClosed ? 0 : 2000 / 125) << "100 ms of path and 25 ms in the air";
    EXPECT_NEAR(inTissue, isClosed ? 2000 : 1600, 20);
  }
}

TEST(PlayedDevice, LoopsOfAMillisecondStillComeDown)
{
  ScriptedDevice device{ ScriptedPath({ { .time = 0.0, .apex = Vector3d(0.0, 0.0, -2.0_mm) },
    { .time = 0.001, .apex = Vector3d(8.0_mm, 0.0, -2.0_mm) } }) };
  device.play({ .loops = true, .speed = 4.0 });
  int inTissue = 0;
  for (int tick = 0; tick < 1000; ++tick)
  {
    inTissue += turn(device).apex.z() < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inTissue, 1000 / 30);
}

// what the tool feels there is what one feels that was never elsewhere
TEST(PlayedDevice, TissueThatRelaxesAndRubsIsFreshWhereItIsTaken)
{
  Scene scene;
  scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.05 }, 20)));
  LawSettings law{ .mode = LawMode::Corrected, .friction = 0.4 };
  law.relaxation.add({ 0.5, 50.0_ms });
  scene.law = ForceLaw(SphereTip{ .radius = 10.0_mm }, makeMaterial(20.0_kPa, 0.45), law);
  scene.forceLimit = std::numeric_limits<double>::infinity();

  ScriptedDevice device(kSlide);
  TissueMemory memory;
  for (int tick = 0; tick < 400; ++tick)
  {
    (void)step(scene, memory, turn(device), kPeriod);
  }
  device.play(soughtTo(1.0)); // 30 mm on
  ToolPose pose = turn(device);
  for (; pose.apex.z() > 0.0; pose = turn(device))
  {
    EXPECT_FALSE(step(scene, memory, pose, kPeriod).contact.touching());
  }
  const Sample taken = step(scene, memory, pose, kPeriod);
  TissueMemory none;
  const Sample fresh = step(scene, none, pose, kPeriod);
  EXPECT_GT(fresh.response.force, 1.0);
  EXPECT_NEAR(taken.response.force, fresh.response.force, 1e-9);
  EXPECT_EQ(taken.friction, Vector3d::Zero());
}

TEST(PlayedDevice, AllocatesNothingInItsTurn)
{
  ScriptedDevice device(kSlide);
  PlayOrder order{ .loops = true, .speed = 4.0 };
  for (int turnsTaken = 0; turnsTaken < 100; ++turnsTaken)
  {
    order.place = 0.01 * turnsTaken;
    ++order.seeks;
    device.play(order);
    const test::AllocationGuard guard;
    (void)turns(device, 30);
    EXPECT_EQ(guard.count(), 0U);
  }
}

} // namespace
} // namespace palp
