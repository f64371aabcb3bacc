// What a tool that turns feels: by the statics of a ball, and by the work of whole motions.

#include "haptics/servo/torque.h"

#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/servo/turned_world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::kDown;
using test::slab;
using test::worldOf;

test::Mesh ellipsoid()
{
  test::Mesh mesh = test::ball(1.0, 60);
  for (Vector3d& point : mesh.first)
  {
    point = point.cwiseProduct(Vector3d(50.0_mm, 35.0_mm, 25.0_mm));
  }
  return mesh;
}

double topOf(const Scene& scene)
{
  const auto& points = scene.surface->points();
  return std::ranges::max_element(points, {}, [](const Vector3d& at) { return at.z(); })->z();
}

Wrench wrenchAt(const Scene& scene, const ToolPose& pose)
{
  const Sample sample = step(scene, pose);
  return sample.contact.touching()
    ? Wrench{ sample.force, torqueAt(scene, sample, TissueAt(scene, sample.contact)) }
    : Wrench{};
}

// of a rigid tool that is pushed where its ball has its middle, whatever the body and the lean
TEST(Torque, OfABallIsThatOfItsForceAtItsMiddle)
{
  constexpr double kRadius = 8.0_mm;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const LawMode mode : { LawMode::Paper, LawMode::Exact, LawMode::Corrected })
  {
    for (const auto& mesh : { ellipsoid(), slab() })
    {
      const Scene scene = worldOf(mesh, SphereTip{ kRadius }, mode);
      const double top = topOf(scene);
      double most = 0.0;
      for (int i = 0; i < 40; ++i)
      {
        const Vector3d about(any(random), any(random), 0.0);
        const Vector3d axis = AngleAxisd(0.6 * any(random), about.normalized()) * kDown;
        const Vector3d middle(15.0_mm * any(random), 15.0_mm * any(random), top + 3.0_mm);
        const Wrench felt = wrenchAt(scene, { middle + kRadius * axis, axis });
        const Vector3d statics = (-kRadius * axis).cross(felt.force);
        // what a corrected law pushes aside is the slope of its energy to 3 %
        const double exactly = mode == LawMode::Corrected ? 5e-3 : 1e-4;
        EXPECT_LT((felt.torque - statics).norm(), exactly * kRadius * felt.force.norm()) << i;
        most = std::max(most, statics.norm());
      }
      EXPECT_GT(most, 1e-3); // of 8 mm by newtons
    }
  }
}

// A pose on a way from 0 to 1.
using Way = std::function<ToolPose(double)>;

struct Work
{
  double all = 0.0;      // that a hand brings in [J]
  double byForces = 0.0; // of it, without the turns
  double most = 0.0;     // that was in it on the way
};

void follow(Work& work, const Scene& scene, const Way& way, int steps)
{
  for (int i = 0; i < steps; ++i)
  {
    const ToolPose from = way(static_cast<double>(i) / steps);
    const ToolPose to = way((i + 1.0) / steps);
    const Wrench felt = wrenchAt(scene, way((i + 0.5) / steps));
    const double pushed = -felt.force.dot(to.apex - from.apex);
    work.byForces += pushed;
    work.all += pushed - felt.torque.dot(from.axis.cross(to.axis));
    work.most = std::max(work.most, work.all);
  }
}

struct Turned
{
  const char* name;
  Tip tip;
};

class TurnedTool : public testing::TestWithParam<Turned>
{
};

// pressed upright, leaned by 20 degrees in the tissue, slid, lifted as it leans
TEST_P(TurnedTool, GainsNoEnergy)
{
  constexpr double kLean = 20.0_deg;
  const Vector3d about = Vector3d(0.8, 0.6, 0.0);
  double unturned = 0.0; // what the forces alone would gain
  for (const LawMode mode : { LawMode::Exact, LawMode::Corrected })
  {
    for (const auto& mesh : { ellipsoid(), slab() })
    {
      const Scene scene = worldOf(mesh, GetParam().tip, mode);
      const double top = topOf(scene);
      const auto at = [&](double x, double height, double lean) {
        return ToolPose{ Vector3d(x, 1.0_mm, top + height), AngleAxisd(lean, about) * kDown };
      };
      Work work;
      follow(
        work, scene, [&](double t) { return at(0.0, 8.0_mm - 11.0_mm * t, 0.0); }, 400);
      follow(
        work, scene, [&](double t) { return at(0.0, -3.0_mm, kLean * t); }, 300);
      follow(
        work, scene, [&](double t) { return at(4.0_mm * t, -3.0_mm, kLean); }, 300);
      follow(
        work, scene, [&](double t) { return at(4.0_mm, -3.0_mm + 23.0_mm * t, kLean); }, 600);
      EXPECT_LT(std::abs(work.all), 1e-3 * work.most);
      unturned = std::max(unturned, std::abs(work.byForces) / work.most);
    }
  }
  EXPECT_GT(unturned, 0.1) << "turns nothing"; // an exact cone in a plane does not
}

INSTANTIATE_TEST_SUITE_P(Tools, TurnedTool,
  testing::Values(Turned{ "Ball", SphereTip{ 10.0_mm } },
    Turned{ "Cone", ConeTip{ 60.0_deg, 15.0_mm } },
    Turned{ "Paraboloid", ParaboloidTip{ 10.0_mm } }, Turned{ "Punch", PunchTip{ 4.0_mm } },
    Turned{ "TruncatedCone", TruncatedConeTip{ 60.0_deg, 4.0_mm, 20.0_mm } }),
  [](const auto& tool) { return std::string(tool.param.name); });

} // namespace
} // namespace palp
