#include "haptics/contact/find_contact.h"
#include "haptics/surface/closest_point.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kTool = 10.0_mm;
constexpr double kBody = 50.0_mm;

Contact press(const Surface& surface, const Eigen::Vector3d& apex, const Eigen::Vector3d& axis)
{
  return findContact(surface, SphereTip{ .radius = kTool },
    { .apex = apex, .axis = axis, .velocity = Eigen::Vector3d::Zero() }, ContactRule::Exact);
}

// of Hertz, up to a constant
Eigen::Vector3d forceOf(const Contact& contact)
{
  return std::pow(contact.depth, 1.5) * contact.normal;
}

struct Slide
{
  double ripple = 0.0;    // of |F|, half the range over the middle [-]
  double direction = 0.0; // largest error against the exact normal [rad]
  double change = 0.0;    // largest between two samples, of F [-]
};

// 60 mm at constant depth over a sphere, at 100 mm/s and 1 kHz
Slide slide(
  const Surface& ball, double depth, const Eigen::Vector3d& start, const Eigen::Vector3d& toward)
{
  Slide result;
  double least = 1.0;
  double most = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int i = 0; i <= 600; ++i)
  {
    const double angle = i * 0.1_mm / kBody;
    const Eigen::Vector3d out = std::cos(angle) * start + std::sin(angle) * toward;
    const Contact contact = press(ball, (kBody - depth) * out, -out);
    const Eigen::Vector3d force = forceOf(contact);
    least = std::min(least, force.norm());
    most = std::max(most, force.norm());
    result.direction =
      std::max(result.direction, std::acos(std::min(1.0, contact.normal.dot(out))));
    if (i > 0)
    {
      result.change = std::max(result.change, (force - last).norm() / force.norm());
    }
    last = force;
  }
  result.ripple = (most - least) / (most + least);
  return result;
}

TEST(ContactSmoothness, ASphereSlidesOverFacetsAsOverASphere)
{
  const Surface ball = test::makeSurface(test::ball(kBody, 20)); // 4 mm edges
  ASSERT_NEAR(ball.edgeLength(), 4.0_mm, 0.5_mm);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20; ++i)
  {
    const Eigen::Vector3d start =
      Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d toward =
      start.cross(Eigen::Vector3d(normal(random), normal(random), normal(random))).normalized();
    const Slide result = slide(ball, 3.0_mm, start, toward);
    EXPECT_LE(result.ripple, 0.01);
    EXPECT_LE(result.direction, 1.0_deg);
    EXPECT_LE(result.change, 0.01);
  }
}

// the smaller the step, the smaller the change of the force, on whatever surface, at whatever
// place: nothing jumps, neither the depth nor, times the depth, the normal
TEST(ContactSmoothness, NothingJumps)
{
  const Surface surfaces[] = { test::makeSurface(test::ball(30.0_mm, 6)),
    test::makeSurface(test::block({ 60.0_mm, 40.0_mm, 20.0_mm }, 1)),
    test::makeSurface(test::block({ 60.0_mm, 40.0_mm, 20.0_mm }, 7)),
    test::makeSurface(test::sheet(60.0_mm, 12,
      [](double x, double y) { return 3.0_mm * std::sin(200.0 * x) * std::cos(150.0 * y); })) };
  const double step = 0.2_um;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  for (const Surface& surface : surfaces)
  {
    for (const Tip& tip :
      { Tip{ SphereTip{ .radius = 10.0_mm } },
        Tip{ ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm } },
        Tip{ BluntConeTip{ .halfAngle = 60.0_deg, .tipRadius = 2.0_mm, .baseRadius = 8.0_mm } } })
    {
      for (int i = 0; i < 40; ++i)
      {
        const Eigen::Vector3d axis =
          Eigen::Vector3d(0.3 * normal(random), 0.3 * normal(random), -1.0).normalized();
        const Eigen::Vector3d direction =
          Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        ToolPose pose;
        pose.axis = axis;
        pose.apex = { 30.0_mm * position(random), 20.0_mm * position(random),
          4.0_mm * position(random) };
        const auto push = [&]
        {
          const Contact contact = findContact(surface, tip, pose, ContactRule::Exact);
          return Eigen::Vector3d(contact.depth * contact.normal);
        };
        Eigen::Vector3d last = push();
        for (int k = 0; k < 2000; ++k)
        {
          pose.apex += step * direction;
          const Eigen::Vector3d now = push();
          ASSERT_LE((now - last).norm(), 40.0 * step)
            << "at " << pose.apex.transpose() << " axis " << axis.transpose();
          last = now;
        }
      }
    }
  }
}

// hardly wider than the ball, all of which comes in at about the same depth
TEST(ContactSmoothness, InABowlABallIsPushedOutAsItGoesIn)
{
  constexpr double kStep = 0.01_mm;
  for (const double wide : { 10.5_mm, 11.0_mm, 12.0_mm, 15.0_mm })
  {
    for (const int cells : { 10, 30 })
    {
      const Surface bowl = test::makeSurface(test::sheet(14.0_mm, cells,
        [&](double x, double y) { return wide - std::sqrt(wide * wide - x * x - y * y); }));
      for (const double aside : { 0.0, 0.3_mm, 1.0_mm })
      {
        Contact last;
        for (double depth = 0.0; depth < 2.0_mm; depth += kStep)
        {
          const Contact here =
            press(bowl, { aside, 0.4 * aside, -depth }, -Eigen::Vector3d::UnitZ());
          if (last.depth > 0.1_mm)
          {
            EXPECT_GT(here.normal.z(), 0.7) << wide << " " << aside << " " << depth;
            EXPECT_GT(here.depth, last.depth) << wide << " " << aside << " " << depth;
            EXPECT_LT(here.depth, last.depth + 2.0 * kStep) << wide << " " << aside << " " << depth;
          }
          last = here;
        }
        EXPECT_GT(last.depth, 1.9_mm);
      }
    }
  }
}

} // namespace
} // namespace palp
