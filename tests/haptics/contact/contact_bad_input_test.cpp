#include "haptics/contact/find_contact.h"
#include "haptics/units.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

const Tip kBallTip = SphereTip{ .radius = 10.0_mm };
const Tip kPointedTip = ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm };
constexpr int kPresses = test::kSanitized ? 1'000 : 20'000;

Contact press(const Surface& surface, const Tip& tip, const Eigen::Vector3d& apex,
  const Eigen::Vector3d& axis = -Eigen::Vector3d::UnitZ(), ContactRule rule = ContactRule::Exact)
{
  return findContact(
    surface, tip, { .apex = apex, .axis = axis, .velocity = Eigen::Vector3d::Zero() }, rule);
}

bool usable(const Contact& contact)
{
  return std::isfinite(contact.depth) && contact.depth >= 0.0 && contact.normal.allFinite() &&
    contact.center.allFinite() && std::isfinite(contact.tilt) &&
    std::isfinite(contact.surfaceCurvature) && !std::isnan(contact.thickness) &&
    contact.thickness >= 0.0 && !std::isnan(contact.edgeDistance) &&
    std::isfinite(contact.curvatureSpread) && contact.curvatureSlope.allFinite() &&
    contact.spreadSlope.allFinite() && contact.thicknessSlope.allFinite() &&
    (!contact.touching() || std::abs(contact.normal.norm() - 1.0) < 1e-9);
}

test::Mesh merged(test::Mesh a, const test::Mesh& b)
{
  const int shift = static_cast<int>(a.first.size());
  a.first.insert(a.first.end(), b.first.begin(), b.first.end());
  for (const Triangle& t : b.second)
  {
    a.second.push_back({ t[0] + shift, t[1] + shift, t[2] + shift });
  }
  return a;
}

// a top face of needles, and triangles without any area, is still a plane
TEST(ContactBadInput, SliversDoNotChangeADepth)
{
  test::Mesh mesh = test::block({ 0.1, 0.1, 0.05 }, 10);
  for (Eigen::Vector3d& point : mesh.first)
  {
    point.y() = 0.05 * std::copysign(std::pow(std::abs(point.y()) / 0.05, 8.0), point.y());
  }
  mesh.second.push_back({ 3, 3, 4 });
  mesh.second.push_back({ 5, 5, 5 });
  const Surface surface = test::makeSurface(mesh);
  for (const double y : { 0.0, 1e-9, 1e-5, 0.01 })
  {
    const Contact contact = press(surface, kBallTip, { 3.0_mm, y, -2.0_mm });
    EXPECT_NEAR(contact.depth, 2.0_mm, 1e-9);
    EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
  }
}

// every triangle with points of its own, as an STL file has them
TEST(ContactBadInput, DuplicatePointsDoNotChangeADepth)
{
  const test::Mesh mesh = test::block({ 0.1, 0.1, 0.05 }, 10);
  test::Mesh soup;
  for (const Triangle& t : mesh.second)
  {
    const int first = static_cast<int>(soup.first.size());
    for (const int point : t)
    {
      soup.first.push_back(mesh.first[static_cast<std::size_t>(point)]);
    }
    soup.second.push_back({ first, first + 1, first + 2 });
  }
  const Surface surface = test::makeSurface(soup);
  EXPECT_FALSE(surface.closed());
  for (const Eigen::Vector3d& apex :
    { Eigen::Vector3d(3.1_mm, 1.3_mm, -2.0_mm), Eigen::Vector3d(0.0, 0.0, -2.0_mm) })
  {
    for (const Tip& tip : { kBallTip, kPointedTip })
    {
      EXPECT_NEAR(press(surface, tip, apex).depth, 2.0_mm, 1e-9);
    }
  }
}

