#include "haptics/contact/embed_stiffness.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/given_meshes.h"
#include "tests/pipeline/segmented.h"
#include "tests/support/shipped_ratios.h"
#include "tests/support/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <string>
#include <vector>
#include <vtkPolyData.h>

// Whoever presses a tool into a surface, drags it along and lifts it gains no work and loses none:
// the force is the gradient of one energy, whatever the mesh and the law.

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRadius = 10.0_mm;
constexpr double kPressed = 5.0_mm;
constexpr double kClear = 5.0_mm; // over the surface
constexpr int kPlaces = 40;

// of the hand along a way of the tool
struct Work
{
  Eigen::Vector3d apex;
  Eigen::Vector3d axis;
  double sum = 0.0;     // [J]
  double most = 0.0;    // so far [J]
  double deepest = 0.0; // [m]

  void move(const Scene& scene, const Eigen::Vector3d& way)
  {
    const int steps = static_cast<int>(std::ceil(way.norm() / 0.02_mm));
    const Eigen::Vector3d each = way / steps;
    for (int i = 0; i < steps; ++i)
    {
      const Sample sample = step(scene, { .apex = apex + (i + 0.5) * each, .axis = axis });
      sum -= sample.force.dot(each);
      most = std::max(most, sum);
      deepest = std::max(deepest, sample.contact.depth);
    }
    apex += way;
  }
};

// of the work around a loop, to the most on the way
struct Loops
{
  double median;
  double worst;
};

// @param isAt  of a vertex: whether it is pressed
template <typename IsAt>
Loops loopsOver(const Scene& scene, double drag, IsAt isAt)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> shares;
  const auto points = scene.surface->points();
  while (shares.size() < kPlaces)
  {
    const auto i = static_cast<std::size_t>(random() % points.size());
    const Eigen::Vector3d out = scene.surface->normals()[i];
    const Eigen::Vector3d aside =
      out.cross(Eigen::Vector3d(normal(random), normal(random), normal(random))).normalized();
    if (!isAt(points[i]))
    {
      continue;
    }
    Work work{ .apex = points[i] + kClear * out, .axis = -out };
    work.move(scene, -(kPressed + kClear) * out);
    work.move(scene, drag * aside);
    work.move(scene, 40.0_mm * out);
    const bool isOut = !step(scene, { .apex = work.apex, .axis = work.axis }).contact.touching();
    if (work.deepest < kRadius && isOut) // else it came through a thin part, to another side
    {
      shares.push_back(std::abs(work.sum) / work.most);
    }
  }
  std::ranges::sort(shares);
  return { shares[kPlaces / 2], shares.back() };
}

Scene sceneOf(std::shared_ptr<const Surface> surface, LawMode mode)
{
  Scene scene;
  scene.surface = std::move(surface);
  scene.forceLimit = 1000.0;
  scene.law = ForceLaw(SphereTip{ kRadius }, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 },
    { .mode = mode, .largeStrain = test::shippedRatios() });
  return scene;
}

std::shared_ptr<const Surface> surfaceOf(vtkPolyData& mesh)
{
  return std::make_shared<Surface>(pointsOf(mesh), trianglesOf(mesh));
}

void record(const std::string& name, const Loops& loops)
{
  testing::Test::RecordProperty(name + "_median_percent", std::to_string(100.0 * loops.median));
  testing::Test::RecordProperty(name + "_worst_percent", std::to_string(100.0 * loops.worst));
}

template <typename IsAt>
void expectClosed(const std::string& name, const std::shared_ptr<const Surface>& surface,
  double drag, double median, double worst, IsAt isAt)
{
  for (const LawMode mode : { LawMode::Paper, LawMode::Corrected })
  {
    const Loops loops = loopsOver(sceneOf(surface, mode), drag, isAt);
    const std::string of = name + (mode == LawMode::Paper ? "_paper" : "_corrected");
    EXPECT_LE(loops.median, median) << of;
    EXPECT_LE(loops.worst, worst) << of;
    record(of, loops);
  }
}

const auto anywhere = [](const Eigen::Vector3d&) { return true; };

void expectClosedOverLiver(const std::string& name, vtkPolyData& mesh)
{
  expectClosed(name, surfaceOf(mesh), 15.0_mm, 0.005, 0.03, anywhere);
}

vtkSmartPointer<vtkPolyData> bundledLiver()
{
  return readSurface(PALP_SHARE "/meshes/liver.vtp").mesh;
}

TEST(Loop, TakesNoWorkOverTheBundledLiver)
{
  expectClosedOverLiver("bundled", *bundledLiver());
}

TEST(Loop, TakesNoWorkOverALiverFromVoxels)
{
  expectClosedOverLiver("voxels", *test::contouredFromVoxels(*bundledLiver(), 2.0_mm));
}

// from 10 to 90 kPa, along each axis; what the liver's own shape does is of the stiffness there
TEST(Loop, TakesNoWorkOverALiverWhoseStiffnessVaries)
{
  Scene scene = sceneOf(surfaceOf(*bundledLiver()), LawMode::Corrected);
  scene.stiffness = embedStiffness(*scene.surface, scene.law,
    [](const Eigen::Vector3d& x)
    { return 50.0_kPa * (1.0 + 0.8 * (x / 20.0_mm).array().sin().prod()); });
  const Loops loops = loopsOver(scene, 15.0_mm, anywhere);
  EXPECT_LE(loops.median, 0.005);
  EXPECT_LE(loops.worst, 0.03);
  record("map", loops);
}

TEST(Loop, TakesNoWorkOverOtherLivers)
{
  const auto files = test::givenMeshes();
  if (files.empty())
  {
    GTEST_SKIP() << "PALP_TEST_MESHES names no folder of meshes";
  }
  for (const auto& file : files)
  {
    expectClosedOverLiver(file.stem(), *test::readGiven(file));
  }
}

TEST(Loop, TakesNoWorkOverABall)
{
  expectClosed("ball", std::make_shared<Surface>(test::makeSurface(test::ball(40.0_mm, 20))),
    15.0_mm, 0.001, 0.002, anywhere);
}

TEST(Loop, TakesNoWorkOverTheFaceOfABlock)
{
  const auto isInner = [](const Eigen::Vector3d& place)
  { return place.head<2>().cwiseAbs().maxCoeff() < 25.0_mm && place.z() > -1.0_mm; };
  expectClosed("block",
    std::make_shared<Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 25))), 10.0_mm,
    1e-6, 1e-5, isInner);
}

} // namespace
} // namespace palp
