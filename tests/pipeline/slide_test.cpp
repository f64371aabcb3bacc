#include "haptics/contact/contact.h"
#include "haptics/contact/indentation_of.h"
#include "haptics/surface/nearest.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/segmented.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kStep = 0.02_mm;

Surface read(const std::filesystem::path& file, UnitChoice unit = {})
{
  const auto mesh = readSurface(file, unit).mesh;
  return { pointsOf(*mesh), trianglesOf(*mesh) };
}

// The largest changes from one step to the next along a cut, around the body, at constant distance
// of a sphere's middle to the triangles.
struct Slide
{
  double force = 0.0;     // over the mean [-]
  double factor = 0.0;    // of the corrections together [-]
  double direction = 0.0; // [rad]
  double length = 0.0;    // [m]
};

Slide slide(const Surface& surface, const ForceLaw& law, double depth, const Eigen::Vector3d& across)
{
  const double radius = baseRadius(law.tip());
  const ForceLaw paper(law.tip(), law.material());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : surface.points())
  {
    middle += point / static_cast<double>(surface.points().size());
  }
  // from outside in until the depth is met, then around
  const Eigen::Vector3d out = across.unitOrthogonal();
  Eigen::Vector3d place = middle + 1.0 * out;
  const auto settle = [&]
  {
    Eigen::Vector3d away = out;
    for (int i = 0; i < 60; ++i)
    {
      const Nearest nearest = findNearest(surface, place, 10.0);
      away = (place - nearest.point) * (nearest.distance < 0.0 ? -1.0 : 1.0);
      away = (away - away.dot(across) * across).normalized();
      const double excess = nearest.distance - (radius - depth);
      if (std::abs(excess) < 1e-9)
      {
        break;
      }
      place -= excess * away;
    }
    return away;
  };
  Eigen::Vector3d away = settle();
  const Eigen::Vector3d start = place;

  Slide result;
  double sum = 0.0;
  double largest = 0.0;
  int steps = 0;
  Contact last;
  double lastForce = 0.0;
  double lastFactor = 0.0;
  const auto closed = [&] { return steps > 1000 && (place - start).norm() < 2.0 * kStep; };
  for (Eigen::Vector3d from = place; steps < 40000 && !closed(); ++steps)
  {
    const Contact contact = findContact(surface, law.tip(),
      { .apex = place - radius * away, .axis = -away }, ContactRule::Exact);
    const double force = law(indentationOf(contact)).force;
    const double factor = force / paper({ .depth = contact.depth }).force;
    if (steps > 0)
    {
      const double part = kStep / std::max(kStep, (place - from).norm()); // of what it moved
      largest = std::max(largest, part * std::abs(force - lastForce));
      result.factor = std::max(result.factor, part * std::abs(factor - lastFactor) / factor);
      result.direction = std::max(result.direction,
        part * std::acos(std::min(1.0, contact.normal.dot(last.normal))));
    }
    last = contact;
    lastForce = force;
    lastFactor = factor;
    sum += force;
    from = place;
    place += kStep * across.cross(away);
    away = settle();
  }
  result.force = largest * steps / sum;
  result.length = steps * kStep;
  return result;
}

ForceLaw lawOf(double radius, LawMode mode)
{
  const std::string folder = std::string(PALP_SOURCE_DIR) + "/data/tables/large_strain_";
  return ForceLaw(SphereTip{ radius }, { .youngModulus = 50.0_kPa, .poissonRatio = 0.33 },
    { .mode = mode, .largeStrain = readLargeStrain(folder + "sphere.csv", folder + "cone.csv") });
}

// on a body that is smooth beneath the tool, whatever the law
TEST(Slide, ChangesTheForceByLessThanAHandNoticesAtEachStep)
{
  const Surface liver = read(PALP_SHARE "/meshes/liver.vtp");
  for (const auto& [radius, depth] : { std::pair(10.0_mm, 4.0_mm), std::pair(4.0_mm, 2.0_mm) })
  {
    for (const Eigen::Vector3d& across : { Eigen::Vector3d(Eigen::Vector3d::UnitX()),
           Eigen::Vector3d(Eigen::Vector3d::UnitY()), Eigen::Vector3d(Eigen::Vector3d::UnitZ()),
           Eigen::Vector3d(Eigen::Vector3d(1.0, -2.0, 0.7).normalized()) })
    {
      for (const LawMode mode : { LawMode::Exact, LawMode::Corrected })
      {
        const Slide result = slide(liver, lawOf(radius, mode), depth, across);
        EXPECT_GT(result.length, 0.15) << across.transpose();
        EXPECT_LE(result.force, 0.005) << across.transpose() << " R " << radius;
        EXPECT_LE(result.direction, 0.3_deg) << across.transpose() << " R " << radius;
      }
    }
  }
}

// the bundled liver as a scanner would give it: voxels of 2 mm, contoured and smoothed
Surface segmented()
{
  const auto liver = readSurface(PALP_SHARE "/meshes/liver.vtp").mesh;
  const auto contoured = test::contouredFromVoxels(*liver, 2.0_mm);
  return { pointsOf(*contoured), trianglesOf(*contoured) };
}

// the depth follows the steps that voxels leave, the corrections must not follow them twice
TEST(Slide, CorrectionsAreSmoothOverVoxels)
{
  const Surface liver = segmented();
  for (int axis = 0; axis < 3; ++axis)
  {
    const Slide exact =
      slide(liver, lawOf(10.0_mm, LawMode::Exact), 4.0_mm, Eigen::Vector3d::Unit(axis));
    const Slide corrected =
      slide(liver, lawOf(10.0_mm, LawMode::Corrected), 4.0_mm, Eigen::Vector3d::Unit(axis));
    EXPECT_LE(corrected.factor, 0.01) << axis;
    EXPECT_LE(corrected.force, exact.force + 0.005) << axis;
  }
}

// every mesh in the folder of PALP_TEST_MESHES, where nothing is known about how smooth it is
TEST(Slide, CorrectionsAreSmoothOnOtherMeshes)
{
  const char* folder = std::getenv("PALP_TEST_MESHES");
  if (folder == nullptr)
  {
    GTEST_SKIP() << "PALP_TEST_MESHES names no folder";
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    if (entry.path().extension() == ".obj" || entry.path().extension() == ".stl")
    {
      const Surface surface = read(entry.path());
      for (int axis = 0; axis < 3; ++axis)
      {
        const Slide result = slide(
          surface, lawOf(10.0_mm, LawMode::Corrected), 4.0_mm, Eigen::Vector3d::Unit(axis));
        EXPECT_LE(result.factor, 0.02) << entry.path() << " " << axis;
        RecordProperty("percent", std::to_string(100.0 * result.force));
      }
    }
  }
}

} // namespace
} // namespace palp
