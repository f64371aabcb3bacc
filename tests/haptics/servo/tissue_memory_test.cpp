#include "haptics/servo/tissue_memory.h"

#include "haptics/contact/embed_nodules.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/force/relaxation/press_history.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kTick = 1.0_ms;

LawSettings settings(std::vector<PronyTerm> terms, double friction)
{
  LawSettings result{ .mode = LawMode::Corrected, .friction = friction };
  for (const PronyTerm& term : terms)
  {
    result.relaxation.add(term);
  }
  return result;
}

// a block pressed by a ball of 10 mm
struct Rig
{
  explicit Rig(const LawSettings& law)
  {
    scene.surface =
      std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 20)));
    scene.law = ForceLaw(SphereTip{ .radius = 10.0_mm }, makeMaterial(20.0_kPa, 0.45), law);
    scene.forceLimit = std::numeric_limits<double>::infinity();
  }

  Sample at(const Vector3d& apex, double dt = kTick)
  {
    ToolPose pose{ .apex = apex, .axis = -Vector3d::UnitZ(), .velocity = (apex - last) / kTick };
    last = apex;
    return step(scene, memory, pose, dt);
  }
  Sample press(double depth, double x = 0.0)
  {
    return at({ x, 0.0, -depth });
  }

  Scene scene;
  TissueMemory memory{};
  Vector3d last = Vector3d::Zero();
};

const std::vector<PronyTerm> kTerms{ { 0.3, 50.0_ms }, { 0.2, 0.6 } };

TEST(TissueMemory, WithoutOneAStepIsTheSameToTheLastBit)
{
  Rig rig(settings({}, 0.0));
  for (const double depth : { -1.0_mm, 2.0_mm, 5.0_mm, 3.0_mm })
  {
    const Sample with = rig.press(depth, 1.0_mm);
    const Sample without = step(rig.scene, with.pose);
    EXPECT_EQ(with.force, without.force);
    EXPECT_EQ(with.response.force, without.response.force);
    EXPECT_EQ(with.response.contactRadius, without.response.contactRadius);
    EXPECT_EQ(with.friction, Vector3d::Zero());
  }
}

// the rows of the law of this place, instead of those of a half-space that are adapted to it
void expectTheLawOfThePlace(const Scene& scene, double deepest, double loading, double unloading)
{
  Rig rig(settings(kTerms, 0.0));
  rig.scene = scene;
  const Contact contact = rig.press(deepest).contact;
  const ContactRows rows(
    [&](double depth)
    {
      const Response at = evaluateLaw(scene, contact, depth);
      return ElasticForce{ at.force, at.stiffness };
    },
    deepest);
  Rig fresh(settings(kTerms, 0.0));
  fresh.scene = scene;
  std::vector<PressPoint> history;
  std::vector<double> forces;
  for (int i = 0; i <= 500; ++i)
  {
    const double depth = deepest * (i < 250 ? i / 250.0 : (500 - i) / 250.0);
    history.push_back({ kTick * i, depth });
    forces.push_back(fresh.press(depth).response.force);
  }
  const std::vector<double> known = forcesOver(rows, scene.law.settings().relaxation, history);
  const double most = *std::ranges::max_element(known);
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    ASSERT_NEAR(forces[i], known[i], (i <= 250 ? loading : unloading) * most)
      << deepest << ' ' << i;
  }
}

TEST(TissueMemory, RelaxesAsTheLawOfThePlace)
{
  test::Sampled samples(5);
  for (const double deepest : { 1.0_mm, 4.0_mm, 8.0_mm })
  {
    Scene scene = Rig(settings(kTerms, 0.0)).scene;
    if (samples.takes())
    {
      expectTheLawOfThePlace(scene, deepest, 2e-4, 1e-3);
    }
    for (const double ratio : { 0.3, 5.0 })
    {
      if (!samples.takes())
      {
        continue;
      }
      const PlacedNodule nodule{ { 2.0_mm, 0.0, -9.0_mm }, 5.0_mm, ratio };
      scene.nodules = embedNodules(*scene.surface, scene.law, std::array{ nodule });
      expectTheLawOfThePlace(scene, deepest, 5e-4, 1e-3);
    }
    if (!samples.takes())
    {
      continue;
    }
    scene.nodules = nullptr;
    scene.stiffness = embedStiffness(*scene.surface, scene.law,
      [](const Vector3d& x) { return x.z() > -3.0_mm ? 40.0_kPa : 15.0_kPa; });
    expectTheLawOfThePlace(scene, deepest, 1e-3, 1.5e-3);
  }
}

TEST(TissueMemory, FrictionIsPartOfTheForceAndCoulombsWhereAllSlips)
{
  Rig rough(settings({}, 0.4));
  Rig smooth(settings({}, 0.0));
  for (int i = 0; i < 40; ++i)
  {
    const Sample sample = rough.press(3.0_mm, 0.5_mm * i);
    const Sample plain = smooth.press(3.0_mm, 0.5_mm * i);
    EXPECT_EQ(sample.response.force, plain.response.force) << "friction changes nothing of it";
    if (i > 20)
    {
      const double coulomb = 0.4 * plain.response.force;
      EXPECT_NEAR(sample.friction.norm(), coulomb, 1e-3 * coulomb) << i;
      EXPECT_LT(sample.friction.x(), -0.99 * coulomb) << "against the motion";
      EXPECT_LT((sample.force - plain.force - sample.friction).norm(), 1e-9);
    }
  }
}

