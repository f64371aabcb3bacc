#include "haptics/surface/shape_field.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/force/validity.h"
#include "haptics/surface/surface.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <tuple>

namespace palp
{
namespace
{

using namespace units::literals;

LocalShape shapeAt(const Surface& surface, const Eigen::Vector3d& position, double radius,
  const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ())
{
  return surface.shape()(position, std::max(radius, surface.shape().finest()), normal, 0.0);
}

TEST(ShapeField, OfASphereIsOneOverItsRadius)
{
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (const double radius : { 30.0_mm, 100.0_mm })
  {
    for (const int n : { 8, 30 })
    {
      const Surface ball = test::makeSurface(test::ball(radius, n));
      for (int i = 0; i < 100; ++i)
      {
        const Eigen::Vector3d out =
          Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        const LocalShape shape = shapeAt(ball, radius * out, 0.3 * radius, out);
        EXPECT_NEAR(shape.meanCurvature, 1.0 / radius, 0.08 / radius);
        EXPECT_LT(shape.curvatureSpread, 0.08 / radius);
        EXPECT_NEAR(shape.thickness, 2.0 * radius, 0.06 * radius);
        EXPECT_EQ(ball.shape().edgeDistance(radius * out), std::numeric_limits<double>::infinity());
      }
    }
  }
}

// what is through the ring from its outside, and whether the open middle lets that wall bend
TEST(ShapeField, AGapInTheBodyIsToldAsAHollowIs)
{
  for (const auto& [middle, radius, isTold] : { std::tuple(40.0_mm, 15.0_mm, 1.0),
         std::tuple(22.0_mm, 18.0_mm, 0.0), std::tuple(30.0_mm, 20.0_mm, 0.0) })
  {
    const Surface body = test::makeSurface(test::torus(middle, radius, 96, 48));
    const Eigen::Vector3d out = Eigen::Vector3d::UnitX();
    const LocalShape shape = shapeAt(body, (middle + radius) * out, 0.3 * radius, out);
    EXPECT_NEAR(shape.thickness, 2.0 * radius, 0.1 * radius);
    EXPECT_NEAR(shape.hollow, isTold, 0.2) << middle;
  }
}

// a bowl on its rim, outer radius 50 mm, pressed on its outside: no law knows how its wall is held
TEST(ShapeField, AWallThatIsFreeBehindIsToldAsAHollowIs)
{
  for (const auto& [wall, isTold] : { std::pair(5.0_mm, 1.0), { 12.0_mm, 1.0 }, { 30.0_mm, 0.0 } })
  {
    test::Mesh bowl;
    constexpr int kAround = 96;
    constexpr int kDown = 30; // from the pole to the rim, and back up within
    const double outer = 50.0_mm;
    for (int j = 0; j < 2 * kDown; ++j)
    {
      const double radius = j < kDown ? outer : outer - wall;
      const double angle =
        0.5 * std::numbers::pi * (j < kDown ? j + 1 : 2 * kDown - j) / kDown; // from the axis
      for (int i = 0; i < kAround; ++i)
      {
        const double u = 2.0 * std::numbers::pi * i / kAround;
        bowl.first.emplace_back(radius * std::sin(angle) * std::cos(u),
          radius * std::sin(angle) * std::sin(u), radius * std::cos(angle));
      }
    }
    const auto point = [](int i, int j) { return j * kAround + i % kAround; };
    const int top = static_cast<int>(bowl.first.size());
    bowl.first.emplace_back(0.0, 0.0, outer);
    bowl.first.emplace_back(0.0, 0.0, outer - wall);
    for (int i = 0; i < kAround; ++i)
    {
      bowl.second.push_back({ top, point(i, 0), point(i + 1, 0) });
      bowl.second.push_back({ top + 1, point(i + 1, 2 * kDown - 1), point(i, 2 * kDown - 1) });
      for (int j = 0; j + 1 < 2 * kDown; ++j)
      {
        bowl.second.push_back({ point(i, j), point(i, j + 1), point(i + 1, j + 1) });
        bowl.second.push_back({ point(i, j), point(i + 1, j + 1), point(i + 1, j) });
      }
    }
    const Surface body = test::makeSurface(bowl);
    ASSERT_TRUE(body.closed());
    for (const double angle : { 0.0, 0.4 })
    {
      const Eigen::Vector3d out(std::sin(angle), 0.0, std::cos(angle));
      const LocalShape shape = shapeAt(body, outer * out, 10.0_mm, out);
      EXPECT_NEAR(shape.thickness, wall, 0.05 * wall);
      EXPECT_NEAR(shape.hollow, isTold, 0.01) << wall << " m, " << angle;
    }
  }
}

// radius of a hollow, where its center is, and at which pole the wall above it bends
TEST(ShapeField, AHollowIsFilledAndToldWhereItIsNearAndLarge)
{
  struct Hollow
  {
    double radius;
    double z;
    double above; // part of the surface there at the upper pole
    double below; // and at the lower one
  };
  for (const auto& [radius, z, above, below] : { Hollow{ 40.0_mm, 0.0, 1.0, 1.0 },
         Hollow{ 5.0_mm, 0.0, 0.0, 0.0 }, Hollow{ 10.0_mm, 35.0_mm, 1.0, 0.0 } })
  {
    test::Mesh mesh = test::ball(50.0_mm, 24);
    const auto [points, triangles] = test::ball(radius, 24);
    const auto first = static_cast<int>(mesh.first.size());
    for (const Eigen::Vector3d& point : points)
    {
      mesh.first.push_back(point + z * Eigen::Vector3d::UnitZ());
    }
    for (const auto& [a, b, c] : triangles)
    {
      mesh.second.push_back({ first + a, first + c, first + b });
    }
    const Surface body = test::makeSurface(mesh);
    const Surface solid = test::makeSurface(test::ball(50.0_mm, 24));
    for (const double pole : { 1.0, -1.0 })
    {
      const Eigen::Vector3d out = pole * Eigen::Vector3d::UnitZ();
      const LocalShape shape = shapeAt(body, 50.0_mm * out, 4.0_mm, out);
      EXPECT_NEAR(shape.hollow, pole > 0.0 ? above : below, 0.1) << radius << ' ' << z;
      EXPECT_NEAR(shape.thickness, shapeAt(solid, 50.0_mm * out, 4.0_mm, out).thickness, 2.0_mm);
    }
    const Contact contact = findContact(body, SphereTip{ 5.0_mm },
      { .apex = { 0.0, 0.0, 49.0_mm }, .axis = -Eigen::Vector3d::UnitZ() }, ContactRule::Exact);
    const Rules rules =
      Validity(ForceLaw(SphereTip{ 5.0_mm }, { 50.0_kPa, 0.33 }))(contactGeometryOf(contact));
    EXPECT_EQ(rules.back().holds(), above == 0.0) << rules.back().name;
  }
}

TEST(ShapeField, OfAFaceIsFlatHoweverItIsCut)
{
  for (const int n : { 1, 2, 7, 30 })
  {
    const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, n));
    const LocalShape shape = shapeAt(block, { 4.0_mm, 3.0_mm, 0.0 }, 8.0_mm);
    EXPECT_NEAR(shape.meanCurvature, 0.0, 1e-6) << n;
    EXPECT_NEAR(shape.curvatureSpread, 0.0, 1e-6) << n;
    EXPECT_NEAR(shape.thickness, 50.0_mm, 0.5_mm) << n;
  }
}

