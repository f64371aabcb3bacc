#include "haptics/servo/organ_touch.h"

#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/servo/safety_bench.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kBall = 40.0_mm;
constexpr double kNose = 5.0_mm;

std::shared_ptr<const Surface> shifted(test::Mesh mesh, const Vector3d& by)
{
  for (Vector3d& point : mesh.first)
  {
    point += by;
  }
  return std::make_shared<const Surface>(test::makeSurface(std::move(mesh)));
}

LawSettings relaxing()
{
  LawSettings settings{ .mode = LawMode::Corrected, .friction = 0.3 };
  settings.relaxation.add({ .fraction = 0.4, .time = 0.05 });
  return settings;
}

Scene organ(std::shared_ptr<const Surface> surface, double young, const LawSettings& law = {})
{
  Scene one;
  one.surface = std::move(surface);
  one.law = ForceLaw(SphereTip{ .radius = kNose }, makeMaterial(young, 0.45), law);
  one.forceLimit = 1e9;
  return one;
}

Scene together(Scene first, std::vector<Scene> others)
{
  first.others = std::move(others);
  return first;
}

const Scene& left(const LawSettings& law = {})
{
  static const auto ball = shifted(test::ball(kBall, 24), { -kBall, 0.0, 0.0 });
  static Scene scene;
  scene = organ(ball, 5.0_kPa, law);
  return scene;
}

const Scene& right(const LawSettings& law = {})
{
  static const auto ball = shifted(test::ball(kBall, 24), { kBall, 0.0, 0.0 });
  static Scene scene;
  scene = organ(ball, 50.0_kPa, law);
  return scene;
}

ToolPose downAt(const Vector3d& apex)
{
  return { .apex = apex, .axis = -Vector3d::UnitZ() };
}

// down at x to a depth below the top of the balls, and up again
std::vector<Vector3d> press(double x, double depth)
{
  std::vector<Vector3d> path;
  for (int i = -40; i <= 40; ++i)
  {
    path.emplace_back(x, 0.0, kBall + 1.0_mm - (depth + 1.0_mm) * (1.0 - std::abs(i) / 40.0));
  }
  return path;
}

std::vector<Sample> play(const Scene& scene, const std::vector<Vector3d>& path)
{
  TissueMemory memory;
  std::vector<Sample> samples;
  for (const Vector3d& apex : path)
  {
    samples.push_back(step(scene, memory, downAt(apex), 1.0_ms));
  }
  return samples;
}

void expectSame(const std::vector<Sample>& one, const std::vector<Sample>& other)
{
  int touched = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    ASSERT_EQ(one[i].contact.depth, other[i].contact.depth) << i;
    ASSERT_EQ(one[i].contact.normal, other[i].contact.normal) << i;
    ASSERT_EQ(one[i].response.force, other[i].response.force) << i;
    ASSERT_EQ(one[i].response.contactRadius, other[i].response.contactRadius) << i;
    ASSERT_EQ(one[i].force, other[i].force) << i;
    ASSERT_EQ(one[i].friction, other[i].friction) << i;
    touched += one[i].contact.touching();
  }
  EXPECT_GT(touched, 20);
}

TEST(OrganTouch, EachOfTwoTouchingOrgansAnswersAsIfItWereAlone)
{
  for (const LawSettings& law : { LawSettings{}, relaxing() })
  {
    const Scene both = together(left(law), { right(law) });
    std::vector<Vector3d> path = press(-kBall, 4.0_mm);
    const std::vector<Vector3d> second = press(kBall, 3.0_mm);
    path.insert(path.end(), second.begin(), second.end());
    const std::vector<Sample> samples = play(both, path);
    const auto half = static_cast<std::ptrdiff_t>(path.size() / 2);
    expectSame({ samples.begin(), samples.begin() + half }, play(left(law), press(-kBall, 4.0_mm)));
    expectSame({ samples.begin() + half, samples.end() }, play(right(law), second));
    EXPECT_EQ(samples.front().organ, 0);
    EXPECT_EQ(samples.back().organ, 1); // touched last
  }
}