// far larger than the body: the distance to it is what counts, within its size
TEST(ContactBadInput, AToolLargerThanTheMesh)
{
  const double small = 1.0_mm;
  const Surface ball = test::makeSurface(test::ball(small, 6));
  for (const double depth : { 0.01_mm, 0.5_mm, 1.0_mm })
  {
    const Contact contact = press(ball, SphereTip{ .radius = 1.0 }, { 0.0, 0.0, small - depth });
    EXPECT_NEAR(contact.depth, depth, 0.1 * small);
    EXPECT_GT(contact.normal.z(), 0.99);
  }
  const Surface sheet = test::makeSurface(test::sheet(2.0_mm, 5));
  // a sheet without end at that depth has more in common with the tool
  const double depth = press(sheet, kBallTip, { 0.0, 0.0, -3.0_mm }).depth;
  EXPECT_GT(depth, 2.0_mm);
  EXPECT_LT(depth, 3.0_mm);
}

// pushed out the nearest way, deeper than the radius: R plus the distance to the surface
TEST(ContactBadInput, ADeepStart)
{
  const Surface block = test::makeSurface(test::block({ 0.2, 0.2, 0.2 }, 20));
  for (const double depth : { 15.0_mm, 30.0_mm, 60.0_mm })
  {
    const Contact contact = press(block, kBallTip, { 1.0_mm, 2.0_mm, -depth });
    EXPECT_NEAR(contact.depth, depth, 1e-9);
    EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
    EXPECT_NEAR(contact.thickness, 0.2, 1e-6);
  }
  const Surface ball = test::makeSurface(test::ball(0.05, 10));
  for (const Tip& tip : { kBallTip, kPointedTip })
  {
    EXPECT_TRUE(usable(press(ball, tip, Eigen::Vector3d::Zero()))); // at the very middle
  }
}

// in a groove of two equal walls the push is along the bisector; between two that face each other
// there is none
TEST(ContactBadInput, TwoLobesAtOnce)
{
  const auto wall = [](double side, double gap) {
    return test::moved(test::block({ 0.04, 0.04, 0.04 }, 20), { side * (0.02 + gap), 0.0, 0.01 });
  };
  const Surface gap = test::makeSurface(merged(wall(-1.0, 6.0_mm), wall(1.0, 6.0_mm)));
  const Contact pinched = press(gap, kBallTip, { 0.0, 0.0, -20.0_mm });
  EXPECT_FALSE(pinched.touching());

  const Contact left = press(gap, kBallTip, { -2.0_mm, 0.0, -20.0_mm });
  EXPECT_NEAR(left.depth, 6.0_mm, 1e-6);
  EXPECT_GT(left.normal.x(), 0.999);

  const Surface groove =
    test::makeSurface(test::sheet(0.08, 81, [](double x, double) { return std::abs(x); }));
  const double inside = 2.0_mm; // R minus the distance of the center to both walls
  const Contact contact =
    press(groove, kBallTip, { 0.0, 0.0, std::numbers::sqrt2 * (10.0_mm - inside) - 10.0_mm });
  // more than one wall, and less than two contacts that do not feel each other, whose energies add
  // up
  EXPECT_GT(contact.depth, inside);
  EXPECT_LT(contact.depth, std::pow(2.0, 1.0 / 2.5) * inside);
  EXPECT_GT(contact.normal.z(), 0.999);
}

