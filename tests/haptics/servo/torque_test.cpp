// What a tool that turns feels: by the statics of a ball, and by the work of whole motions.

#include "haptics/servo/torque.h"

#include "haptics/servo/safety.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

const Vector3d kDown = -Vector3d::UnitZ();

Scene worldOf(test::Mesh mesh, const Tip& tip, LawMode mode)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(test::makeSurface(std::move(mesh)));
  scene.law = ForceLaw(tip, makeMaterial(20.0_kPa, 0.45), { .mode = mode });
  scene.forceLimit = 1e3;
  return scene;
}

test::Mesh ellipsoid()
{
  test::Mesh mesh = test::ball(1.0, 60);
  for (Vector3d& point : mesh.first)
  {
    point = point.cwiseProduct(Vector3d(50.0_mm, 35.0_mm, 25.0_mm));
  }
  return mesh;
}

// with its top at z = 0
test::Mesh slab()
{
  return test::block({ 0.1, 0.1, 0.04 }, 30);
}

double topOf(const Scene& scene)
{
  const auto& points = scene.surface->points();
  return std::ranges::max_element(points, {}, [](const Vector3d& at) { return at.z(); })->z();
}

Wrench wrenchAt(const Scene& scene, const ToolPose& pose)
{
  const Sample sample = step(scene, pose);
  return sample.contact.touching()
    ? Wrench{ sample.force, torqueAt(scene, sample, TissueAt(scene, sample.contact)) }
    : Wrench{};
}

// of a rigid tool that is pushed where its ball has its middle, whatever the body and the lean
TEST(Torque, OfABallIsThatOfItsForceAtItsMiddle)
{
  constexpr double kRadius = 8.0_mm;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const LawMode mode : { LawMode::Paper, LawMode::Exact, LawMode::Corrected })
  {
    for (const auto& mesh : { ellipsoid(), slab() })
    {
      const Scene scene = worldOf(mesh, SphereTip{ kRadius }, mode);
      const double top = topOf(scene);
      double most = 0.0;
      for (int i = 0; i < 40; ++i)
      {
        const Vector3d about(any(random), any(random), 0.0);
        const Vector3d axis = AngleAxisd(0.6 * any(random), about.normalized()) * kDown;
        const Vector3d middle(15.0_mm * any(random), 15.0_mm * any(random), top + 3.0_mm);
        const Wrench felt = wrenchAt(scene, { middle + kRadius * axis, axis });
        const Vector3d statics = (-kRadius * axis).cross(felt.force);
        // what a corrected law pushes aside is the slope of its energy to 3 %
        const double exactly = mode == LawMode::Corrected ? 5e-3 : 1e-4;
        EXPECT_LT((felt.torque - statics).norm(), exactly * kRadius * felt.force.norm()) << i;
        most = std::max(most, statics.norm());
      }
      EXPECT_GT(most, 1e-3); // of 8 mm by newtons
    }
  }
}

// A pose on a way from 0 to 1.
using Way = std::function<ToolPose(double)>;

struct Work
{
  double all = 0.0;      // that a hand brings in [J]
  double byForces = 0.0; // of it, without the turns
  double most = 0.0;     // that was in it on the way
};

void follow(Work& work, const Scene& scene, const Way& way, int steps)
{
  for (int i = 0; i < steps; ++i)
  {
    const ToolPose from = way(static_cast<double>(i) / steps);
    const ToolPose to = way((i + 1.0) / steps);
    const Wrench felt = wrenchAt(scene, way((i + 0.5) / steps));
    const double pushed = -felt.force.dot(to.apex - from.apex);
    work.byForces += pushed;
    work.all += pushed - felt.torque.dot(from.axis.cross(to.axis));
    work.most = std::max(work.most, work.all);
  }
}

struct Turned
{
  const char* name;
  Tip tip;
};

class TurnedTool : public testing::TestWithParam<Turned>
{
};

// pressed upright, leaned by 20 degrees in the tissue, slid, lifted as it leans
TEST_P(TurnedTool, GainsNoEnergy)
{
  constexpr double kLean = 20.0_deg;
  const Vector3d about = Vector3d(0.8, 0.6, 0.0);
  double unturned = 0.0; // what the forces alone would gain
  for (const LawMode mode : { LawMode::Exact, LawMode::Corrected })
  {
    for (const auto& mesh : { ellipsoid(), slab() })
    {
      const Scene scene = worldOf(mesh, GetParam().tip, mode);
      const double top = topOf(scene);
      const auto at = [&](double x, double height, double lean) {
        return ToolPose{ Vector3d(x, 1.0_mm, top + height), AngleAxisd(lean, about) * kDown };
      };
      Work work;
      follow(
        work, scene, [&](double t) { return at(0.0, 8.0_mm - 11.0_mm * t, 0.0); }, 400);
      follow(
        work, scene, [&](double t) { return at(0.0, -3.0_mm, kLean * t); }, 300);
      follow(
        work, scene, [&](double t) { return at(4.0_mm * t, -3.0_mm, kLean); }, 300);
      follow(
        work, scene, [&](double t) { return at(4.0_mm, -3.0_mm + 23.0_mm * t, kLean); }, 600);
      EXPECT_LT(std::abs(work.all), 1e-3 * work.most);
      unturned = std::max(unturned, std::abs(work.byForces) / work.most);
    }
  }
  EXPECT_GT(unturned, 0.1) << "turns nothing"; // an exact cone in a plane does not
}

INSTANTIATE_TEST_SUITE_P(Tools, TurnedTool,
  testing::Values(Turned{ "Ball", SphereTip{ 10.0_mm } },
    Turned{ "Cone", ConeTip{ 60.0_deg, 15.0_mm } },
    Turned{ "Paraboloid", ParaboloidTip{ 10.0_mm } }, Turned{ "Punch", PunchTip{ 4.0_mm } },
    Turned{ "TruncatedCone", TruncatedConeTip{ 60.0_deg, 4.0_mm, 20.0_mm } }),
  [](const auto& tool) { return std::string(tool.param.name); });

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
      .maxTurning = 0.25,
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
  EXPECT_LE((turned.torque - pressed.torque).norm(), 1e-4 * wrist().maxTurning * 1.01);
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

// what of the torque is not rendered would come out of the force as the tool leans
TEST_F(RenderedTorque, LeaningALargeToolGivesNothing)
{
  for (const double radius : { 10.0_mm, 20.0_mm, 30.0_mm })
  {
    use(wrist(), radius);
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
    way(-5.0_mm, 10.0_mm, 30.0_deg, 30.0_deg);
    EXPECT_GT(most, 1e-3) << radius;
    EXPECT_GT(work, -0.01 * most) << radius;
  }
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
