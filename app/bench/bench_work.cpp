#include "app/bench/bench_work.h"

#include "app/program/data_files.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kCircle = 30.0_mm; // radius of the tool's path
constexpr double kSpeed = 0.1;      // [m/s]
constexpr int kNodules = 10;

std::vector<float> inFloats(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<float> result;
  for (const Eigen::Vector3d& point : points)
  {
    for (const double x : point)
    {
      result.push_back(static_cast<float>(x));
    }
  }
  return result;
}

} // namespace

ToolPose benchPose(double time)
{
  const double angle = kSpeed * time / kCircle;
  const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
  return { .apex = kCircle * outward - kBenchDepth * Eigen::Vector3d::UnitZ(),
    .axis = -Eigen::Vector3d::UnitZ(),
    .velocity = kSpeed * Eigen::Vector3d(-outward.y(), outward.x(), 0.0) };
}

DeviceLimits benchDevice()
{
  return {
    .model = "bench", .rendersForce = true, .maxForce = 8.0, .damping = 1.0, .workspaceRadius = 0.0
  };
}

LawSettings benchSettings()
{
  return { .mode = LawMode::Corrected,
    .largeStrain = readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv")) };
}

Scene benchTissue(bool nodules)
{
  LawSettings settings = benchSettings();
  settings.relaxation.add({ 0.3, 50.0_ms });
  settings.relaxation.add({ 0.2, 0.6 });
  settings.friction = 0.3;
  Scene scene;
  scene.law = ForceLaw(scene.law.tip(), scene.law.material(), settings);
  std::vector<EmbeddedNodule> found;
  for (int i = 0; nodules && i < kNodules; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / kNodules;
    found.push_back(
      { .nodule = { { kCircle * std::cos(angle), kCircle * std::sin(angle), -10.0_mm }, 5.0_mm,
          5.0 },
        .depth = 10.0_mm,
        .place = { .thickness = 30.0_mm } });
  }
  if (nodules)
  {
    scene.nodules = std::make_shared<const NoduleField>(scene.law, std::move(found));
  }
  return scene;
}

ServoTick::ServoTick(
  std::shared_ptr<const Surface> surface, Scene scene, const DeviceLimits& device)
  : chain_(device, { .fastest = 1e6 })
  , scene_(std::move(scene))
{
  scene_.surface = std::move(surface);
  scene_.damping = 1.0;
  scene_.armed = true;
}

Sample ServoTick::operator()(const ToolPose& pose)
{
  return step(scene_, memory_, chain_, pose, {}, { .armed = true }, 1.0_ms);
}

DrawnSurface::DrawnSurface(const Mesh& mesh)
  : rest(inFloats(mesh.points))
  , points(rest.size())
  , normals(rest.size())
  , displacement(rest.size())
  , zone(mesh.points.size())
  , dent(rest, mesh.triangles)
{
  dent.reset({ points.data(), normals.data(), displacement.data(), zone.data() });
}

void DrawnSurface::press(const Press& with)
{
  dent.update(with, { points.data(), normals.data(), displacement.data(), zone.data() });
}

VisualUpdate::VisualUpdate(int n, const Tip& tip, const std::string& table, bool fitted)
  : extents_(ExtentTable::read(dataFile("tables/" + table + ".csv")))
  , drawn_(makeGrid(n, kBenchSide))
{
  const Mesh mesh = makeGrid(n, kBenchSide);
  scene_.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  scene_.law = ForceLaw(tip, scene_.law.material());
  if (fitted)
  {
    style_.fitted = FittedSurfaces::read(dataFile("tables/" + table + "_surface.csv"));
  }
}

void VisualUpdate::operator()(const ToolPose& pose)
{
  const Sample sample = step(scene_, pose);
  drawn_.press(
    pressOf(sample, scene_.law.tip(), extents_.extentRadius(sample.contact.depth), style_));
}

} // namespace palp
