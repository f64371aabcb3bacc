#include "haptics/contact/body_rules.h"
#include "haptics/units.h"
#include "tests/haptics/contact/round_press.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;
using test::pressed;

// By finite elements plates of 120 mm that are held at one end are 200, 27 and 7 times softer than
// the law says, of 6, 12 and 20 mm, and a tongue 24 to 30 mm thick twice to four times; on their
// backs they are not, which has to be said.
TEST(LobeRule, SeesPlatesInAnyAttitudeUnlessTheyLieOnSomething)
{
  const Eigen::Matrix3d turned =
    Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& frame : { Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turned })
  {
    const auto holds = [&](double side, double thickness, Base base = Base::Unset)
    {
      test::Mesh mesh = test::block({ side, side, thickness }, 20);
      for (Vector3d& point : mesh.first)
      {
        point = frame * point;
      }
      const Surface surface = test::makeSurface(std::move(mesh));
      const Contact contact =
        pressed(surface, Vector3d::Zero(), 1.0_mm, frame * -Vector3d::UnitZ());
      EXPECT_TRUE(contact.touching());
      const Rule rule = lobeRule(surface, contact, 3.2_mm, base);
      // how it would give way is never known before its base is
      EXPECT_EQ(rule.fraction() >= Rule::kDoubtful, base == Base::Unset);
      return rule.holds();
    };
    for (const double thickness : { 6.0_mm, 12.0_mm, 20.0_mm, 30.0_mm })
    {
      EXPECT_FALSE(holds(120.0_mm, thickness)) << thickness;
      EXPECT_TRUE(holds(120.0_mm, thickness, Base::Bonded)) << thickness;
      EXPECT_TRUE(holds(120.0_mm, thickness, Base::Slip)) << thickness;
    }
    EXPECT_FALSE(holds(80.0_mm, 30.0_mm));
    EXPECT_TRUE(!frame.isIdentity() || holds(100.0_mm, 50.0_mm));
  }
  const Surface ball = test::makeSurface(test::ball(40.0_mm, 20));
  const Contact contact = pressed(ball, { 0.0, 0.0, 40.0_mm }, 1.0_mm, -Vector3d::UnitZ());
  EXPECT_TRUE(lobeRule(ball, contact, 2.8_mm, Base::Unset).holds());
}

// A block of 100 x 100 x 50 mm, and the press of its top at a place right of its left edge. The
// face below that is slant by an angle to the top from one height below it to another.
std::pair<Surface, Contact> slantBlock(
  double angle, double place, double from = 0.0, double to = 50.0_mm)
{
  const Vector3d size(100.0_mm, 100.0_mm, 50.0_mm);
  test::Mesh mesh = test::block(size, 20);
  for (Vector3d& point : mesh.first)
  {
    const double below = std::clamp(-point.z(), from, to) - from;
    point.x() += below / std::tan(angle) * (0.5 - point.x() / size.x());
  }
  Surface surface = test::makeSurface(std::move(mesh));
  const Contact contact =
    pressed(surface, { place - 0.5 * size.x(), 0.0, 0.0 }, 1.0_mm, -Vector3d::UnitZ());
  return { std::move(surface), contact };
}

// What the law is over finite elements with contact, bonded 50 mm below, 0.5, 1.5 and 3.5 mm deep
// (B-bar, by another program).
TEST(LobeRule, SeesAWedgeWhereItYieldsMoreThanAHandNotices)
{
  struct Case
  {
    double angle;                 // [rad]
    double place;                 // [m]
    std::array<double, 3> excess; // of the law
  };
  for (const Case& one : { Case{ 45.0_deg, 45.0_mm, { 0.128, 0.210, 0.307 } },
         Case{ 45.0_deg, 58.0_mm, { 0.049, 0.075, 0.096 } },
         Case{ 60.0_deg, 28.0_mm, { 0.119, 0.193, 0.279 } },
         Case{ 60.0_deg, 40.0_mm, { 0.050, 0.074, 0.094 } },
         Case{ 75.0_deg, 20.0_mm, { 0.093, 0.144, 0.200 } },
         Case{ 75.0_deg, 32.0_mm, { 0.042, 0.057, 0.067 } },
         Case{ 90.0_deg, 28.0_mm, { 0.034, 0.041, 0.044 } } })
  {
    const auto [surface, contact] = slantBlock(one.angle, one.place);
    for (std::size_t i = 0; i < one.excess.size(); ++i)
    {
      const double radius = std::array{ 2.25_mm, 3.88_mm, 5.78_mm }.at(i);
      const Rule rule = lobeRule(surface, contact, radius, Base::Unset);
      EXPECT_TRUE(rule.holds() || one.excess.at(i) > 0.07) << one.angle << ' ' << i;
      EXPECT_FALSE(rule.holds() && one.excess.at(i) > 0.08) << one.angle << ' ' << i;
      // the slant face may be what lies on something
      const Rule onBase = lobeRule(surface, contact, radius, Base::Bonded);
      EXPECT_TRUE(onBase.holds() && (rule.holds() || onBase.fraction() >= Rule::kDoubtful));
    }
  }
}

