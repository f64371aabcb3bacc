#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/servo/servo_step.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/decimation/decimate.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/given_meshes.h"
#include "tests/pipeline/segmented.h"
#include "tests/pipeline/slide.h"
#include "tests/support/shipped_ratios.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace test;

constexpr double kNoticed = 0.005;       // largest change of the force at a step, of its mean
constexpr double kNoticedTurn = 0.3_deg; // and of its direction

std::shared_ptr<const Surface> surfaceOf(vtkPolyData& mesh)
{
  return std::make_shared<Surface>(pointsOf(mesh), trianglesOf(mesh));
}

#ifdef PALP_SLOW
constexpr std::size_t kWays = 1;
#else
constexpr std::size_t kWays = 2; // every other cut for each tool
#endif

constexpr Tool kLarge{ 10.0_mm, 4.0_mm };
constexpr Tool kSmall{ 4.0_mm, 2.0_mm };

ForceLaw lawOf(double radius, LawMode mode)
{
  return ForceLaw(SphereTip{ radius }, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 },
    { .mode = mode, .largeStrain = shippedRatios() });
}

// largest changes of the force from one step to the next, outside folds
struct Change
{
  double size = 0.0;      // of its mean [-]
  double direction = 0.0; // [rad]
};

constexpr std::array kModes = { LawMode::Paper, LawMode::Exact, LawMode::Corrected };
constexpr std::array kNames = { "paper", "exact", "corrected" };

struct Changes
{
  std::array<Change, kModes.size()> of; // each law
  double folded = 0.0;                  // part of the path [-]
  double length = 0.0;                  // [m]
};

Change changeOf(const Scene& scene, const std::vector<Pose>& poses, const std::vector<bool>& folded)
{
  const double radius = baseRadius(scene.law.tip());
  Change change;
  double sum = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i)
  {
    const Pose& pose = poses[i];
    const Eigen::Vector3d force =
      step(scene, { .apex = pose.middle - radius * pose.away, .axis = -pose.away }).force;
    if (i > 0 && !folded[i] && !folded[i - 1])
    {
      const double part = kStep / std::max(kStep, pose.along - poses[i - 1].along);
      const double cosine = std::min(1.0, force.normalized().dot(last.normalized()));
      change.size = std::max(change.size, part * std::abs(force.norm() - last.norm()));
      change.direction = std::max(change.direction, part * std::acos(cosine));
    }
    last = force;
    sum += force.norm();
  }
  change.size *= static_cast<double>(poses.size()) / sum;
  return change;
}

Changes changes(const std::shared_ptr<const Surface>& surface, const Tool& tool,
  const Eigen::Vector3d& across, Held held)
{
  const std::vector<Pose> poses = slide(*surface, tool, across, held);
  const std::vector<bool> folded = folds(poses, tool);
  Changes result;
  Scene scene;
  scene.surface = surface;
  scene.forceLimit = 1000.0;
  for (std::size_t i = 0; i < kModes.size(); ++i)
  {
    scene.law = lawOf(tool.radius, kModes[i]);
    result.of[i] = changeOf(scene, poses, folded);
  }
  for (std::size_t i = 1; i < poses.size(); ++i)
  {
    result.folded += folded[i] ? poses[i].along - poses[i - 1].along : 0.0;
  }
  result.length = poses.back().along;
  result.folded /= result.length;
  return result;
}

const std::vector<Eigen::Vector3d>& cuts()
{
  static const std::vector<Eigen::Vector3d> all = { Eigen::Vector3d::UnitX(),
    Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
    Eigen::Vector3d(1.0, -2.0, 0.7).normalized() };
  return all;
}

// name:  of the surface, for what is recorded
void expectSmooth(const std::string& name, const std::shared_ptr<const Surface>& surface, Held held,
  double mostFolded)
{
  Changes worst;
  for (const bool isSmall : { false, true })
  {
    const Tool& tool = isSmall ? kSmall : kLarge;
    for (std::size_t cut = isSmall ? kWays - 1 : 0; cut < cuts().size(); cut += kWays)
    {
      const Eigen::Vector3d& across = cuts()[cut];
      const Changes result = changes(surface, tool, across, held);
      const std::string at = "R " + std::to_string(tool.radius) + " across " +
        std::to_string(across.x()) + " " + std::to_string(across.y());
      EXPECT_GT(result.length, 0.1) << at;
      EXPECT_LE(result.folded, mostFolded) << at;
      worst.folded = std::max(worst.folded, result.folded);
      for (std::size_t i = 0; i < kModes.size(); ++i)
      {
        EXPECT_LE(result.of[i].size, kNoticed) << kNames[i] << at;
        EXPECT_LE(result.of[i].direction, kNoticedTurn) << kNames[i] << at;
        worst.of[i].size = std::max(worst.of[i].size, result.of[i].size);
        worst.of[i].direction = std::max(worst.of[i].direction, result.of[i].direction);
      }
    }
  }
  const auto record = [&](const std::string& what, double value)
  { ::testing::Test::RecordProperty(name + "_" + what, std::to_string(value)); };
  for (std::size_t i = 0; i < kModes.size(); ++i)
  {
    record(std::string(kNames[i]) + "_percent", 100.0 * worst.of[i].size);
    record(std::string(kNames[i]) + "_deg", worst.of[i].direction / 1.0_deg);
  }
  record("folded_percent", 100.0 * worst.folded);
}