// the tool comes down the groove between both, nearer to one
TEST(OrganTouch, IsThatWhichIsMetFirstUntilTheToolIsLifted)
{
  const Scene both = together(left(), { right() });
  for (const double side : { -1.0, 1.0 })
  {
    const int expected = side > 0.0 ? 1 : 0;
    const Scene& met = organOf(both, expected);
    const Scene& other = organOf(both, 1 - expected);
    TissueMemory memory;
    double z = kBall;
    Sample sample;
    for (; !sample.contact.touching(); z -= 0.1_mm)
    {
      sample = step(both, memory, downAt({ side * 1.0_mm, 0.0, z }), 1.0_ms);
    }
    EXPECT_EQ(sample.organ, expected);
    const double deeper = z - 6.0_mm;
    for (; z > deeper; z -= 0.1_mm)
    {
      sample = step(both, memory, downAt({ side * 1.0_mm, 0.0, z }), 1.0_ms);
      ASSERT_EQ(sample.organ, expected);
    }
    for (double x = side * 1.0_mm; x * side > -1.0_mm; x -= side * 0.1_mm)
    {
      sample = step(both, memory, downAt({ x, 0.0, z }), 1.0_ms);
      ASSERT_EQ(sample.organ, expected);
      ASSERT_EQ(sample.response.force, evaluateContact(met, downAt({ x, 0.0, z })).response.force);
    }
    EXPECT_GT(evaluateContact(other, sample.pose).contact.depth, sample.contact.depth);
    for (; sample.contact.touching(); z += 0.1_mm)
    {
      sample = step(both, memory, downAt({ -side * 1.0_mm, 0.0, z }), 1.0_ms);
      ASSERT_TRUE(
        sample.organ == expected || !evaluateContact(met, sample.pose).contact.touching());
    }
    for (sample = {}; !sample.contact.touching(); z -= 0.1_mm)
    {
      sample = step(both, memory, downAt({ -side * 1.0_mm, 0.0, z }), 1.0_ms);
    }
    EXPECT_EQ(sample.organ, 1 - expected);
  }
}

// a floor that was entered early in a long step, and a wall late and deeper
TEST(OrganTouch, OfTwoThatAreEnteredWithinATickTheFirstAlongTheWayIsMet)
{
  const Vector3d size(0.1, 0.1, 0.05);
  const Scene floor = organ(shifted(test::block(size, 20), { 0.0, 0.0, 0.0 }), 5.0_kPa);
  const Scene wall = organ(shifted(test::block(size, 20), { 0.075, 0.0, 0.03 }), 5.0_kPa);
  const Vector3d from(0.0, 0.0, 0.1_mm);
  const Vector3d to(0.025, 0.0, -0.9_mm); // 5 mm into the wall at x = 25 mm, as far as the nose
  for (const bool turned : { false, true })
  {
    const Scene both = turned ? together(wall, { floor }) : together(floor, { wall });
    TissueMemory memory;
    ASSERT_FALSE(step(both, memory, downAt(from), 1.0_ms).contact.touching());
    const Sample sample = step(both, memory, downAt(to), 1.0_ms);
    ASSERT_GT(evaluateContact(wall, downAt(to)).contact.depth, 2.0 * sample.contact.depth);
    EXPECT_EQ(sample.organ, turned ? 1 : 0);
    EXPECT_EQ(sample.contact.depth, evaluateContact(floor, downAt(to)).contact.depth);
  }
}

TEST(OrganTouch, OrgansOutOfReachChangeNothing)
{
  const Scene alone = left(relaxing());
  std::vector<Scene> far;
  for (int i = 1; i <= 10; ++i)
  {
    far.push_back(organ(shifted(test::ball(20.0_mm, 8), { -kBall, 0.1 * i, 0.0 }), 50.0_kPa));
  }
  const std::vector<Vector3d> path = press(-kBall, 5.0_mm);
  expectSame(play(together(alone, far), path), play(alone, path));
}

// more than have a bit, each a ball on a ring around the first, touched on the way around it
TEST(OrganTouch, IsFoundWhereverTheToolComesTo)
{
  constexpr int kBalls = 70;
  const auto angle = [](int i) { return 2.0 * std::numbers::pi * i / kBalls; };
  const auto on = [&](double turn)
  { return Vector3d(0.5 * std::cos(turn), 0.5 * std::sin(turn), 0.0); };
  std::vector<Scene> ring;
  for (int i = 0; i < kBalls; ++i)
  {
    ring.push_back(organ(shifted(test::ball(15.0_mm, 6), on(angle(i))), 50.0_kPa));
  }
  const Scene all = together(organ(shifted(test::ball(15.0_mm, 6), { 0, 0, 0 }), 50.0_kPa), ring);
  TissueMemory memory;
  for (int i = 0; i < kBalls; i += 3)
  {
    for (const double part : { 0.0, 0.5, 1.0 }) // across the free middle, too
    {
      const Vector3d above = part * on(angle(i)) + Vector3d(0.0, 0.0, 30.0_mm);
      EXPECT_FALSE(step(all, memory, downAt(above), 1.0_ms).contact.touching());
    }
    const ToolPose pressed = downAt(on(angle(i)) + Vector3d(0.0, 0.0, 13.0_mm));
    const Sample sample = step(all, memory, pressed, 1.0_ms);
    EXPECT_EQ(sample.organ, i + 1);
    const Contact alone = evaluateContact(organOf(all, i + 1), pressed).contact;
    EXPECT_EQ(sample.contact.depth, alone.depth);
    EXPECT_TRUE(sample.contact.touching());
  }
}

TEST(OrganTouch, OnlyTheFeltOrgansStopTheTool)
{
  OrganTouch none;
  const ToolPose inside = downAt({ kBall, 0.0, kBall - 2.0_mm });
  EXPECT_FALSE(touchOrgan(left(), inside, none).touching()); // the right one is not of the scene
  EXPECT_TRUE(touchOrgan(together(left(), { right() }), inside, none).touching());
  EXPECT_EQ(none.organ, 1);
}

