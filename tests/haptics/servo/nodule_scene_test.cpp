#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"
#include "haptics/error.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/haptics/servo/work_over.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::workOver;

const PlacedNodule kStiff{ { 0.0, 0.0, -10.0_mm }, 5.0_mm, 5.0 };

Scene sceneOf(Surface surface, const PlacedNodule& nodule,
  const LawSettings& settings = { .mode = LawMode::Corrected,
    .constitution = ConstitutiveModel::Linear })
{
  Scene world;
  world.surface = std::make_shared<const Surface>(std::move(surface));
  world.law = ForceLaw(SphereTip{ .radius = 10.0_mm }, makeMaterial(50.0_kPa, 0.33), settings);
  world.forceLimit = 100.0;
  world.nodules = embedNodules(*world.surface, world.law, std::array{ nodule });
  return world;
}

// 30 mm thick, its upper face at z = 0
Scene blockScene()
{
  return sceneOf(test::makeSurface(test::block({ 0.2, 0.2, 0.03 }, 20)), kStiff);
}

ToolPose at(const Eigen::Vector3d& apex, const Eigen::Vector3d& axis = -Eigen::Vector3d::UnitZ())
{
  return { .apex = apex, .axis = axis };
}

// of data/reference/nodule_offaxis.csv: linear finite elements
TEST(NoduleScene, ToolFeelsTheForceOfFiniteElements)
{
  const Scene world = blockScene();
  const Sample above = step(world, at({ 0.0, 0.0, -4.0_mm }));
  EXPECT_NEAR(above.response.force, 2.481674, 0.01 * 2.48);
  EXPECT_NEAR(above.force.z(), above.response.force, 1e-6);
  EXPECT_NEAR(above.force.head<2>().norm(), 0.0, 1e-4);
  const Sample beside = step(world, at({ 5.0_mm, 0.0, -4.0_mm }));
  EXPECT_NEAR(beside.response.force, 2.405091, 0.01 * 2.41);
  EXPECT_NEAR(beside.force.x(), 0.0484034, 0.002);
  EXPECT_NEAR(beside.force.y(), 0.0, 1e-6);
}

// as each alone in the body: above the one, the other soft and to the side
TEST(NoduleScene, TellsWhatEachNoduleAddsAlone)
{
  const PlacedNodule soft{ { 12.0_mm, 0.0, -9.0_mm }, 4.0_mm, 0.25 };
  const Scene stiffOnly = blockScene();
  Scene softOnly = stiffOnly;
  softOnly.nodules = embedNodules(*softOnly.surface, softOnly.law, std::array{ soft });
  Scene both = stiffOnly;
  both.nodules = embedNodules(*both.surface, both.law, std::array{ kStiff, soft });
  const ToolPose pose = at({ 0.0, 0.0, -4.0_mm });
  const Contact contact = step(both, pose).contact;
  const Response plain = both.law(contactGeometryOf(contact));
  const std::vector<double> told = both.nodules->contrasts(noduleContactOf(contact), plain);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_NEAR(told[0], step(stiffOnly, pose).response.force / plain.force - 1.0, 1e-9);
  EXPECT_NEAR(told[1], step(softOnly, pose).response.force / plain.force - 1.0, 1e-9);
  EXPECT_GT(told[0], 0.0);
  EXPECT_LT(told[1], 0.0);
}

