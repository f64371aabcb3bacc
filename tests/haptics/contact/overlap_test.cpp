#include "haptics/contact/find_contact.h"
#include "haptics/contact/overlap/immersion.h"
#include "haptics/contact/overlap/overlap.h"
#include "haptics/contact/overlap/section.h"
#include "haptics/force/linear/contact_depth.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
constexpr double kPi = std::numbers::pi;

const std::vector<std::pair<const char*, Tip>> kSharp = {
  { "slim cone", ConeTip{ .halfAngle = 20.0_deg, .baseRadius = 6.0_mm } },
  { "cone", ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm } },
  { "wide cone", ConeTip{ .halfAngle = 70.0_deg, .baseRadius = 10.0_mm } },
  { "punch", PunchTip{ .radius = 5.0_mm } },
  { "truncated cone",
    TruncatedConeTip{ .halfAngle = 45.0_deg, .flatRadius = 2.0_mm, .baseRadius = 8.0_mm } },
};

// the others go by their lift: flat_end_test.cpp
const auto kPointed = std::span(kSharp).first(3);

const Eigen::Vector3d kSize(60.0_mm, 60.0_mm, 30.0_mm);
constexpr double kTop = 0.0;

const Surface& blockOf24()
{
  static const Surface surface = test::makeSurface(test::block(kSize, 24));
  return surface;
}

// poses about the upper edges of a block, leaning by up to 30 degrees
class AboutEdges
{
public:
  ToolPose operator()()
  {
    const double lean = between(0.0, 30.0_deg);
    const double turn = between(0.0, 2.0 * kPi);
    return { .apex = { between(-34.0_mm, 34.0_mm), between(-34.0_mm, 34.0_mm),
               kTop - between(0.0, 6.0_mm) },
      .axis = { std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), -std::cos(lean) },
      .velocity = Eigen::Vector3d::Zero() };
  }
  double between(double low, double high)
  {
    return std::uniform_real_distribution<>(low, high)(random_);
  }

private:
  std::mt19937 random_{ 7 };
};

ToolPose upright(double x, double y, double depth)
{
  return { .apex = { x, y, kTop - depth },
    .axis = -Eigen::Vector3d::UnitZ(),
    .velocity = Eigen::Vector3d::Zero() };
}

// how what a pose gives changes with it
template <typename Of>
Eigen::Vector3d differences(const ToolPose& pose, Of of)
{
  constexpr double step = 1e-8;
  Eigen::Vector3d slope;
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    ToolPose before = pose;
    ToolPose after = pose;
    before.apex[k] -= step;
    after.apex[k] += step;
    slope[k] = (of(after) - of(before)) / (2.0 * step);
  }
  return slope;
}

TEST(ToolSolid, HasTheCirclesOfContactAndTheirVolume)
{
  for (const auto& [name, tip] : kSharp)
  {
    const ToolSolid solid(tip);
    double volume = 0.0; // by discs of the mean radius
    double last = 0.0;
    const double error = std::holds_alternative<TruncatedConeTip>(tip) ? 0.02 : 1e-6; // of steps
    const double flat = flatRadius(tip);
    const double step = (baseRadius(tip) - flat) / 2000.0;
    for (int i = 0; i <= 2000; ++i)
    {
      const double radius = flat + step * i;
      const double height = contactDepth(tip, radius);
      volume += kPi * std::pow(radius - 0.5 * step, 2) * (height - last);
      last = height;
      if (i > 0 && height > 0.0 && i % 100 == 0)
      {
        const Section section = sectionOf(solid, Eigen::Vector3d::UnitZ(), height);
        EXPECT_NEAR(section.area, kPi * radius * radius, error * section.area) << name;
        EXPECT_NEAR(section.volume, volume, (error + 1e-4) * volume) << name << " at " << i;
      }
    }
    const double base = baseRadius(tip);
    const double above = 2.0 * base;
    EXPECT_NEAR(sectionOf(solid, Eigen::Vector3d::UnitZ(), last + above).volume -
        sectionOf(solid, Eigen::Vector3d::UnitZ(), last + 1e-9).volume,
      kPi * base * base * above, 1e-6 * above * base * base)
      << name;
  }
}

// a plane cuts a cone in an ellipse
TEST(Section, OfALeaningConeIsAnEllipse)
{
  const ToolSolid solid(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 20.0_mm });
  const double angle = std::atan(2.0 / kPi); // of its circles of contact
  for (const double lean : { 0.0, 10.0_deg, 20.0_deg, 30.0_deg })
  {
    const Eigen::Vector3d normal(std::sin(lean), 0.0, std::cos(lean));
    const double height = 4.0_mm;
    const double open = std::pow(std::cos(angle), 2) - std::pow(std::sin(lean), 2);
    const double along = height * std::sin(angle) * std::cos(angle) / open;
    const double across = height * std::sin(angle) / std::sqrt(open);
    const double area = kPi * along * across;
    const Section section = sectionOf(solid, normal, height);
    EXPECT_NEAR(section.area, area, 2e-3 * area) << lean;
    EXPECT_NEAR(section.volume, area * height / 3.0, 2e-3 * section.volume) << lean;
    EXPECT_NEAR(section.growth, 2.0 * area / height, 4e-3 * section.growth) << lean;
  }
}

