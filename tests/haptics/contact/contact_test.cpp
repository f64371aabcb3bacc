#include "haptics/contact/find_contact.h"

#include "haptics/surface/closest_point.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Tip kSphere = SphereTip{ .radius = 10.0_mm };
const Tip kCone = ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm };

ToolPose at(const Eigen::Vector3d& apex, const Eigen::Vector3d& axis = -Eigen::Vector3d::UnitZ())
{
  return { .apex = apex, .axis = axis, .velocity = Eigen::Vector3d::Zero() };
}

// a tip given by so many of its points, as a file gives it
Tip sampled(const Tip& tip, double upTo)
{
  constexpr int kCount = 21;
  std::vector<Profile::Point> points;
  for (int i = 0; i < kCount; ++i)
  {
    const double radius = upTo * i / (kCount - 1);
    points.push_back({ radius, tipHeight(tip, radius) });
  }
  return ProfileTip{ std::make_shared<const Profile>(std::move(points)) };
}

// each tip, straight down on a flat face: the depth is that of the apex, the normal the face's
class OnABlock : public ::testing::TestWithParam<std::tuple<Tip, double>>
{
};
INSTANTIATE_TEST_SUITE_P(Tips, OnABlock,
  ::testing::Combine(
    ::testing::Values(kSphere, kCone, Tip{ PunchTip{ .radius = 5.0_mm } },
      Tip{ TruncatedConeTip{ .halfAngle = 45.0_deg, .flatRadius = 2.0_mm, .baseRadius = 8.0_mm } },
      Tip{ BluntConeTip{ .halfAngle = 45.0_deg, .tipRadius = 2.0_mm, .baseRadius = 8.0_mm } },
      Tip{ ParaboloidTip{ .radius = 5.0_mm } }, sampled(kSphere, 8.0_mm), sampled(kCone, 8.0_mm)),
    ::testing::Values(1e-9, 0.1_mm, 1.0_mm, 5.0_mm, 9.0_mm, 12.0_mm)));

// a face is flat whatever triangles it has, up to its edges
TEST(FindContact, BesideAnEdgeDoesNotDependOnTheTriangles)
{
  const Eigen::Vector3d size(100.0_mm, 100.0_mm, 50.0_mm);
  const Surface fine = test::makeSurface(test::block(size, 100));
  EXPECT_EQ(fine.facetLength(), 0.0);
  test::Sampled samples(4);
  for (const int cells : { 1, 12, 25, 33 })
  {
    const Surface coarse = test::makeSurface(test::block(size, cells));
    for (const double place : { 2.0_mm, 4.0_mm, 6.0_mm })
    {
      for (const double depth : { 1.0_mm, 2.0_mm, 4.0_mm })
      {
        if (!samples.takes())
        {
          continue;
        }
        const ToolPose pose = at({ 0.5 * size.x() - place, 0.0, -depth });
        const double known = findContact(fine, kSphere, pose, ContactRule::Exact).depth;
        EXPECT_NEAR(known, depth, 0.04 * depth);
        EXPECT_NEAR(
          findContact(coarse, kSphere, pose, ContactRule::Exact).depth, known, 0.01 * known)
          << cells << ' ' << place << ' ' << depth;
      }
    }
  }
}

TEST_P(OnABlock, DepthIsThatOfTheApex)
{
  const auto& [tip, depth] = GetParam();
  const Surface block = test::makeSurface(test::block({ 100.0_mm, 100.0_mm, 50.0_mm }, 8));
  const Contact contact =
    findContact(block, tip, at({ 3.0_mm, 1.3_mm, -depth }), ContactRule::Exact);
  EXPECT_NEAR(contact.depth, depth, 1e-12);
  EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(contact.center.z(), 0.0, 1e-12);
  EXPECT_NEAR(contact.surfaceCurvature, 0.0, 1e-3);
  EXPECT_NEAR(contact.tilt, 0.0, 1e-6);
}