// By our elements, 2 mm deep, the law is 26, 25 and 16 % too stiff where a nose of 5 and 3 mm is
// cut off a wedge, and 3 % beside an edge that is undercut for 2 mm.
TEST(LobeRule, SeesAWedgeWithoutItsEdgeAndNoneBesideAnUndercut)
{
  const auto holds = [](double angle, double place, double from, double to)
  {
    const auto [surface, contact] = slantBlock(angle, place, from, to);
    return lobeRule(surface, contact, 4.4_mm, Base::Unset).holds();
  };
  EXPECT_FALSE(holds(45.0_deg, 35.0_mm, 5.0_mm, 50.0_mm));
  EXPECT_FALSE(holds(60.0_deg, 23.3_mm, 3.0_mm, 50.0_mm));
  EXPECT_FALSE(holds(60.0_deg, 28.3_mm, 3.0_mm, 50.0_mm));
  EXPECT_TRUE(holds(60.0_deg, 30.0_mm, 0.0, 2.5_mm));
  EXPECT_TRUE(holds(45.0_deg, 35.0_mm, 0.0, 7.5_mm));
}

// By finite elements (B-bar) a column of 40 mm that stands 120 mm high is 1.33 and 1.44 times
// softer at 0.5 and 1 mm than the law says, and a cube of 60 mm that is held at its side 1.38 times
// at 3.
TEST(LobeRule, SeesWhatIsHighAndSlimWhateverItStandsOn)
{
  struct Case
  {
    Vector3d size; // [m]
    double radius; // of the contact [m]
    bool holds;
  };
  for (const Case& one : { Case{ { 40.0_mm, 40.0_mm, 120.0_mm }, 2.2_mm, false },
         Case{ { 40.0_mm, 40.0_mm, 120.0_mm }, 3.2_mm, false },
         Case{ { 60.0_mm, 60.0_mm, 60.0_mm }, 5.5_mm, false },
         Case{ { 100.0_mm, 100.0_mm, 50.0_mm }, 9.0_mm, true },
         Case{ { 100.0_mm, 100.0_mm, 20.0_mm }, 9.0_mm, true } })
  {
    const Surface surface = test::makeSurface(test::block(one.size, 20));
    const Contact contact = pressed(surface, Vector3d::Zero(), 1.0_mm, -Vector3d::UnitZ());
    EXPECT_EQ(lobeRule(surface, contact, one.radius, Base::Bonded).holds(), one.holds)
      << one.size.transpose();
  }
}

// A block of 100 x 100 x 50 mm whose upper left edge is rounded.
Surface roundedBlock(double radius)
{
  return test::makeSurface(test::cubeMap(50,
    [&](const Vector3d& p)
    {
      Vector3d place(50.0_mm * p.x(), 50.0_mm * p.y(), 25.0_mm * (p.z() - 1.0));
      const Vector3d middle(radius - 50.0_mm, place.y(), -radius);
      const Vector3d from = place - middle;
      if (from.x() < 0.0 && from.z() > 0.0) // a square becomes a quarter of a disc
      {
        place = middle + from * std::max(-from.x(), from.z()) / from.norm();
      }
      return place;
    }));
}

// By finite elements (B-bar, by a program of another hand, 5 mm deep) the law is 22 and 18 % too
// stiff 11 and 14 mm from where the faces would meet, 10 % at 18 mm beside a rounder one.
TEST(LobeRule, SeesAnUprightEdgeThatIsRoundedWhateverItStandsOn)
{
  for (const Base base : { Base::Unset, Base::Bonded })
  {
    const auto holds = [&](const Surface& surface, double place)
    {
      const Contact contact =
        pressed(surface, { place - 50.0_mm, 0.0, 0.0 }, 5.0_mm, -Vector3d::UnitZ());
      return lobeRule(surface, contact, 6.6_mm, base).holds();
    };
    const Surface round = roundedBlock(8.0_mm);
    EXPECT_FALSE(holds(round, 11.0_mm));
    EXPECT_FALSE(holds(round, 14.0_mm));
    EXPECT_TRUE(holds(round, 50.0_mm));
    EXPECT_FALSE(holds(roundedBlock(15.0_mm), 18.0_mm));
  }
}

// a finger, held at its root: by Timoshenko's beam 16 times as soft as the law says
TEST(LobeRule, SeesABarThatMayBeHeldAtItsEnd)
{
  const Surface bar = test::makeSurface(test::block({ 120.0_mm, 40.0_mm, 40.0_mm }, 20));
  const Contact contact = pressed(bar, { 20.0_mm, 0.0, 0.0 }, 1.0_mm, -Vector3d::UnitZ());
  EXPECT_FALSE(lobeRule(bar, contact, 2.9_mm, Base::Unset).holds());
  EXPECT_TRUE(lobeRule(bar, contact, 2.9_mm, Base::Bonded).holds());
}

} // namespace
} // namespace palp