TEST(Overlap, WithAFaceIsThatOfItsPlane)
{
  AboutEdges poses;
  for (const auto& [name, tip] : kSharp)
  {
    const ToolSolid solid(tip);
    for (int i = 0; i < 200; ++i)
    {
      ToolPose pose = poses();
      pose.apex.head<2>() *= 0.3;
      const ToolFrame frame(pose);
      const Overlap overlap = overlapOf(blockOf24(), solid, frame);
      const Eigen::Vector3d normal = frame.axes.transpose() * Eigen::Vector3d::UnitZ();
      const Section section = sectionOf(solid, normal, kTop - pose.apex.z());
      EXPECT_NEAR(overlap.volume, section.volume, 1e-9 * section.volume + 1e-20) << name;
      EXPECT_LT((overlap.area - section.area * normal).norm(), 1e-9 * section.area + 1e-15) << name;
      const Eigen::Vector3d place = (kTop - pose.apex.z()) * normal + section.moment / section.area;
      EXPECT_LT((overlap.place / overlap.weight - place).norm(), 1e-9) << name;
    }
  }
}

TEST(Overlap, ChangesByTheAreaThatIsInTheTool)
{
  const Surface sheet = test::makeSurface(
    test::sheet(60.0_mm, 30, [](double x, double y) { return 3 * x * x - 2 * x * y; }));
  AboutEdges poses;
  for (const auto& [name, tip] : kSharp)
  {
    const ToolSolid solid(tip);
    for (int i = 0; i < 300; ++i)
    {
      const bool isOpen = i % 3 == 0;
      const Surface& surface = isOpen ? sheet : blockOf24();
      ToolPose pose = poses();
      pose.apex.z() -= isOpen ? kTop : 0.0;
      const auto volume = [&](const ToolPose& at)
      { return overlapOf(surface, solid, ToolFrame(at)).volume; };
      const ToolFrame frame(pose);
      const Overlap overlap = overlapOf(surface, solid, frame);
      const Eigen::Vector3d area = frame.axes * overlap.area;
      EXPECT_LT((differences(pose, volume) + area).norm(), 1e-6 * area.norm() + 1e-12)
        << name << (isOpen ? " on a sheet" : " on a block") << " at " << pose.apex.transpose();
    }
  }
}

TEST(Overlap, NormalWeightAndPlaceChangeAsTheirSlopesSay)
{
  AboutEdges poses;
  for (const auto& [name, tip] : kSharp)
  {
    const ToolSolid solid(tip);
    for (int i = 0; i < 200; ++i)
    {
      const ToolPose pose = poses();
      const Overlap here = overlapOf(blockOf24(), solid, ToolFrame(pose));
      const Eigen::Matrix3d axes = ToolFrame(pose).axes;
      const auto weight = [&](const ToolPose& at)
      { return overlapOf(blockOf24(), solid, ToolFrame(at)).weight; };
      EXPECT_LT((differences(pose, weight) - axes * here.weightSlope).norm(), 1e-7) << name;
      for (Eigen::Index k = 0; k < 3; ++k)
      {
        const auto normal = [&](const ToolPose& at)
        { return overlapOf(blockOf24(), solid, ToolFrame(at)).normal[k]; };
        EXPECT_LT(
          (differences(pose, normal) - axes * here.normalSlope.row(k).transpose()).norm(), 1e-7)
          << name;
        const auto place = [&](const ToolPose& at)
        {
          const Overlap there = overlapOf(blockOf24(), solid, ToolFrame(at));
          return there.place[k] + there.weight * axes.col(k).dot(at.apex - pose.apex);
        };
        EXPECT_LT(
          (differences(pose, place) - axes * here.placeSlope.row(k).transpose()).norm(), 1e-9)
          << name;
      }
    }
  }
}

TEST(Immersion, IsTheDepthAtWhichAPlaneTakesAsMuch)
{
  AboutEdges poses;
  for (const auto& [name, tip] : kPointed)
  {
    const ToolSolid solid(tip);
    for (int i = 0; i < 300; ++i)
    {
      const Eigen::Vector3d normal = -poses().axis;
      const double depth = poses.between(1e-6, 12.0_mm);
      const double volume = sectionOf(solid, normal, depth).volume;
      const double start = poses.between(0.1, 3.0) * depth;
      const double there = immersionOf(solid, normal, volume, start, 0.0).depth;
      EXPECT_NEAR(sectionOf(solid, normal, there).volume, volume, 1e-8 * volume) << name;
    }
  }
}

