// From a driver's frame to the scene and back: where the tool is, how it is turned, what a hand
// feels.

#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/devices/made_up_arm.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

TEST(DeviceMapping, TheToolIsTurnedAsTheHandleInTheFrameOfTheScene)
{
  Arm arm;
  const double angle = 20.0_deg;
  arm.says.orientation = AngleAxisd(angle, Vector3d::UnitY()); // its top to the right
  const auto upright = placed(arm);
  const Vector3d down(-std::sin(angle), 0.0, -std::cos(angle));
  EXPECT_LT((exchangeUntilHeard(*upright, arm).axis - down).norm(), 1e-12);

  DevicePlacement quarter;
  quarter.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; // about z: right becomes away
  const auto turned = placed(arm, quarter);
  const Vector3d away(0.0, -std::sin(angle), -std::cos(angle));
  EXPECT_LT((exchangeUntilHeard(*turned, arm).axis - away).norm(), 1e-12);
}

// by work: however the device stands, a torque through the turn of its handle is one through that
// of the tool
TEST(DeviceMapping, ATorqueIsTurnedAsTheTool)
{
  Arm arm;
  DevicePlacement askew;
  askew.rotation = AngleAxisd(0.7, Vector3d(0.48, 0.6, 0.64)).toRotationMatrix();
  const auto device = placed(arm, askew);
  const Vector3d before = exchangeUntilHeard(*device, arm).axis;
  const Vector3d turn = 1e-6 * Vector3d(1.0, -0.4, 0.0); // of the handle, across its axis
  arm.says.orientation = AngleAxisd(turn.norm(), turn.normalized());
  const Vector3d after = exchangeUntilHeard(*device, arm).axis;
  const Vector3d torque(0.02, -0.05, 0.04);
  while (!device->exchange({ Vector3d::UnitX(), torque }, 1.0_ms) || arm.told.isZero())
  {
  }
  EXPECT_NEAR(arm.turned.dot(turn), torque.dot(before.cross(after)), 1e-10);
}

// Eq. (7): of the force, which is along the normal, a tool that is tilted feels its cosine
TEST(DeviceMapping, ATiltOfTheHandleIsFelt)
{
  Scene scene;
  scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 8)));
  double upright = 0.0;
  for (const double tilt : { 0.0_deg, 10.0_deg, 22.0_deg, 35.0_deg })
  {
    Arm arm;
    arm.says.position = Vector3d(0, 0, -3.0_mm);
    arm.says.orientation = AngleAxisd(tilt, Vector3d(0.6, 0.8, 0.0));
    const auto device = placed(arm);
    const Sample sample = step(scene, exchangeUntilHeard(*device, arm));
    EXPECT_NEAR(sample.contact.tilt, tilt, 1e-9);
    upright = tilt == 0.0 ? sample.force.norm() : upright;
    const double along = -sample.force.dot(sample.pose.axis);
    EXPECT_NEAR(along / sample.force.norm(), std::cos(tilt), 1e-9);
    EXPECT_NEAR(sample.force.norm() / sample.contact.normal.dot(sample.force), 1.0, 1e-9);
  }
  EXPECT_GT(upright, 0.1);
}

// 40 rad/s: a tracker that errs for a moment is a turn, no leap
TEST(DeviceMapping, TurnsTheToolNoFasterThanAHand)
{
  Arm arm;
  const auto device = placed(arm);
  auto last = std::chrono::steady_clock::now(); // before the device looks at its own clock
  Vector3d before = exchangeUntilHeard(*device, arm).axis;
  arm.says.orientation = AngleAxisd(150.0_deg, Vector3d::UnitX());
  const Vector3d told = arm.says.orientation * -Vector3d::UnitZ();
  int steps = 0;
  for (; (before - told).norm() > 1e-9 && steps < 100'000'000; ++steps)
  {
    const auto asked = std::chrono::steady_clock::now();
    const Vector3d now = exchangeUntilHeard(*device, arm).axis;
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - last;
    EXPECT_LE(std::acos(std::min(1.0, now.dot(before))), 40.0 * since.count() + 1e-6);
    EXPECT_NEAR(now.norm(), 1.0, 1e-9);
    before = now;
    last = asked;
  }
  EXPECT_GT(steps, 3);
  EXPECT_LT((before - told).norm(), 1e-9);
}

TEST(DeviceMapping, AnOrientationThatIsNoNumberIsNoForce)
{
  Arm arm;
  arm.says.orientation = Quaterniond(std::nan(""), 0, 0, 0);
  const auto device = placed(arm);
  SafetyChain chain(device->limits(), {});
  const auto pose = device->exchange(Vector3d::Zero(), 1.0_ms);
  EXPECT_FALSE(chain.admit(pose, device->status(), { .armed = true }, 1.0_ms));
}

// each driver says how its frame stands to the user; a hand that goes up goes up in the scene
TEST(DeviceMapping, UpIsUpAndRightIsRightWhateverTheDriversFrame)
{
  Arm arm;
  arm.limits.facing = kFacesUser;
  arm.says.position = Vector3d(1.0_mm, 2.0_mm, 3.0_mm); // to the user, right, up
  const auto device = placed(arm);
  const ToolPose pose = exchangeUntilHeard(*device, arm, Vector3d(0.1, 0.2, 0.3));
  EXPECT_LT((pose.apex - Vector3d(2.0_mm, -1.0_mm, 3.0_mm)).norm(), 1e-12);
  EXPECT_LT((arm.told - Vector3d(-0.2, 0.1, 0.3)).norm(), 1e-12);
}

