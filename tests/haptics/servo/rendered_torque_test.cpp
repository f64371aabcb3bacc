// What of a torque goes through the safety chain to a wrist.

#include "haptics/servo/servo_step.h"
#include "tests/haptics/servo/turned_world.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::kDown;
using test::slab;
using test::worldOf;

// A tilted ball in a block, through the chain of a wrist with motors.
class RenderedTorque : public testing::Test
{
protected:
  static DeviceLimits wrist()
  {
    return { .model = "wrist",
      .rendersForce = true,
      .maxForce = 12.0,
      .maxTorque = 0.2,
      .maxAngularStiffness = 0.25,
      .damping = 2.0 };
  }

  void use(const DeviceLimits& limits, double radius = 10.0_mm)
  {
    chain_.emplace(limits);
    scene_ = worldOf(slab(), SphereTip{ radius }, LawMode::Exact);
    radius_ = radius;
    depth_ = -5.0_mm;
  }

  Sample goTo(double depth, int rest = 0)
  {
    Sample sample;
    do
    {
      depth_ += std::clamp(depth - depth_, -0.1_mm, 0.1_mm);
      const Vector3d apex = (radius_ - depth_) * Vector3d::UnitZ() + radius_ * axis_;
      sample = step(scene_, memory_, *chain_, ToolPose{ apex, axis_ }, {}, orders_, 1.0_ms);
    } while (depth_ != depth || rest-- > 0);
    return sample;
  }

  std::optional<SafetyChain> chain_;
  Scene scene_;
  TissueMemory memory_;
  SafetyOrders orders_;
  Vector3d axis_ = AngleAxisd(30.0_deg, Vector3d::UnitY()) * kDown;
  double radius_ = 0.0;
  double depth_ = 0.0;
};

TEST_F(RenderedTorque, ComesAndGoesWithTheForce)
{
  use(wrist());
  EXPECT_TRUE(goTo(2.0_mm).torque.isZero(0.0)) << "disarmed";
  goTo(-5.0_mm);
  orders_.armed = true;
  goTo(-5.0_mm, 600);
  const Sample pressed = goTo(2.0_mm, 200);
  ASSERT_EQ(pressed.state, DeviceState::Active);
  const Vector3d statics = (-radius_ * axis_).cross(pressed.force);
  EXPECT_GT(statics.norm(), 1e-3);
  EXPECT_LT((pressed.torque - statics).norm(), 0.01 * statics.norm());
  orders_.armed = false;
  double before = pressed.torque.norm();
  for (int i = 0; i < 150; ++i)
  {
    const Sample sample = goTo(2.0_mm);
    EXPECT_LE(sample.torque.norm(), before + 1e-12);
    before = sample.torque.norm();
  }
  EXPECT_EQ(before, 0.0);
}

TEST_F(RenderedTorque, IsNoneOfAnArmWhoseWristHasNoMotors)
{
  DeviceLimits limits = wrist();
  limits.maxTorque = 0.0;
  use(limits);
  orders_.armed = true;
  goTo(-5.0_mm, 600);
  const Sample pressed = goTo(2.0_mm, 200);
  EXPECT_GT(pressed.force.norm(), 0.1);
  EXPECT_TRUE(pressed.torque.isZero(0.0));
}

// a turn that is as stiff as its ball is large would swing the wrist
TEST_F(RenderedTorque, IsNoLargerAndNoStifferThanTheWristBears)
{
  use(wrist(), 60.0_mm);
  orders_.armed = true;
  goTo(-5.0_mm, 600);
  const Vector3d upright = axis_;
  const Sample pressed = goTo(6.0_mm, 300);
  const auto statics = [&](const Sample& sample)
  { return Vector3d((-radius_ * axis_).cross(sample.force)); };
  EXPECT_LT((pressed.torque - statics(pressed)).norm(), 0.01 * pressed.torque.norm());
  axis_ = AngleAxisd(1e-4, Vector3d::UnitY()) * upright;
  const Sample turned = goTo(6.0_mm, 300);
  EXPECT_LE((turned.torque - pressed.torque).norm(), 1e-4 * wrist().maxAngularStiffness * 1.01);
  EXPECT_GT(pressed.torque.norm(), 0.005);

  DeviceLimits weak = wrist();
  weak.maxTorque = 0.004;
  use(weak);
  goTo(-5.0_mm, 600);
  const Sample bounded = goTo(4.0_mm, 300); // its force is, too
  EXPECT_LE(bounded.torque.norm(), 0.004);
  EXPECT_GT(bounded.torque.norm(), 0.001);
  EXPECT_LT((bounded.torque - statics(bounded)).norm(), 0.01 * bounded.torque.norm());
}