// what of a ball is within a tool's circles of contact, by integrals over rings
TEST(Immersion, InABallIsThatOfItsTop)
{
  const double radius = 50.0_mm;
  for (const auto& [name, tip] : kPointed)
  {
    for (const double depth : { 0.05_mm, 0.3_mm, 1.0_mm, 2.5_mm })
    {
      double volume = 0.0;
      constexpr int kRings = 20'000;
      const double base = baseRadius(tip);
      for (int i = 0; i < kRings; ++i)
      {
        const double r = base * (i + 0.5) / kRings;
        const double top = depth - radius + std::sqrt(radius * radius - r * r);
        volume += 2.0 * kPi * r * base / kRings * std::max(0.0, top - contactDepth(tip, r));
      }
      const Immersion there =
        immersionOf(ToolSolid(tip), Eigen::Vector3d::UnitZ(), volume, depth, 1.0 / radius);
      EXPECT_NEAR(there.depth, depth, 0.004 * depth) << name << " " << depth;
    }
  }
}

// of a spring that is pressed by the depth
Eigen::Vector3d pushOf(const Contact& contact)
{
  return contact.depth * contact.slope * contact.normal;
}

class OverAnEdge : public ::testing::TestWithParam<std::size_t>
{
protected:
  const Tip tip_ = kSharp[GetParam()].second;
  [[nodiscard]] Contact at(const ToolPose& pose) const
  {
    return findContact(blockOf24(), tip_, pose, ContactRule::Exact);
  }
};
INSTANTIATE_TEST_SUITE_P(Tools, OverAnEdge, ::testing::Range<std::size_t>(0, kSharp.size()));

TEST_P(OverAnEdge, HalfOfAToolIsAsDeepAsItsEnergySays)
{
  const double depth = 1.5_mm;
  const Contact contact = at(upright(0.5 * kSize.x(), 1.3_mm, depth));
  const bool isCone = std::holds_alternative<ConeTip>(tip_);
  if (isCone || std::holds_alternative<PunchTip>(tip_))
  {
    EXPECT_NEAR(contact.depth, (isCone ? std::cbrt(0.5) : std::sqrt(0.5)) * depth, 1e-4 * depth);
  }
  EXPECT_GT(contact.normal.x(), 0.0); // away from what is left of the body
  EXPECT_LT(contact.center.x(), 0.5 * kSize.x());
  EXPECT_NEAR(contact.bodyNormal.z(), 1.0, 1e-12);
}

TEST_P(OverAnEdge, TheDepthChangesAsTheNormalSays)
{
  AboutEdges poses;
  int contacts = 0;
  for (int i = 0; i < 500; ++i)
  {
    const ToolPose pose = poses();
    const Contact contact = at(pose);
    if (contact.depth > 0.01_mm && contact.slope < 4.89) // its bound
    {
      ++contacts;
      const auto depth = [&](const ToolPose& there) { return at(there).depth; };
      EXPECT_LT((differences(pose, depth) + contact.slope * contact.normal).norm(), 1e-5)
        << pose.apex.transpose();
      const auto tilt = [&](const ToolPose& there) { return at(there).tilt; };
      if (contact.tilt > 0.01)
      {
        EXPECT_LT((differences(pose, tilt) - contact.tiltSlope).norm(),
          1e-4 * (1.0 + contact.tiltSlope.norm()));
      }
    }
  }
  EXPECT_GT(contacts, 300);
}

TEST_P(OverAnEdge, NothingLeaps)
{
  constexpr double step = 0.02_mm;
  for (const double depth : { 0.3_mm, 1.5_mm, 4.0_mm })
  {
    Contact last = at(upright(15.0_mm, 1.3_mm, depth));
    ASSERT_NEAR(last.depth, depth, 1e-9);
    const double radius = ToolSolid(tip_).radiusAt(depth).value; // of the contact
    for (double x = 15.0_mm; x < 45.0_mm; x += step)
    {
      const Contact here = at(upright(x + step, 1.3_mm, depth));
      EXPECT_LE(here.depth, last.depth + 1e-12) << x;
      EXPECT_LT(last.depth - here.depth, std::max(4.0, 1.5 * depth / radius) * step) << x;
      EXPECT_LT((pushOf(here) - pushOf(last)).norm(),
        0.03 * depth + 3.0 * depth * std::max(1.0, depth / radius) * step / radius)
        << x;
      if (here.depth > 0.05 * depth)
      {
        EXPECT_LT((here.center - last.center).norm(), 4.0 * step) << x;
      }
      last = here;
    }
    EXPECT_FALSE(last.touching());
  }
}

} // namespace
} // namespace palp