vtkSmartPointer<vtkPolyData> bundledLiver()
{
  return readSurface(PALP_SHARE "/meshes/liver.vtp").mesh;
}

TEST(Slide, ChangesTheForceByLessThanAHandNoticesAtEachStep)
{
  const auto liver = surfaceOf(*bundledLiver());
  expectSmooth("distance", liver, Held::Distance, 0.03);
  expectSmooth("depth", liver, Held::Depth, 0.03);
}

// A slide of 2.4 mm into a hollow, where the nearest point leaps from one side to the other and a
// curvature that was read there took a third of the force with it, by 1.1 N from 3.8 N in one step.
TEST(Slide, DoesNotFollowTheNearestPointAsItLeaps)
{
  const auto liver = surfaceOf(*bundledLiver());
  const ForceLaw law = lawOf(10.0_mm, LawMode::Corrected);
  const std::array<Eigen::Vector3d, 3> apex = { Eigen::Vector3d(6.759356, -39.047143, -1.384745),
    Eigen::Vector3d(7.934771, -38.909182, -1.364664),
    Eigen::Vector3d(9.113350, -38.896545, -1.346739) };
  const std::array<Eigen::Vector3d, 3> axis = { Eigen::Vector3d(-0.129727, 0.991340, 0.020419),
    Eigen::Vector3d(-0.091511, 0.995493, 0.024905),
    Eigen::Vector3d(-0.053557, 0.998133, 0.029350) };
  constexpr int steps = 80;
  double last = 0.0;
  double leap = 0.0;
  Eigen::Vector3d lastNearest = Eigen::Vector3d::Zero();
  for (int i = 0; i <= steps; ++i)
  {
    // the parabola through three poses
    const double t = static_cast<double>(i) / steps;
    const auto between = [t](const std::array<Eigen::Vector3d, 3>& at)
    {
      return Eigen::Vector3d((1.0 - t) * (1.0 - 2.0 * t) * at[0] + 4.0 * t * (1.0 - t) * at[1] +
        t * (2.0 * t - 1.0) * at[2]);
    };
    const ToolPose pose{ .apex = 1.0_mm * between(apex), .axis = between(axis).normalized() };
    const Contact contact = findContact(*liver, law.tip(), pose, ContactRule::Exact);
    const double force = law(contactGeometryOf(contact)).force;
    const Eigen::Vector3d nearest =
      findClosestPoint(*liver, pose.apex - 10.0_mm * pose.axis, 1.0).point;
    ASSERT_GT(force, 1.0);
    if (i > 0)
    {
      leap = std::max(leap, (nearest - lastNearest).norm());
      EXPECT_LE(std::abs(force - last), 1.5 * kNoticed * force) << i; // steps are 0.03 mm long
    }
    last = force;
    lastNearest = nearest;
  }
  EXPECT_GT(leap, 0.3_mm); // or this is another place
}

// as a scanner would give it
TEST(Slide, IsSmoothOverVoxels)
{
  const auto liver = surfaceOf(*test::contouredFromVoxels(*bundledLiver(), 2.0_mm));
  expectSmooth("voxels", liver, Held::Distance, 0.04);
}

// voxels as scanners have them, small against the contact
TEST(Slide, IsSmoothOverVoxelsOfEachSizeAtConstantDepth)
{
#ifdef PALP_SLOW
  const std::vector<double> voxels = { 0.5_mm, 0.6_mm, 0.7_mm, 0.8_mm, 1.0_mm, 1.2_mm };
#else
  const std::vector<double> voxels = { 1.5_mm };
#endif
  for (const double voxel : voxels)
  {
    SCOPED_TRACE(voxel);
    const auto liver = surfaceOf(*test::contouredFromVoxels(*bundledLiver(), voxel));
    expectSmooth("voxels_" + std::to_string(voxel), liver, Held::Depth, 0.04);
  }
}

// edges of 6 mm: a distance to them leads the tool over each of them, the depth over none
TEST(Slide, IsSmoothOverACoarseMeshAtConstantDepth)
{
  const auto fine = surfaceOf(*bundledLiver());
  TriangleMesh coarse = decimated(fine->points(), fine->triangles(), 2000);
  const auto liver =
    std::make_shared<Surface>(std::move(coarse.points), std::move(coarse.triangles));
  ASSERT_GT(liver->edgeLength(), 5.0_mm);
  expectSmooth("coarse", liver, Held::Depth, 0.05);
}

// nothing is known about how smooth they are
TEST(Slide, IsSmoothOnOtherMeshesAtConstantDepth)
{
  const auto files = test::givenMeshes();
  if (files.empty())
  {
    GTEST_SKIP() << "PALP_TEST_MESHES names no folder with meshes";
  }
  for (const auto& file : files)
  {
    SCOPED_TRACE(file);
    expectSmooth(file.stem(), surfaceOf(*test::readGiven(file)), Held::Depth, 0.21);
  }
}

} // namespace
} // namespace palp