// of data/reference/nodule_surface.csv: linear finite elements, a ball of 10 mm on 40 mm
TEST(NoduleScene, SurfaceGivesWayAsFarAsFiniteElementsDo)
{
  Scene world;
  world.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.3, 0.3, 0.04 }, 20)));
  world.law = ForceLaw(SphereTip{ .radius = 10.0_mm }, makeMaterial(50.0_kPa, 0.45),
    { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear });
  const std::vector<test::ReferenceRow> rows = test::referenceTable("nodule_surface");
  EXPECT_EQ(rows.size(), 9U);
  double worst = 0.0;
  double worstWithout = 0.0;
  for (const test::ReferenceRow& row : rows)
  {
    double radius = 0.0;
    double top = 0.0;
    double ratio = 0.0;
    ASSERT_EQ(std::sscanf(row.text("case").c_str(), "b%lf_t%lf_k%lf", &radius, &top, &ratio), 3);
    const PlacedNodule nodule{ { 0.0, 0.0, -(radius + top) * 1.0_mm }, radius * 1.0_mm, ratio };
    world.nodules = embedNodules(*world.surface, world.law, std::array{ nodule });
    const Contact contact = step(world, at({ 0.0, 0.0, -row.number("d_m") })).contact;
    const double told = world.nodules->extentRadius(
      noduleContactOf(contact), world.law(contactGeometryOf(contact)), row.number("Rd_hom_m"));
    worst = std::max(worst, std::abs(told - row.number("Rd_nod_m")));
    worstWithout =
      std::max(worstWithout, std::abs(row.number("Rd_hom_m") - row.number("Rd_nod_m")));
  }
  EXPECT_LT(worst, 1.0_mm);
  EXPECT_GT(worstWithout, 1.9_mm);
  RecordProperty("worst_mm", std::to_string(units::toMillimeters(worst)));
}

TEST(NoduleScene, SafetyChainSendsTheLateralForceToo)
{
  const Scene world = blockScene();
  SafetyChain chain({ .model = "none", .maxForce = 100.0, .damping = 5.0 });
  TissueMemory memory;
  Sample sample;
  for (int i = 0; i < 2000; ++i) // until it has started
  {
    const double deep = std::min(4.0_mm, (i - 200) * 0.004_mm);
    sample = step(world, memory, chain, at({ 5.0_mm, 0.0, -deep }), {}, { .armed = true }, 0.001);
  }
  EXPECT_NEAR(sample.force.x(), sample.lateral.x(), 1e-6);
  EXPECT_NEAR(sample.force.x(), 0.0484034, 0.003);
}

// down, along, up and back in the air, with the tool's reference point along circles about the
// origin
ToolPose aroundABall(double radius, double t)
{
  const double deep = 4.0_mm;
  const double part = 4.0 * t;
  const double angle = part < 1.0 ? -0.5
    : part < 2.0                  ? -0.5 + 0.55 * (part - 1.0)
    : part < 3.0                  ? 0.05
                                  : 0.05 - 0.55 * (part - 3.0);
  const double depth = part < 1.0 ? deep * part
    : part < 2.0                  ? deep
    : part < 3.0                  ? deep * (3.0 - part)
                                  : 0.0;
  const Eigen::Vector3d out(std::sin(angle), 0.0, std::cos(angle));
  return at((radius - depth) * out, -out);
}

TEST(NoduleScene, NoLoopOverABlockGivesEnergy)
{
  const Scene world = blockScene();
  const auto down = [](double t) { return at({ -20.0_mm, 0.0, -4.0_mm * t }); };
  const auto along = [](double t) { return at({ -20.0_mm + 22.0_mm * t, 0.0, -4.0_mm }); };
  const auto up = [](double t) { return at({ 2.0_mm, 0.0, -4.0_mm * (1.0 - t) }); };
  const double pressed = workOver(world, 500, down);
  const double loop = pressed + workOver(world, 500, along) + workOver(world, 500, up);
  EXPECT_LT(std::abs(loop), 0.01 * pressed);
  RecordProperty("loop_of_pressed", std::to_string(loop / pressed));
}