TEST(TissueMemory, TheLimitBoundsBothTogether)
{
  Rig rig(settings({}, 0.8));
  rig.scene.forceLimit = 0.5;
  (void)rig.press(5.0_mm);
  const Sample sample = rig.press(5.0_mm, 5.0_mm);
  EXPECT_NEAR(sample.force.norm(), 0.5, 1e-12);
  EXPECT_GT(std::abs(sample.force.x()), 0.2);
  EXPECT_TRUE(sample.flags & static_cast<std::uint32_t>(Flag::Limited));
}

TEST(TissueMemory, ADentStaysWhereItWasMadeAndRecovers)
{
  const auto pressed = [](double away)
  {
    Rig rig(settings({ { 0.5, 1.0 } }, 0.0));
    for (int i = 0; i < 2000; ++i)
    {
      (void)rig.press(5.0_mm);
    }
    const Sample lifted = rig.press(-1.0_mm);
    EXPECT_EQ(lifted.force, Vector3d::Zero());
    EXPECT_GT(lifted.surfaceDepth, 1.0_mm);
    (void)rig.press(0.1_mm, away); // touches no more than where the surface was
    (void)rig.press(-1.0_mm, away);
    return rig.press(3.0_mm, away).response.force;
  };
  Rig fresh(settings({ { 0.5, 1.0 } }, 0.0));
  const double whole = fresh.press(3.0_mm).response.force;
  EXPECT_LT(pressed(0.0), 0.5 * whole);
  EXPECT_NEAR(pressed(20.0_mm), whole, 1e-3 * whole);
}

TEST(TissueMemory, AnotherSceneRemembersNothing)
{
  Rig rig(settings({ { 0.5, 1.0 } }, 0.0));
  const double whole = rig.press(3.0_mm).response.force;
  for (int i = 0; i < 2000; ++i)
  {
    (void)rig.press(3.0_mm);
  }
  EXPECT_LT(rig.press(3.0_mm).response.force, 0.7 * whole);
  ++rig.scene.version;
  EXPECT_NEAR(rig.press(3.0_mm).response.force, whole, 1e-2 * whole);
}

// press, drag, lift and back, on flat tissue: what is felt never gives energy
TEST(TissueMemory, NoLoopOnFlatTissueGivesEnergy)
{
  std::mt19937 random(3);
  const auto uniform = [&](double from, double to)
  { return std::uniform_real_distribution<double>(from, to)(random); };
  for (int loop = 0; loop < 12; ++loop)
  {
    Rig rig(settings({ { uniform(0.05, 0.4), uniform(0.02, 0.3) } }, uniform(0.0, 0.8)));
    const double deep = uniform(1.0_mm, 6.0_mm);
    const double wide = uniform(1.0_mm, 10.0_mm);
    const double turns = std::floor(uniform(1.0, 4.0));
    Vector3d force = Vector3d::Zero();
    Vector3d apex(0.0, 0.0, 0.0);
    double work = 0.0; // of the hand
    constexpr int kSteps = 1200;
    for (int i = 1; i <= kSteps; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * i / kSteps;
      const Vector3d next(wide * std::sin(turns * angle), wide * (1.0 - std::cos(angle)),
        -0.5 * deep * (1.0 - std::cos(angle)));
      const Vector3d now = rig.at(next, 0.5 * kTick).force;
      work -= 0.5 * (force + now).dot(next - apex);
      force = now;
      apex = next;
    }
    EXPECT_GE(work, -1e-9) << loop;
  }
}

TEST(TissueMemory, TheSafetyChainSendsFrictionToo)
{
  Rig rig(settings(kTerms, 0.3));
  SafetyChain chain({ .model = "arm", .rendersForce = true, .maxForce = 7.9, .damping = 2.0 }, {});
  Sample sample;
  for (int i = 0; i < 3000; ++i)
  {
    const double depth = std::min(3.0_mm, 0.01_mm * i - 5.0_mm);
    const double x = std::max(0.0, 0.01_mm * (i - 1500));
    const ToolPose pose{ .apex = { x, 0.0, -depth },
      .axis = -Vector3d::UnitZ(),
      .velocity = { i > 1500 ? 0.01 : 0.0, 0.0, depth < 3.0_mm ? -0.01 : 0.0 } };
    sample = step(rig.scene, rig.memory, chain, pose, {}, { .armed = true }, kTick);
  }
  EXPECT_EQ(sample.state, DeviceState::Active);
  const double coulomb = 0.3 * sample.response.force;
  EXPECT_GT(coulomb, 0.05);
  EXPECT_NEAR(sample.force.x(), -coulomb, 1e-3 * coulomb);
  EXPECT_NEAR(sample.force.z(), sample.response.force, 1e-3 * sample.response.force);
  EXPECT_GE(chain.energy(), -1e-9);
}

TEST(TissueMemory, DoesNotAllocate)
{
  Rig rig(settings(kTerms, 0.3));
  const test::AllocationGuard guard;
  (void)rig.press(3.0_mm);
  (void)rig.press(3.0_mm, 1.0_mm);
  (void)rig.press(-3.0_mm, 1.0_mm);
  ++rig.scene.version;
  (void)rig.press(3.0_mm);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(TissueMemory, WhatIsNotFiniteGivesNoForceAndIsForgiven)
{
  Rig rig(settings(kTerms, 0.3));
  (void)rig.press(3.0_mm);
  EXPECT_EQ(rig.press(std::numeric_limits<double>::quiet_NaN()).force, Vector3d::Zero());
  EXPECT_TRUE(rig.press(3.0_mm).force.allFinite());
  EXPECT_GT(rig.press(3.0_mm).force.z(), 0.1);
}

} // namespace
} // namespace palp