// in a ball of two edges, however the torus is turned in the file
TEST(ShapeField, OfATorusIsThatOfItsCirclesHoweverItIsTurned)
{
  constexpr double kRing = 50.0_mm;
  constexpr double kTube = 20.0_mm;
  const test::Mesh torus = test::torus(kRing, kTube, 220, 63); // edges of 2 mm outside
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < (test::kSanitized ? 1 : 8); ++i)
  {
    const Eigen::Matrix3d turn =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized()
        .toRotationMatrix();
    test::Mesh turned = torus;
    for (Eigen::Vector3d& point : turned.first)
    {
      point = turn * point;
    }
    const Surface surface = test::makeSurface(std::move(turned));
    for (int k = 0; k < 100; ++k)
    {
      const double around = 0.3 + 0.0628 * k;
      const double along = 0.7 * k;
      const Eigen::Vector3d spoke(std::cos(along), std::sin(along), 0.0);
      const Eigen::Vector3d out =
        std::cos(around) * spoke + std::sin(around) * Eigen::Vector3d::UnitZ();
      const double across = std::cos(around) / (kRing + kTube * std::cos(around));
      const LocalShape shape =
        shapeAt(surface, turn * (kRing * spoke + kTube * out), 0.0, turn * out);
      EXPECT_NEAR(shape.meanCurvature, 0.5 * (1.0 / kTube + across), 0.02 / kTube);
      EXPECT_NEAR(shape.curvatureSpread, 0.5 * (1.0 / kTube - across), 0.02 / kTube);
    }
  }
}

// z = -(a x^2 + b y^2) / 2 has the principal curvatures a and b at its middle
TEST(ShapeField, OfAQuadricIsThatOfItsAxes)
{
  for (const auto& [a, b] :
    { std::pair(20.0, 0.0), std::pair(20.0, 10.0), std::pair(15.0, -15.0), std::pair(-12.0, -6.0) })
  {
    const Surface sheet = test::makeSurface(test::sheet(
      0.02, 41, [a = a, b = b](double x, double y) { return -0.5 * (a * x * x + b * y * y); }));
    const LocalShape shape = shapeAt(sheet, { 0.3_mm, 0.2_mm, 0.0 }, 3.0_mm);
    EXPECT_NEAR(shape.meanCurvature, 0.5 * (a + b), 0.3);
    EXPECT_NEAR(shape.curvatureSpread, 0.5 * std::abs(a - b), 0.3);
    EXPECT_EQ(shape.thickness, std::numeric_limits<double>::infinity());
  }
}