// a round end touches beside its apex
TEST(Contact, ATiltedProfileIsMetAsTheTipThatItSamples)
{
  const Surface block = test::makeSurface(test::block({ 100.0_mm, 100.0_mm, 50.0_mm }, 8));
  for (const Tip& tip : { kSphere, Tip{ ParaboloidTip{ .radius = 5.0_mm } }, kCone })
  {
    for (const double tilt : { 5.0_deg, 15.0_deg, 30.0_deg })
    {
      const ToolPose pose =
        at({ 3.0_mm, 1.3_mm, -0.5_mm }, { std::sin(tilt), 0.0, -std::cos(tilt) });
      const double expected = findContact(block, tip, pose, ContactRule::Exact).depth;
      const double found = findContact(block, sampled(tip, 5.0_mm), pose, ContactRule::Exact).depth;
      EXPECT_NEAR(found, expected, 0.03 * expected) << tip.index() << " tilted by " << tilt;
    }
  }
}

// none on a plane; on a ridge half of what its sides turn; on a ball that of a disc as wide as the
// contact: r / (sqrt(2) R0)
TEST(Contact, TellsHowFarTheNormalsBelowTheToolDiffer)
{
  const auto spreadOn = [](test::Mesh mesh, const Eigen::Vector3d& apex, ContactRule rule)
  {
    const Contact contact = findContact(test::makeSurface(std::move(mesh)), kCone, at(apex), rule);
    EXPECT_TRUE(contact.touching());
    return contact.normalSpread;
  };
  const auto roof = [](double x, double) { return -std::tan(20.0_deg) * std::abs(x); };
  for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
  {
    const double flat =
      spreadOn(test::block({ 0.1, 0.1, 0.05 }, 40), { 3.0_mm, 1.3_mm, -4.0_mm }, rule);
    EXPECT_NEAR(flat, 0.0, 1e-6);
    const double ridge = spreadOn(test::sheet(0.1, 201, roof), { 0.0, 1.3_mm, -4.0_mm }, rule);
    EXPECT_NEAR(ridge, 20.0_deg, rule == ContactRule::Exact ? 0.1_deg : 4.0_deg);
  }
  const double circle = 2.0 / std::numbers::pi * 3.0; // of contact, of a cone of 45 degrees [mm]
  const double dome = spreadOn(test::ball(50.0_mm, 60), { 0.0, 0.0, 47.0_mm }, ContactRule::Exact);
  EXPECT_NEAR(dome, circle / 50.0 / std::sqrt(2.0), 0.2_deg);
}

TEST(Contact, ApartIsNoContact)
{
  const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 4));
  for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
  {
    const Contact contact = findContact(block, kSphere, at({ 0.0, 0.0, 1e-6 }), rule);
    EXPECT_FALSE(contact.touching());
    EXPECT_EQ(contact.triangle, -1);
    EXPECT_EQ(contact.normal, Eigen::Vector3d::Zero());
  }
}

// straight above the diagonal of a side of the mesh and its crossings, where a middle lies upon
// sides
TEST(Contact, OnTheSidesOfTrianglesIsAsBesideThem)
{
  for (const int n : { 1, 2, 3, 4, 7 })
  {
    const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, n));
    for (int i = -60; i <= 60; i += test::kSanitized ? 6 : 1)
    {
      const double along = i * 0.5_mm;
      for (const Eigen::Vector3d& place :
        { Eigen::Vector3d(along, along, 0.0), Eigen::Vector3d(along, -along, 0.0),
          Eigen::Vector3d(along, 0.0, 0.0), Eigen::Vector3d(along, 0.1 / n, 0.0) })
      {
        if (std::abs(place.y()) > 35.0_mm)
        {
          continue; // near the rim
        }
        const Contact contact = findContact(block, kSphere,
          at(place - 2.0_mm * Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ()),
          ContactRule::Exact);
        EXPECT_NEAR(contact.depth, 2.0_mm, 1e-9) << n << " at " << place.transpose();
        EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
      }
    }
  }
}