// what of the torque is not rendered would come out of the force as the tool leans, also where a
// wrist has no motors at all
TEST_F(RenderedTorque, LeaningGivesNothing)
{
  DeviceLimits grip = wrist();
  grip.maxTorque = 0.0;
  for (const auto& [device, radius] :
    { std::pair{ wrist(), 10.0_mm }, std::pair{ wrist(), 20.0_mm }, std::pair{ wrist(), 30.0_mm },
      std::pair{ grip, 10.0_mm }, std::pair{ grip, 30.0_mm } })
  {
    use(device, radius);
    scene_.law =
      ForceLaw(SphereTip{ radius }, makeMaterial(50.0_kPa, 0.33), { .mode = LawMode::Exact });
    scene_.forceLimit = 4.0;
    orders_.armed = true;
    double work = 0.0; // of the hand
    double most = 0.0;
    std::optional<Sample> before;
    const auto go = [&](double height, double lean)
    {
      const Vector3d axis = AngleAxisd(lean, Vector3d::UnitY()) * kDown;
      const Vector3d apex = height * Vector3d::UnitZ();
      const Sample now =
        step(scene_, memory_, *chain_, ToolPose{ apex, axis }, {}, orders_, 1.0_ms);
      if (before)
      {
        work -= 0.5 * (before->force + now.force).dot(apex - before->pose.apex);
        work -= 0.5 * (before->torque + now.torque).dot(before->pose.axis.cross(axis));
        most = std::max(most, work);
      }
      before = now;
    };
    const auto way = [&](double from, double to, double lean, double leanTo)
    {
      for (int i = 0; i <= 2000; ++i)
      {
        go(from + (to - from) * i / 2000.0, lean + (leanTo - lean) * i / 2000.0);
      }
    };
    way(10.0_mm, 10.0_mm, 0.0, 0.0); // until it is armed
    way(10.0_mm, -5.0_mm, 0.0, 0.0);
    way(-5.0_mm, -5.0_mm, 0.0, 30.0_deg);
    way(-5.0_mm, 12.0_mm, 30.0_deg, 30.0_deg);
    EXPECT_GT(most, 1e-3) << radius;
    EXPECT_GT(work, -0.01 * most) << radius;
    // in a lean, deeper as it stands up, out
    way(12.0_mm, -2.0_mm, 30.0_deg, 30.0_deg);
    way(-2.0_mm, -5.0_mm, 30.0_deg, 0.0);
    way(-5.0_mm, -5.0_mm, 0.0, 30.0_deg);
    way(-5.0_mm, 12.0_mm, 30.0_deg, 0.0);
    EXPECT_GT(work, -0.01 * most) << radius;
  }
}

// a lean takes no force away for good, and what is pushed along is felt
TEST_F(RenderedTorque, OfAGripWithoutMotorsComesBackAsItStandsUp)
{
  DeviceLimits grip = wrist();
  grip.maxTorque = 0.0;
  use(grip);
  orders_.armed = true;
  axis_ = kDown;
  goTo(-5.0_mm, 600);
  const double upright = goTo(2.0_mm, 300).force.norm();
  const auto leanTo = [&](double from, double to)
  {
    Sample sample;
    for (int i = 1; i <= 500; ++i)
    {
      axis_ = AngleAxisd(from + (to - from) * i / 500.0, Vector3d::UnitY()) * kDown;
      // the apex stays
      sample = step(scene_, memory_, *chain_, ToolPose{ -2.0_mm * Vector3d::UnitZ(), axis_ }, {},
        orders_, 1.0_ms);
    }
    return sample;
  };
  const Sample leaning = leanTo(0.0, 30.0_deg);
  EXPECT_GT(leaning.contact.depth, 3.0_mm);
  EXPECT_NEAR(leaning.force.norm(), upright, 0.02 * upright);
  EXPECT_NEAR(leanTo(30.0_deg, 0.0).force.norm(), upright, 0.02 * upright);
}

TEST_F(RenderedTorque, CostsNoMemoryAndNeverIsNotANumber)
{
  use(wrist());
  orders_.armed = true;
  goTo(-5.0_mm, 600);
  const test::AllocationGuard guard;
  EXPECT_TRUE(goTo(3.0_mm, 100).torque.allFinite());
  axis_ = Vector3d(0.0, std::nan(""), -1.0);
  const Sample lost = goTo(3.0_mm);
  EXPECT_TRUE(lost.torque.isZero(0.0) || lost.torque.allFinite());
  EXPECT_EQ(guard.count(), 0);
}

} // namespace
} // namespace palp