TEST(OrganTouch, AnotherSceneBeginsWithoutIt)
{
  TissueMemory memory;
  const Scene both = together(left(), { right() });
  ASSERT_EQ(step(both, memory, downAt({ kBall, 0.0, kBall - 1.0_mm }), 1.0_ms).organ, 1);
  Scene one = left();
  one.version = 1;
  const Sample sample = step(one, memory, downAt({ -kBall, 0.0, kBall - 1.0_mm }), 1.0_ms);
  EXPECT_EQ(sample.organ, 0);
  EXPECT_GT(sample.force.z(), 0.0);
  SafetyChain chain(test::arm());
  TissueMemory lost;
  (void)step(both, lost, downAt({ kBall, 0.0, kBall - 1.0_mm }), 1.0_ms);
  EXPECT_EQ(step(one, lost, chain, std::nullopt, {}, {}, 1.0_ms).organ, 0);
}

TEST(OrganTouch, SlidingOverASeamChangesTheForceAsStiffnessAndMotionDo)
{
  const auto block = [](double x) {
    return shifted(test::block({ 0.1, 0.1, 0.05 }, 20), { x, 0.0, 0.0 });
  };
  const Scene soft = organ(block(-0.05), 5.0_kPa); // with its top in z = 0
  const Scene stiff = organ(block(0.05), 50.0_kPa);
  const Scene both = together(soft, { stiff });
  for (const double depth : { 1.0_mm, 2.5_mm, 4.0_mm })
  {
    for (const double motion : { 0.02_mm, 0.1_mm, 0.5_mm })
    {
      TissueMemory memory;
      Sample before;
      double z = 0.1_mm;
      for (; z > -depth; z -= 0.02_mm)
      {
        before = step(both, memory, downAt({ -15.0_mm, 0.0, z }), 1.0_ms);
      }
      ASSERT_TRUE(before.organ == 0 && before.force.z() > 0.0);
      // of a sphere on the stiffer half-space: Hertz, the derivative of his force by depth
      const double stiffness = 2.0 * 50.0_kPa / (1.0 - 0.45 * 0.45) * std::sqrt(kNose * depth);
      int handed = 0;
      for (double x = -15.0_mm; x < 15.0_mm; x += motion)
      {
        const Sample sample = step(both, memory, downAt({ x, 0.0, z }), 1.0_ms);
        ASSERT_LT((sample.force - before.force).norm(), 3.0 * stiffness * motion) << depth;
        if (sample.organ != before.organ)
        {
          ++handed;
          TissueMemory rest = memory; // a tool that stays feels no force grow
          const Sample rested = step(both, rest, sample.pose, 1.0_ms);
          EXPECT_EQ(step(both, rest, sample.pose, 1.0_ms).force, rested.force);
        }
        before = sample;
      }
      EXPECT_TRUE(handed == 1 && before.organ == 1);
      EXPECT_EQ(before.response.force, evaluateContact(stiff, before.pose).response.force);
    }
  }
}

// sideways out of the one, into the other, which is touched deep
TEST(OrganTouch, IsHandedOverToAHandWithoutAJumpOfTheForce)
{
  const Scene both = together(left(), { right() });
  SafetyChain chain(test::arm());
  TissueMemory memory;
  const double z = 9.0_mm;
  const auto tick = [&](double x, double height)
  {
    const ToolPose pose = downAt({ x, 0.0, height });
    return step(both, memory, chain, pose, { .homed = true }, { .armed = true }, 1.0_ms);
  };
  for (int i = 0; i < 1000; ++i)
  {
    (void)tick(-2.0_mm, kBall + 5.0_mm);
  }
  for (double height = kBall + 5.0_mm; height > z; height -= 0.05_mm)
  {
    (void)tick(-2.0_mm, height);
  }
  Sample before = tick(-2.0_mm, z);
  ASSERT_EQ(before.organ, 0);
  ASSERT_GT(before.force.norm(), 0.01);
  for (double x = -2.0_mm; x < 6.0_mm; x += 0.02_mm)
  {
    const Sample sample = tick(x, z);
    EXPECT_LT((sample.force - before.force).norm(), 0.05) << x;
    before = sample;
  }
  EXPECT_EQ(before.organ, 1);
}

TEST(OrganTouch, NeverAllocates)
{
  const Scene both = together(left(relaxing()), { right(relaxing()) });
  TissueMemory memory;
  const auto feel = [&](const Vector3d& apex) { (void)step(both, memory, downAt(apex), 1.0_ms); };
  const std::vector<Vector3d> path = press(0.5_mm, 40.0_mm);
  const test::AllocationGuard guard;
  std::ranges::for_each(path, feel);
  EXPECT_EQ(guard.count(), 0U);
}

} // namespace
} // namespace palp