TEST(DeviceMapping, AScaleIsOfTheMotionAndNotOfTheForce)
{
  Arm arm;
  arm.limits = { .model = "made up",
    .rendersForce = true,
    .maxForce = 4.0,
    .damping = 0.6,
    .friction = 0.1,
    .mass = 0.3,
    .handDamping = 0.9,
    .quantum = 10.0_um,
    .workspaceRadius = 40.0_mm,
    .workspaceCenter = Vector3d(1.0_mm, 0, 0) };
  arm.says.position = Vector3d(1.0_mm, -2.0_mm, 3.0_mm);
  const auto device = placed(arm, { .origin = Vector3d(0.1, 0, 0), .scale = 3.0 });
  const ToolPose pose = exchangeUntilHeard(*device, arm, Vector3d(0.1, 0.2, 0.3));
  EXPECT_LT((pose.apex - Vector3d(0.103, -6.0_mm, 9.0_mm)).norm(), 1e-12);
  EXPECT_LT((arm.told - Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);

  // F = m a + b v at the hand, in the tool's a and v: a third of m and b
  const DeviceLimits limits = device->limits();
  EXPECT_NEAR(limits.mass, 0.1, 1e-12);
  EXPECT_NEAR(limits.damping, 0.2, 1e-12);
  EXPECT_NEAR(limits.handDamping, 0.3, 1e-12);
  EXPECT_NEAR(limits.quantum, 30.0_um, 1e-12);
  EXPECT_NEAR(limits.workspaceRadius, 120.0_mm, 1e-12);
  EXPECT_LT((limits.workspaceCenter - Vector3d(0.103, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(limits.friction, 0.1);
  EXPECT_EQ(limits.maxForce, 4.0);
  // what a hand may feel as stiffness stays: a third of it for three times the motion
  const auto same = placed(arm);
  EXPECT_NEAR(SafetyChain(same->limits(), {}).stiffnessLimit(0.0) /
      SafetyChain(limits, {}).stiffnessLimit(0.0),
    3.0, 0.05);
}

TEST(DeviceMapping, AClutchHoldsTheToolOnceTheForceIsGoneAndLetsItGoOnFromThere)
{
  Arm arm;
  const auto device = placed(arm, { .scale = 2.0, .clutch = 2 });
  const auto at = [&](double x, double force)
  {
    arm.says.position = Vector3d(x, 0, 0);
    return exchangeUntilHeard(*device, arm, Vector3d(0, 0, force)).apex.x();
  };
  EXPECT_NEAR(at(1.0_mm, 1.0), 2.0_mm, 1e-12);
  arm.says.buttons = 1;
  EXPECT_NEAR(at(2.0_mm, 1.0), 4.0_mm, 1e-12);
  EXPECT_FALSE(device->status().clutched);
  arm.says.buttons = 2;
  EXPECT_NEAR(at(3.0_mm, 0.5), 6.0_mm, 1e-12); // while there is a force it moves with its tool
  EXPECT_TRUE(device->status().clutched);
  EXPECT_NEAR(at(3.0_mm, 0.0), 6.0_mm, 1e-12);
  EXPECT_NEAR(at(-50.0_mm, 0.0), 6.0_mm, 1e-12);
  EXPECT_EQ(exchangeUntilHeard(*device, arm).velocity, Vector3d::Zero());
  arm.says.buttons = 0;
  EXPECT_NEAR(at(-50.0_mm, 0.0), 6.0_mm, 1e-12);
  EXPECT_FALSE(device->status().clutched);
  EXPECT_NEAR(at(-49.0_mm, 0.0), 8.0_mm, 1e-12);
  EXPECT_NEAR(device->status().moved.x(), 106.0_mm, 1e-12);
}

TEST(DeviceMapping, ADeviceWithoutForceIsHeldAtOnce)
{
  Arm arm;
  arm.limits.rendersForce = false;
  const auto device = placed(arm, { .clutch = 1 });
  (void)exchangeUntilHeard(*device, arm);
  arm.says.buttons = 1;
  arm.says.position = Vector3d(0.01, 0, 0);
  EXPECT_EQ(exchangeUntilHeard(*device, arm, Vector3d(0, 0, 1.0)).apex, Vector3d::Zero());
}

TEST(DeviceMapping, IsPutElsewhereWithoutBeingOpenedAnew)
{
  Arm arm;
  arm.says.position = Vector3d(1.0_mm, 2.0_mm, 3.0_mm);
  const auto device = placed(arm, { .clutch = 1 });
  arm.says.buttons = 1;
  (void)exchangeUntilHeard(*device, arm);
  arm.says.position.x() = 7.0_mm;
  (void)exchangeUntilHeard(*device, arm);
  arm.says.buttons = 0;
  (void)exchangeUntilHeard(*device, arm);
  // as seen from below: right stays, away is up, up is to where one looks from
  DevicePlacement below{ .origin = Vector3d(0, 0, -0.2), .scale = 2.0, .clutch = 1 };
  below.rotation.col(0) = Vector3d::UnitX();
  below.rotation.col(1) = Vector3d::UnitZ();
  below.rotation.col(2) = -Vector3d::UnitY();
  EXPECT_TRUE(device->place(below));
  EXPECT_EQ(device->status().moved, Vector3d::Zero());
  const ToolPose pose = exchangeUntilHeard(*device, arm, Vector3d(0.5, 0, 0.1));
  EXPECT_LT((pose.apex - Vector3d(14.0_mm, -6.0_mm, -196.0_mm)).norm(), 1e-12);
  EXPECT_LT((pose.axis - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((arm.told - Vector3d(0.5, 0.1, 0.0)).norm(), 1e-12);
}

} // namespace
} // namespace palp
