#include "app/bench.h"
#include "app/data_files.h"
#include "calibration/extent_table.h"
#include "data/shapes.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "pipeline/dent.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kDepth = 5.0_mm;
constexpr int kFrames = 1000;

BenchRow benchSurface(int n, const ExtentTable& extents)
{
  const Mesh mesh = makeGrid(n, 100.0_mm);
  Scene scene;
  scene.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);

  std::vector<float> rest;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    for (const double x : point)
    {
      rest.push_back(static_cast<float>(x));
    }
  }
  std::vector<float> points(rest.size());
  std::vector<float> normals(rest.size());
  std::vector<float> displacement(rest.size());
  std::vector<unsigned char> zone(mesh.points.size());
  const DentArrays arrays{ points.data(), normals.data(), displacement.data(), zone.data() };
  Dent dent(rest, mesh.triangles);
  dent.reset(arrays);

  // a tool that moves by 2 mm from frame to frame, to and fro along x
  const auto frame = [&](int i)
  {
    ToolPose pose;
    pose.apex = { 2.0_mm * (i % 20 - 10), 1.3_mm, -kDepth };
    const Sample sample = step(scene, pose);
    dent.update({ .contact = sample.contact,
                  .pose = pose,
                  .tip = scene.law.tip(),
                  .contactRadius = sample.response.contactRadius,
                  .extentRadius = extents.extentRadius(sample.contact.depth) },
      arrays);
  };
  for (int i = 0; i < 20; ++i)
  {
    frame(i);
  }
  return benchRow("update", mesh.points.size(), "moving",
    timed(
      kFrames, [](int) {}, frame));
}

} // namespace

std::vector<BenchRow> benchUpdate(std::size_t most)
{
  const ExtentTable extents = ExtentTable::read(dataFile("tables/sphere_r10_h50.csv"));
  std::vector<BenchRow> rows;
  for (const int n : { 40, 50, 60, 70, 80, 90, 100 })
  {
    if (static_cast<std::size_t>(n) * static_cast<std::size_t>(n) <= most)
    {
      rows.push_back(benchSurface(n, extents));
    }
  }
  return rows;
}

} // namespace palp