// points thrown about by a quarter of an edge turn some triangles over: those about them decide
// what is inside, or a depth of 3 mm would now and then be one of 17 mm
TEST(ContactBadInput, AFoldIsOutvoted)
{
  const double radius = 50.0_mm;
  test::Mesh mesh = test::ball(radius, 20);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto somewhere = [&]
  { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  for (Eigen::Vector3d& point : mesh.first)
  {
    point = radius * (point + 0.9_mm * somewhere()).normalized();
  }
  const Surface surface = test::makeSurface(mesh);
  const auto facets = surface.tree().facets();
  ASSERT_GT(std::count_if(facets.begin(), facets.end(),
              [](const Facet& facet) { return facet.normal.dot(facet.corners[0]) < 0.0; }),
    0);
  for (int i = 0; i < kPresses; ++i)
  {
    const Eigen::Vector3d out = somewhere().normalized();
    for (const Tip& tip : { kBallTip, kPointedTip })
    {
      const Contact contact = press(surface, tip, (radius - 3.0_mm) * out, -out);
      ASSERT_NEAR(contact.depth, 3.0_mm, 1.0_mm); // the sagitta of the longest edges
      ASSERT_GT(contact.normal.dot(out), 0.95);
    }
  }
}

TEST(ContactBadInput, AnOpenSheetIsPressedFromItsFrontOnly)
{
  const Surface sheet = test::makeSurface(test::sheet(0.1, 21));
  for (const Tip& tip : { kBallTip, kPointedTip })
  {
    for (const double depth : { 1.0_mm, 8.0_mm, 14.0_mm })
    {
      const Contact front = press(sheet, tip, { 0.0, 0.0, -depth });
      EXPECT_NEAR(front.depth, depth, 1e-9);
      EXPECT_NEAR(front.edgeDistance, 0.05, 1e-9);
      const Contact back = press(sheet, tip, { 0.0, 0.0, depth }, Eigen::Vector3d::UnitZ());
      EXPECT_FALSE(back.touching());
    }
  }
}

// down beside it, past its plane, and on: what is felt fades out and never jumps
TEST(ContactBadInput, BesideAnOpenSheetNoForceJumps)
{
  for (const int cells : { 10, 20 })
  {
    const Surface sheet = test::makeSurface(test::sheet(0.1, cells + 1));
    for (const double past : { 2.0_mm, 3.0_mm, 6.0_mm })
    {
      constexpr double kStep = 20.0_um;
      const auto forceAt = [&](double height) // of Hertz, up to a constant, 1 at a depth of 10 mm
      {
        const Contact contact = press(sheet, kBallTip, { 0.05 + past, 1.0_mm, height });
        EXPECT_LE(contact.slope, 2.001) << past << " " << height;
        return contact.slope * std::pow(contact.depth / 10.0_mm, 1.5);
      };
      double last = forceAt(0.0);
      for (double height = -kStep; height > -40.0_mm; height -= kStep)
      {
        const double force = forceAt(height);
        EXPECT_NEAR(force, last, 0.1) << past << " " << height;
        last = force;
      }
      EXPECT_LT(last, 0.01) << past;
    }
  }
}

TEST(ContactBadInput, NoPoseGivesWhatIsNotANumber)
{
  const Surface surfaces[] = { test::makeSurface(test::ball(20.0_mm, 4)),
    test::makeSurface(test::sheet(50.0_mm, 4)),
    test::makeSurface(merged(test::block({ 0.02, 0.02, 0.02 }, 1),
      test::moved(test::ball(5.0_mm, 3), { 0.0, 0.0, 8.0_mm }))),
    test::makeSurface({ { { 0, 0, 0 }, { 1e-3, 0, 0 }, { 0, 1e-12, 0 } }, { { 0, 1, 2 } } }) };
  const Tip tips[] = { kBallTip, kPointedTip, PunchTip{ .radius = 5.0_mm },
    BluntConeTip{ .halfAngle = 30.0_deg, .tipRadius = 1.0_mm, .baseRadius = 8.0_mm },
    ConeTip{ .halfAngle = 89.0_deg, .baseRadius = 1.0 }, SphereTip{ .radius = 1.0 },
    SphereTip{ .radius = 0.1_mm } };
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-12.0, 2.0);
  for (int i = 0; i < kPresses; ++i)
  {
    Eigen::Vector3d apex(normal(random), normal(random), normal(random));
    apex *= std::pow(10.0, exponent(random));
    for (int k = 0; k < 3; ++k)
    {
      apex[k] = random() % 4 == 0 ? 0.0 : apex[k];
    }
    const Eigen::Vector3d axis = random() % 2 == 0
      ? Eigen::Vector3d(-Eigen::Vector3d::UnitZ())
      : Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Tip& tip = tips[random() % std::size(tips)];
    for (const Surface& surface : surfaces)
    {
      for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
      {
        ASSERT_TRUE(usable(press(surface, tip, apex, axis, rule)))
          << apex.transpose() << " axis " << axis.transpose() << " tip " << tip.index();
      }
    }
  }
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    EXPECT_FALSE(press(surfaces[0], kBallTip, { bad, 0.0, 0.0 }).touching());
    EXPECT_FALSE(press(surfaces[0], kBallTip, { 0.0, 0.0, 0.0 }, { 0.0, bad, 1.0 }).touching());
  }
}

} // namespace
} // namespace palp