// as a ball only just meets a corner or an edge, rounding alone says how much of it is within
// the center of its nose within the surface, where no triangle is seen from either side
TEST(Contact, PressedByItsRadiusASphereIsAsDeepAsThat)
{
  const Surface surface = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 20));
  for (const double x : { 0.0, 2.5_mm, 1.3_mm, 20.0_mm })
  {
    for (const double y : { 0.0, 2.5_mm, 0.7_mm })
    {
      for (const double off : { 0.0, 1e-18, -1e-18, 1e-15, -1e-12, 1e-10, -1e-10, 1e-6, -1e-6 })
      {
        const ToolPose pose{ .apex = { x, y, -10.0_mm + off }, .axis = -Eigen::Vector3d::UnitZ() };
        const Contact contact =
          findContact(surface, SphereTip{ 10.0_mm }, pose, ContactRule::Exact);
        EXPECT_NEAR(contact.depth, 10.0_mm - off, 1e-9) << x << ' ' << y << ' ' << off;
        EXPECT_NEAR(contact.slope, 1.0, 1e-5) << x << ' ' << y << ' ' << off;
      }
    }
  }
}

TEST(Contact, ACornerOrAnEdgeThatIsOnlyJustMetIsFeltAsThat)
{
  const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 10));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.01, 1.0);
  for (int i = 0; i < 300; ++i)
  {
    const bool isCorner = i % 2 == 0;
    const Eigen::Vector3d place(0.05, isCorner ? 0.05 : 0.1 * part(random) - 0.05, 0.0);
    const Eigen::Vector3d out =
      Eigen::Vector3d(part(random), isCorner ? part(random) : 0.0, part(random)).normalized();
    for (const double within : { -1e-17, 0.0, 1e-17, 1e-14, 1e-11, 1e-8, 1e-6 })
    {
      // the apex of a ball whose middle is over the place
      const Contact contact = findContact(block, kSphere,
        at(place + (10.0_mm - within) * out - 10.0_mm * out, -out), ContactRule::Exact);
      EXPECT_LE(contact.depth, 2.0 * std::max(0.0, within) + 1e-12) << i << ' ' << within;
    }
  }
}

// Sphere on a sphere: R minus the distance of the centers beyond R0, whatever the side it comes
// from. An inscribed mesh lies below by at most its sagitta.
TEST(Contact, OnASphereTheDepthIsThatOfTheSphere)
{
  const double bodyRadius = 50.0_mm;
  const Surface ball = test::makeSurface(test::ball(bodyRadius, 60));
  const double sagitta = ball.edgeLength() * ball.edgeLength() / (3.0 * bodyRadius);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i)
  {
    const Eigen::Vector3d out =
      Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    for (const double depth : { 0.5_mm, 2.0_mm, 5.0_mm, 9.9_mm, 11.0_mm })
    {
      const Contact contact =
        findContact(ball, kSphere, at((bodyRadius - depth) * out, -out), ContactRule::Exact);
      EXPECT_NEAR(contact.depth, depth, sagitta);
      EXPECT_LT((contact.normal - out).norm(), 2e-3);
      EXPECT_NEAR(contact.surfaceCurvature, 1.0 / bodyRadius, 0.25 / bodyRadius);
      EXPECT_NEAR(
        findContact(ball, kCone, at((bodyRadius - depth) * out, -out), ContactRule::Exact).depth,
        depth, sagitta);
    }
  }
}

TEST(Contact, ASphereDoesNotCareForItsAxis)
{
  const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 10));
  const Eigen::Vector3d center(0.0, 0.0, 7.0_mm);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 0.4, -1.0).normalized();
  const Contact contact =
    findContact(block, kSphere, at(center + 10.0_mm * axis, axis), ContactRule::Exact);
  EXPECT_NEAR(contact.depth, 3.0_mm, 1e-12);
  EXPECT_NEAR(contact.tilt, std::acos(-axis.z()), 1e-9);
}