// a crease turns the surface by its angle: the mean over a disc of radius r with the weight
// (1 - t^2)^2 is angle (16 / 15) r / (pi r^2 / 3), across the crease
TEST(ShapeField, OfACreaseIsItsAngleOverTheContact)
{
  for (const double angle : { -30.0_deg, 20.0_deg })
  {
    const double slope = std::tan(0.5 * angle);
    const Surface roof = test::makeSurface(
      test::sheet(0.1, 81, [slope](double x, double) { return -slope * std::abs(x); }));
    const double radius = 10.0_mm;
    const LocalShape shape = shapeAt(roof, Eigen::Vector3d::Zero(), radius);
    const double across = angle * 16.0 / 15.0 / (M_PI / 3.0 * radius);
    EXPECT_NEAR(shape.meanCurvature, 0.5 * across, 0.05 * std::abs(across));
    EXPECT_NEAR(shape.curvatureSpread, 0.5 * std::abs(across), 0.05 * std::abs(across));
  }
}

// along a cut over each kind of body everything changes with the way, never at once
TEST(ShapeField, ChangesContinuously)
{
  const double step = 1.0_um;
  const auto wavy = [](double x, double y)
  { return 3.0_mm * std::sin(200.0 * x) * std::cos(150.0 * y); };
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const auto& [surface, top] :
    { std::pair(test::makeSurface(test::block({ 60.0_mm, 40.0_mm, 20.0_mm }, 1)), 0.0),
      std::pair(test::makeSurface(test::block({ 60.0_mm, 40.0_mm, 20.0_mm }, 9)), 0.0),
      std::pair(test::makeSurface(test::ball(30.0_mm, 6)), 30.0_mm),
      std::pair(test::makeSurface(test::sheet(60.0_mm, 12, wavy)), 0.0) })
  {
    for (int i = 0; i < (test::kSanitized ? 2 : 10); ++i)
    {
      Eigen::Vector3d at(12.0_mm * part(random), 12.0_mm * part(random), top);
      const Eigen::Vector3d direction =
        Eigen::Vector3d(part(random), part(random), 0.0).normalized();
      const double radius = surface.shape().finest();
      const double most = 60.0 * step / radius; // [rad] within the radius
      LocalShape last = shapeAt(surface, at, 0.0);
      for (int k = 0; k < 1000; ++k)
      {
        at += step * direction;
        const LocalShape now = shapeAt(surface, at, 0.0);
        ASSERT_LE(std::abs(now.meanCurvature - last.meanCurvature), most / radius);
        ASSERT_LE(std::abs(now.curvatureSpread - last.curvatureSpread), most / radius);
        ASSERT_LE(std::abs(radius / now.thickness - radius / last.thickness), most);
        last = now;
      }
    }
  }
}

// two levels of the back, 15 and 40 mm below: the thickness passes from one to the other over the
// width of the contact
TEST(ShapeField, ThicknessPassesOverAStepOfTheBackSmoothly)
{
  const Surface stepped = test::makeSurface(test::cubeMap(40,
    [](const Eigen::Vector3d& p)
    {
      const double deep = p.x() > 0.0 ? 40.0_mm : 15.0_mm;
      return Eigen::Vector3d(60.0_mm * p.x(), 40.0_mm * p.y(), 0.5 * deep * (p.z() - 1.0));
    }));
  double last = shapeAt(stepped, { -20.0_mm, 0.0, 0.0 }, 8.0_mm).thickness;
  EXPECT_NEAR(last, 15.0_mm, 0.5_mm);
  for (double x = -20.0_mm; x < 20.0_mm; x += 0.02_mm)
  {
    const double now = shapeAt(stepped, { x, 0.0, 0.0 }, 8.0_mm).thickness;
    EXPECT_LE(std::abs(now - last), 0.1_mm);
    last = now;
  }
  EXPECT_NEAR(last, 40.0_mm, 1.0_mm);
}

TEST(ShapeField, DoesNotAllocate)
{
  const Surface ball = test::makeSurface(test::ball(30.0_mm, 10));
  const test::AllocationGuard guard;
  const LocalShape shape = shapeAt(ball, { 0.0, 0.0, 30.0_mm }, 8.0_mm);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(shape.meanCurvature, 0.0);
}

} // namespace
} // namespace palp