// pressed beside a stiff nodule and lifted above it, and the other way around, fast and slow
TEST(NoduleScene, NoLoopOverTissueThatRelaxesAndRubsGivesEnergy)
{
  for (const double friction : { 0.0, 0.3 })
  {
    LawSettings settings = blockScene().law.settings();
    settings.relaxation.add({ 0.4, 50.0_ms });
    settings.relaxation.add({ 0.2, 0.6 });
    settings.friction = friction;
    const Scene world =
      sceneOf(test::makeSurface(test::block({ 0.2, 0.2, 0.03 }, 20)), kStiff, settings);
    for (const double seconds : { 0.03, 0.3, 3.0, 30.0 })
    {
      for (const double from : { -15.0_mm, 2.0_mm })
      {
        const double to = -13.0_mm - from;
        const auto path = [&](double t)
        {
          const double x = from + (to - from) * std::clamp(3.0 * t - 1.0, 0.0, 1.0);
          return at({ x, 0.0, -4.0_mm * std::clamp(3.0 * std::min(t, 1.0 - t), 0.0, 1.0) });
        };
        constexpr int kSteps = 3000;
        TissueMemory memory;
        double loop = 0.0;
        double pressed = 0.0;
        for (int i = 0; i < kSteps; ++i)
        {
          const Eigen::Vector3d move =
            path((i + 1.0) / kSteps).apex - path(static_cast<double>(i) / kSteps).apex;
          loop -= step(world, memory, path((i + 0.5) / kSteps), seconds / kSteps).force.dot(move);
          pressed = std::max(pressed, loop);
        }
        EXPECT_GT(loop, -1e-3 * pressed) << friction << ", " << seconds << " s, " << from;
      }
    }
  }
}

// that the nodule adds, whatever the law does on a curved surface. The tool's axis turns with the
// normal, and with it the apex about the ball's center, which does no work
TEST(NoduleScene, ANoduleAddsNoEnergyToALoopOverABall)
{
  constexpr double kRadius = 50.0_mm;
  Scene with = sceneOf(test::makeSurface(test::ball(kRadius, 40)),
    PlacedNodule{ { 0.0, 0.0, kRadius - 12.0_mm }, 5.0_mm, 5.0 });
  Scene without = with;
  without.nodules = nullptr;
  const auto down = [](double t) { return aroundABall(kRadius, 0.25 * t); };
  const double pressed = workOver(with, 250, down);
  // by the ball's center, 10 mm farther out than the apex
  const auto loopOf = [&](const Scene& world)
  {
    double work = 0.0;
    constexpr int kSteps = 2000;
    const auto center = [](double t)
    {
      const ToolPose pose = aroundABall(kRadius, t);
      return Eigen::Vector3d(pose.apex - 10.0_mm * pose.axis);
    };
    for (int i = 0; i < kSteps; ++i)
    {
      const Eigen::Vector3d move =
        center((i + 1.0) / kSteps) - center(static_cast<double>(i) / kSteps);
      work -= step(world, aroundABall(kRadius, (i + 0.5) / kSteps)).force.dot(move);
    }
    return work;
  };
  const double added = loopOf(with) - loopOf(without);
  EXPECT_LT(std::abs(added), 0.01 * pressed);
  RecordProperty("added_of_pressed", std::to_string(added / pressed));
}

TEST(NoduleScene, IsFeltWithoutAllocation)
{
  const Scene world = blockScene();
  const test::AllocationGuard guard;
  const Sample sample = step(world, at({ 5.0_mm, 0.0, -4.0_mm }));
  EXPECT_EQ(guard.count(), 0);
  EXPECT_GT(sample.lateral.x(), 0.0);
}

TEST(NoduleScene, WhatIsNotInTheBodyIsRefused)
{
  const Surface surface = test::makeSurface(test::block({ 0.2, 0.2, 0.03 }, 4));
  const ForceLaw law = blockScene().law;
  EXPECT_EQ(embedNodules(surface, law, {}), nullptr);
  const auto refusal = [&](const std::vector<PlacedNodule>& nodules) -> std::string
  {
    try
    {
      (void)embedNodules(surface, law, nodules);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  const auto one = [](double z, double radius, double ratio) {
    return PlacedNodule{ { 0.0, 0.0, z }, radius, ratio };
  };
  EXPECT_TRUE(refusal({ one(5.0_mm, 3.0_mm, 5.0) }).starts_with("nodules/0: its center is not"));
  EXPECT_TRUE(refusal({ one(-3.0_mm, 4.0_mm, 5.0) }).starts_with("nodules/0: it stands out"));
  EXPECT_TRUE(refusal({ kStiff, one(-22.0_mm, 4.0_mm, 0.0) }).starts_with("nodules/1: the ratio"));
  EXPECT_TRUE(refusal({ kStiff, one(-16.0_mm, 4.0_mm, 5.0) }).ends_with("move one of them"));
}

} // namespace
} // namespace palp