// first touch where the nearest point of the mesh is: at a corner, an edge or a face
TEST(Contact, BeginsWhereTheMeshIsTouched)
{
  const Surface ball = test::makeSurface(test::ball(50.0_mm, 10));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d out =
      Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    // bring the sphere in along `out` until its center is R from the mesh
    double far = 70.0_mm;
    double near = 50.0_mm;
    while (far - near > 1e-12)
    {
      const double middle = 0.5 * (far + near);
      (findClosestPoint(ball, middle * out, 1.0).distance < 10.0_mm ? near : far) = middle;
    }
    const auto depthAt = [&](double inward)
    {
      return findContact(
        ball, kSphere, at((far - inward - 10.0_mm) * out, -out), ContactRule::Exact)
        .depth;
    };
    EXPECT_EQ(depthAt(-1.0_um), 0.0);
    EXPECT_GT(depthAt(1.0_um), 0.0);
    EXPECT_NEAR(depthAt(1.0_um), 1.0_um, 1.0_um);
  }
}

TEST(Contact, OnALobeTheFarSideDoesNotCount)
{
  const Surface plate = test::makeSurface(test::block({ 0.1, 0.1, 4.0_mm }, 40));
  for (const double depth : { 0.5_mm, 3.0_mm, 6.0_mm })
  {
    const Contact contact =
      findContact(plate, kSphere, at({ 0.0, 0.0, -depth }), ContactRule::Exact);
    EXPECT_NEAR(contact.depth, depth, 1e-9);
    EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  }
}

TEST(Contact, PaperRuleSeesOnlyMeshPoints)
{
  const Surface coarse = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 5)); // 20 mm cells
  const Eigen::Vector3d betweenPoints(0.0, 0.0, -1.0_mm);
  EXPECT_FALSE(findContact(coarse, kSphere, at(betweenPoints), ContactRule::Paper).touching());
  const Surface fine = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 100));
  const Contact contact = findContact(fine, kSphere, at(betweenPoints), ContactRule::Paper);
  EXPECT_NEAR(contact.depth, 1.0_mm, 1e-12);
  EXPECT_LT((contact.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

// a second wall, across from the first or beside it, does not make a tool deeper than its apex is,
// nor less deep as long as all of it that is in the body is between the two
TEST(Contact, ASecondWallAddsNothingToTheDepth)
{
  const double half = 4.0_mm;
  const Surface slab = test::makeSurface(test::block({ 120.0_mm, 120.0_mm, 2.0 * half }, 24));
  for (const Tip& tip :
    { Tip{ ConeTip{ 15.0_deg, 10.0_mm } }, Tip{ ConeTip{ 30.0_deg, 10.0_mm } },
      Tip{ ConeTip{ 60.0_deg, 10.0_mm } }, Tip{ PunchTip{ 4.0_mm } }, Tip{ PunchTip{ 10.0_mm } } })
  {
    for (const double inward : { 30.0_mm, 4.0_mm, 3.0_mm, 2.2_mm, 1.0_mm, 0.5_mm })
    {
      for (double depth = 0.1_mm; depth < 2.0 * half; depth += 0.1_mm)
      {
        const Eigen::Vector3d apex(60.0_mm - inward, 1.3_mm, -depth);
        const double reached = findContact(
          slab, tip, { .apex = apex, .axis = -Eigen::Vector3d::UnitZ() }, ContactRule::Exact)
                                 .depth;
        const auto* cone = std::get_if<ConeTip>(&tip);
        const double wide = cone != nullptr ? depth * std::tan(cone->halfAngle) : flatRadius(tip);
        EXPECT_LE(reached, depth * (1.0 + 1e-9)) << tip.index() << " at " << apex.transpose();
        if (1.01 * wide < inward) // its corners
        {
          EXPECT_NEAR(reached, depth, 1e-9) << tip.index() << " at " << apex.transpose();
        }
      }
    }
  }
}

} // namespace
} // namespace palp
