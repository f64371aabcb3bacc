// A clutch at the safety chain.

#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/servo/tissue_memory.h"
#include "haptics/units.h"
#include "tests/haptics/devices/made_up_arm.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <optional>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

// a session of a hand that presses, clutches, goes 60 mm elsewhere and presses on
class ClutchedServo : public ::testing::Test
{
protected:
  ClutchedServo()
  {
    arm_.limits = { .model = "made up",
      .rendersForce = true,
      .maxForce = 4.0,
      .damping = 1.0,
      .handDamping = 2.0,
      .quantum = 10.0_um,
      .workspaceRadius = 40.0_mm };
    scene_.surface =
      std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 8)));
    device_ = placed(arm_, { .origin = Vector3d(0, 0, 10.0_mm), .clutch = 1 });
    chain_.emplace(device_->limits(), SafetySettings{});
  }

  // moves the hand in steps of at most 20 um, a tick each, and ticks on
  void go(const Vector3d& to, int ticks = 0)
  {
    while ((to - arm_.says.position).norm() > 1e-9 || ticks-- > 0)
    {
      const Vector3d way = to - arm_.says.position;
      arm_.says.position += way * std::min(1.0, 20.0_um / std::max(1e-12, way.norm()));
      // in the time of these ticks, however busy the machine is
      const int before = arm_.ticks;
      std::optional<ToolPose> pose;
      while (arm_.ticks == before)
      {
        pose = device_->exchange(last_.force, 1.0_ms);
      }
      pose->velocity = (pose->apex - last_.pose.apex) / 1.0_ms;
      DeviceStatus status = device_->status();
      status.age = 0.0;
      status.delay = 0.0;
      status.sent.reset();
      const Sample next =
        step(scene_, memory_, *chain_, pose, status, { .armed = true }, 1.0_ms, last_.pose);
      leap_ = std::max(leap_, (next.force - last_.force).norm());
      way_ = std::max(way_, (next.pose.apex - last_.pose.apex).norm());
      flags_ |= next.flags;
      last_ = next;
    }
  }
  [[nodiscard]] bool raised(Flag flag) const
  {
    return (flags_ & static_cast<std::uint32_t>(flag)) != 0;
  }

  Arm arm_;
  Scene scene_;
  TissueMemory memory_;
  std::unique_ptr<BusDevice> device_;
  std::optional<SafetyChain> chain_;
  Sample last_;
  std::uint32_t flags_ = 0;
  double leap_ = 0.0; // [N] largest in a tick
  double way_ = 0.0;  // [m] likewise
};

TEST_F(ClutchedServo, HasNoForceWhileItIsHeldAndNoJumpAfterwards)
{
  go(Vector3d::Zero(), 700); // armed, and its soft start over
  way_ = 0.0;
  go(Vector3d(0, 0, -13.0_mm), 200); // 3 mm deep
  const double pressed = last_.force.norm();
  EXPECT_GT(pressed, 0.3);
  arm_.says.buttons = 1;
  const Vector3d held = last_.pose.apex;
  leap_ = 0.0;
  go(arm_.says.position, 150); // of which a decay takes 100
  EXPECT_EQ(last_.force.norm(), 0.0);
  EXPECT_LT(leap_, 1.5 * pressed / 100.0); // a ramp, no cut
  EXPECT_TRUE(raised(Flag::Clutched));
  flags_ = 0;
  double most = 0.0;
  for (int i = 1; i <= 60; ++i) // elsewhere: to where the tool, moved along, would be out of reach
  {
    go(Vector3d(i * 0.5_mm, 0, -13.0_mm));
    most = std::max(most, last_.force.norm());
  }
  EXPECT_EQ(most, 0.0);
  EXPECT_LT((last_.pose.apex - held).norm(), 1e-12);

  arm_.says.buttons = 0;
  leap_ = 0.0;
  flags_ = 0;
  go(arm_.says.position, 1);
  EXPECT_EQ(last_.force.norm(), 0.0) << "it begins from nothing, deep in the tissue";
  go(arm_.says.position, 800);
  EXPECT_LT(last_.force.norm(), 0.01) << "felt from where it was let go until it has lifted";
  EXPECT_LT((last_.pose.apex - held).norm(), 1e-9);
  EXPECT_LE(leap_, 0.05 + 1e-9);           // of a soft start, by the tick
  go(Vector3d(30.0_mm, 0, -8.0_mm), 100);  // up, 5 mm
  go(Vector3d(30.0_mm, 0, -13.0_mm), 200); // and as deep as before
  EXPECT_NEAR(last_.force.norm(), pressed, 0.05 * pressed);
  EXPECT_LE(way_, 21.0_um);
  EXPECT_FALSE(raised(Flag::Jump));
}

TEST_F(ClutchedServo, TheEndOfItsReachGoesWithIt)
{
  go(Vector3d::Zero(), 700);
  go(Vector3d(30.0_mm, 0, 10.0_mm));
  arm_.says.buttons = 1;
  go(Vector3d(-30.0_mm, 0, 10.0_mm), 150);
  arm_.says.buttons = 0;
  go(Vector3d(-30.0_mm, 0, 10.0_mm), 700);
  go(Vector3d(0, 0, 10.0_mm)); // 60 mm from where the device stood: the middle of its reach now
  EXPECT_FALSE(raised(Flag::Workspace));
  EXPECT_NEAR(last_.pose.apex.x(), 60.0_mm, 1e-9);
  flags_ = 0;
  go(Vector3d(45.0_mm, 0, 10.0_mm), 50);
  EXPECT_TRUE(raised(Flag::Workspace));
  EXPECT_LT(last_.force.x(), -0.1);
}

// a key of the program's takes the place of a button
TEST(HeldTool, OfATrackerWithoutButtonsStaysUntilItIsLetGoOrPlaced)
{
  Arm arm;
  arm.limits = { .model = "tracker" };
  const auto device = placed(arm, { .clutch = 2 });
  const auto apexAt = [&](double x)
  {
    arm.says.position = Vector3d(x, 0, 0);
    std::optional<ToolPose> pose;
    for (const int before = arm.ticks; arm.ticks == before;)
    {
      pose = device->exchange(Vector3d::Zero(), 1.0_ms);
    }
    return pose->apex.x();
  };
  EXPECT_NEAR(apexAt(10.0_mm), 10.0_mm, 1e-12);
  device->hold(true);
  EXPECT_NEAR(apexAt(40.0_mm), 10.0_mm, 1e-12);
  EXPECT_TRUE(device->status().clutched);
  device->hold(false);
  EXPECT_NEAR(apexAt(45.0_mm), 15.0_mm, 1e-12);
  EXPECT_FALSE(device->status().clutched);
  device->hold(true);
  EXPECT_TRUE(device->place({ .origin = Vector3d(0.1, 0, 0) }));
  EXPECT_NEAR(apexAt(20.0_mm), 0.1 + 20.0_mm, 1e-12);
}

} // namespace
} // namespace palp
