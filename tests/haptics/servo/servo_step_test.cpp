#include "haptics/servo/servo_step.h"

#include "haptics/contact/embed_nodules.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

namespace palp
{
namespace
{

using namespace units::literals;

Scene scene()
{
  Scene world;
  world.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 20)));
  world.law = ForceLaw(SphereTip{ .radius = 10.0_mm }, makeMaterial(50.0_kPa, 0.33));
  world.forceLimit = 4.0;
  return world;
}

ToolPose atHeight(double z, double speed = 0.0)
{
  return {
    .apex = { 0.0, 0.0, z }, .axis = -Eigen::Vector3d::UnitZ(), .velocity = { 0.0, 0.0, speed }
  };
}

// Hertz, in terms of E* = E / (1 - nu^2)
TEST(ServoStep, PressesBackWithTheForceOfHertz)
{
  const Sample sample = step(scene(), atHeight(-2.0_mm));
  const double hertz =
    4.0 / 3.0 * 50.0_kPa / (1.0 - 0.33 * 0.33) * std::sqrt(10.0_mm) * std::pow(2.0_mm, 1.5);
  EXPECT_NEAR(sample.force.z(), hertz, 1e-9 * hertz);
  EXPECT_NEAR(sample.force.head<2>().norm(), 0.0, 1e-12);
  EXPECT_EQ(sample.flags, 0U);
}

TEST(ServoStep, NeverPulls)
{
  Scene world = scene();
  world.damping = 5.0;
  const Sample slow = step(world, atHeight(-2.0_mm, 0.01));
  EXPECT_NEAR(slow.response.force - slow.force.z(), 0.05, 1e-12);
  EXPECT_EQ(step(world, atHeight(-2.0_mm, 10.0)).force, Eigen::Vector3d::Zero());
}

// where it pushes the tool aside, also by a part against the normal
TEST(ServoStep, NeverPullsBesideAnEdge)
{
  Scene world = scene();
  world.law = ForceLaw(world.law.tip(), world.law.material(), { .mode = LawMode::Corrected });
  world.damping = 5.0;
  double least = 0.0; // of that part
  for (double x = 40.0_mm; x < 55.0_mm; x += 0.5_mm)
  {
    ToolPose pose = atHeight(-2.0_mm);
    pose.apex.x() = x;
    const Eigen::Vector3d outward = step(world, pose).contact.normal;
    pose.velocity = 10.0 * outward;
    const Sample sample = step(world, pose);
    least = std::min(least, sample.lateral.dot(outward));
    EXPECT_GE(sample.force.dot(outward), -1e-12) << x;
  }
  EXPECT_LT(least, -1e-5);
}

TEST(ServoStep, IsNeverStrongerThanTheLimit)
{
  Scene world = scene();
  world.damping = 100.0;
  const Sample sample = step(world, atHeight(-9.0_mm, -5.0));
  EXPECT_NEAR(sample.force.norm(), world.forceLimit, 1e-12);
  EXPECT_TRUE(sample.flags & static_cast<std::uint32_t>(Flag::Limited));
}

TEST(ServoStep, WhatIsNotFiniteGivesNoForce)
{
  Scene world = scene();
  const double damping = world.damping;
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    world.damping = damping;
    for (int where = 0; where < 9; ++where)
    {
      ToolPose pose = atHeight(-2.0_mm);
      Eigen::Vector3d* parts[] = { &pose.apex, &pose.axis, &pose.velocity };
      (*parts[where / 3])[where % 3] = bad;
      const Sample sample = step(world, pose);
      EXPECT_EQ(sample.force, Eigen::Vector3d::Zero());
      EXPECT_TRUE(sample.flags & static_cast<std::uint32_t>(Flag::NotFinite));
    }
    world.damping = bad;
    const Sample sample = step(world, atHeight(-2.0_mm, -0.1));
    EXPECT_EQ(sample.force, Eigen::Vector3d::Zero()) << bad;
    EXPECT_TRUE(sample.flags & static_cast<std::uint32_t>(Flag::NotFinite)) << bad;
  }
}

// whose thickness is not known: under the laws, over a nodule and where it gives way
TEST(ServoStep, AnOpenSheetPushesAsABodyWithoutEnd)
{
  Scene world = scene();
  world.surface = std::make_shared<const Surface>(test::makeSurface(test::sheet(0.1, 21)));
  const double flat = step(world, atHeight(-2.0_mm)).force.z();
  ASSERT_GT(flat, 0.1);
  world.law = ForceLaw(world.law.tip(), world.law.material(),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  const Sample corrected = step(world, atHeight(-2.0_mm));
  EXPECT_NEAR(corrected.force.z(), flat, 0.03 * flat); // a ball is no paraboloid
  EXPECT_NEAR(corrected.force.head<2>().norm(), 0.0, 1e-6);

  Scene soft = world;
  const PlacedNodule nodule{ { 3.0_mm, 0.0, -8.0_mm }, 4.0_mm, 5.0 };
  soft.nodules = embedNodules(*world.surface, world.law, std::array{ nodule });
  const Sample beside = step(soft, atHeight(-2.0_mm));
  EXPECT_GT(beside.force.z(), 1.01 * flat);
  EXPECT_LT(beside.force.x(), -1e-4); // away from what is stiff

  Scene yielding = world;
  const std::array place{ PlacedCompliance{ .constant = 50.0, .slope = { 0.0, 200.0, 0.0 } } };
  yielding.series =
    seriesBodyOf(std::make_shared<const ComplianceField>(place, 50.0_mm, 0.33), world.law);
  const Sample given = step(yielding, atHeight(-2.0_mm));
  EXPECT_LT(given.force.z(), 0.9 * flat);
  EXPECT_GT(given.force.y(), 1e-4); // toward what is soft
  for (const Sample& sample : { corrected, beside, given })
  {
    EXPECT_EQ(sample.flags, 0U);
    EXPECT_TRUE(sample.force.allFinite());
  }
}

TEST(ServoStep, ALimitThatIsNoneGivesNoForce)
{
  Scene world = scene();
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(), -1.0 })
  {
    world.forceLimit = bad;
    const Sample sample = step(world, atHeight(-2.0_mm));
    EXPECT_EQ(sample.force, Eigen::Vector3d::Zero()) << bad;
    EXPECT_TRUE(sample.flags & static_cast<std::uint32_t>(Flag::NotFinite)) << bad;
  }
  world.forceLimit = std::numeric_limits<double>::infinity(); // bounds nothing
  EXPECT_EQ(step(world, atHeight(-2.0_mm)).force, step(scene(), atHeight(-2.0_mm)).force);
}

TEST(ServoStep, AnEmptySceneCannotBeTouched)
{
  const Sample sample = step(Scene{}, atHeight(-2.0_mm));
  EXPECT_EQ(sample.force, Eigen::Vector3d::Zero());
  EXPECT_FALSE(sample.contact.touching());
}

TEST(ServoStep, DoesNotAllocate)
{
  Scene world = scene();
  for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
  {
    world.rule = rule;
    const test::AllocationGuard guard;
    EXPECT_TRUE(step(world, atHeight(-2.0_mm)).contact.touching());
    EXPECT_EQ(guard.count(), 0U);
  }
  const test::AllocationGuard guard;
  const std::vector<int> memory(1);
  EXPECT_EQ(guard.count(), memory.size()); // the guard does count
}

} // namespace
} // namespace palp
