#include "calibration/organ/organ_motion_modes.h"
#include "calibration/organ/organ_places.h"
#include "data/shapes.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kMovedYoung = 50e3;
constexpr double kMovedPoisson = 0.3;
const Vector3d kSize(100.0_mm, 20.0_mm, 16.0_mm); // held at its end at x = -50 mm, top at z = 0

OrganTable tableOf(const Eigen::Matrix3d& turn)
{
  Mesh mesh = makeBox(kSize, 4.0_mm);
  for (Vector3d& point : mesh.points)
  {
    point = turn * point;
  }
  const Surface surface(mesh.points, mesh.triangles);
  const Support end{ [&](const Vector3d& x)
    { return (turn.transpose() * x).x() < -0.49999 * kSize.x(); } };
  const std::span supports(&end, 1);
  const OrganModel model(surface, 4.0_mm, kMovedYoung, kMovedPoisson, supports);
  OrganTable table;
  table.cell = 4.0_mm;
  table.spacing = 5.0_mm;
  const std::vector<SurfacePoint> places = organPlaces(surface, table.spacing);
  EXPECT_TRUE(addPlaces(table, model, surface,
    { .places = places, .supports = supports, .tell = [](const OrganTable&) {} }));
  EXPECT_TRUE(addMotion(table, model, surface, {}));
  return table;
}

OrganLoad loadAt(double x, double force)
{
  return { .center = { x, 0.0, 0.0 },
    .normal = Vector3d::UnitZ(),
    .force = force * (1.0 - kMovedPoisson * kMovedPoisson) / kMovedYoung };
}

// from its held end on, under a force farther out; Timoshenko's
struct Beam
{
  double force;
  double arm; // to the force [m]

  [[nodiscard]] double slopeAt(double from) const
  {
    const double inertia = kSize.y() * std::pow(kSize.z(), 3) / 12.0;
    const double s = std::min(from, arm);
    return force * s * (2.0 * arm - s) / (2.0 * kMovedYoung * inertia);
  }
  [[nodiscard]] double shearAt(double from) const
  {
    const double stiffness =
      5.0 / 6.0 * kMovedYoung / (2.0 * (1.0 + kMovedPoisson)) * kSize.y() * kSize.z();
    return from <= arm ? force / stiffness : 0.0;
  }
  [[nodiscard]] double sagAt(double from) const
  {
    const double inertia = kSize.y() * std::pow(kSize.z(), 3) / 12.0;
    const double s = std::min(from, arm);
    return force * s * s * (3.0 * arm - s) / (6.0 * kMovedYoung * inertia) + shearAt(s) * s +
      slopeAt(arm) * (from - s);
  }
};

class OrganMotionOfALobe : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    motion_ = std::make_unique<const OrganMotion>(tableOf(Eigen::Matrix3d::Identity()).motion);
  }
  static void TearDownTestSuite()
  {
    motion_.reset();
  }
  static std::unique_ptr<const OrganMotion> motion_;
};
std::unique_ptr<const OrganMotion> OrganMotionOfALobe::motion_;

// all of a slender body, above and below, the end beyond the tool included
TEST_F(OrganMotionOfALobe, BendsAsTimoshenkosBeam)
{
  constexpr double kForce = 0.05; // [N]
  for (const double x : { 30.0_mm, 0.0_mm })
  {
    const OrganLoad load = loadAt(x, kForce);
    const Beam beam{ kForce, x + 50.0_mm };
    const double most = beam.sagAt(100.0_mm);
    for (double at = -45.0_mm; at < 50.0_mm; at += 7.0_mm)
    {
      for (const double z : { 0.0, -16.0_mm })
      {
        const auto moved = motion_->movedAt({ at, 3.0_mm, z }, { &load, 1 });
        const double from = at + 50.0_mm;
        EXPECT_NEAR(-vectorOf(moved.move).z(), beam.sagAt(from), 0.05 * most) << at << ' ' << z;
        EXPECT_NEAR(vectorOf(moved.move).x(), (z + 8.0_mm) * beam.slopeAt(from), 0.03 * most)
          << at << ' ' << z;
        const double turn = beam.slopeAt(from) + beam.shearAt(from);
        EXPECT_NEAR(vectorOf(moved.turn).y(), turn, 0.08 * beam.slopeAt(100.0_mm))
          << at << ' ' << z;
      }
    }
  }
}

// Betti: what a force here moves there, that force there moves here
TEST_F(OrganMotionOfALobe, MovesThereAsItIsMovedFromThere)
{
  for (const auto& [here, there] :
    { std::pair(-20.0_mm, 30.0_mm), std::pair(0.0_mm, 42.0_mm), std::pair(13.0_mm, -33.0_mm) })
  {
    const OrganLoad first = loadAt(here, 1.0);
    const OrganLoad second = loadAt(there, 1.0);
    const double one = vectorOf(motion_->movedAt(second.center, { &first, 1 }).move).z();
    const double other = vectorOf(motion_->movedAt(first.center, { &second, 1 }).move).z();
    EXPECT_NEAR(one, other, 0.05 * std::abs(one)) << here;
  }
}

TEST_F(OrganMotionOfALobe, AddsUpUnderTwoTools)
{
  const std::array loads{ loadAt(30.0_mm, 0.05), loadAt(-10.0_mm, 0.1) };
  std::vector<OrganMotion::Moved> together;
  std::array<std::vector<OrganMotion::Moved>, 2> each;
  motion_->move(loads, together);
  motion_->move({ loads.data(), 1 }, each[0]);
  motion_->move({ loads.data() + 1, 1 }, each[1]);
  for (std::size_t i = 0; i < together.size(); ++i)
  {
    const Vector3d sum = vectorOf(each[0][i].move) + vectorOf(each[1][i].move);
    EXPECT_LT((vectorOf(together[i].move) - sum).norm(), 1e-6);
  }
}

// the same to the frame of the body, which need not be that of the cells
TEST(OrganMotion, GoesWithTheFrame)
{
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.3, Vector3d(3.0, 1.0, 2.0).normalized()).toRotationMatrix();
  OrganTable table = tableOf(turn);
  table.place(Eigen::Isometry3d(turn.transpose()));
  const OrganMotion motion(table.motion);
  const OrganLoad load = loadAt(30.0_mm, 0.05);
  const Beam beam{ 0.05, 80.0_mm };
  const auto moved = motion.movedAt({ 45.0_mm, 0.0, 0.0 }, { &load, 1 });
  EXPECT_NEAR(-vectorOf(moved.move).z(), beam.sagAt(95.0_mm), 0.06 * beam.sagAt(95.0_mm));
}

// as far as the tool goes in without its dent, whatever was lost between the places
TEST_F(OrganMotionOfALobe, IsAsDeepAsTheToolWithoutItsDent)
{
  const Beam beam{ 0.05, 80.0_mm };
  OrganLoad load = loadAt(30.0_mm, 0.05);
  load.given = 1.05 * beam.sagAt(80.0_mm);
  const OrganLoad fitted = motion_->fitted(load);
  // a smooth pressure of 7.5 cells has this in its middle on a half-space
  const double wide = 8.0 / (3.0 * std::numbers::pi * 30.0_mm) * load.force;
  EXPECT_NEAR(-vectorOf(motion_->movedAt(load.center, { &fitted, 1 }).move).z(), load.given + wide,
    1e-3 * load.given);
}

} // namespace
} // namespace palp
