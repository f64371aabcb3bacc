#pragma once

#include "calibration/organ/organ_places.h"
#include "data/shapes.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/cells.h"
#include "tests/support/csv_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace palp::test
{

using namespace units::literals;
using Eigen::Vector3d;

inline constexpr double kYoung = 50e3;
inline constexpr double kPoisson = 0.45;

struct Body
{
  const char* file;    // of the reference
  Vector3d size;       // [m]
  double place = 0.0;  // along x, from the middle [m]
  bool isLobe = false; // held at its end instead of its base
  double limit = 0.05;
  double lean = 0.0; // of the side face beside the place [rad]
  double rise = 0.0; // of the top over the last 30 mm along x [rad]
  Vector3d border =
    Vector3d::Zero();    // from the middle to where its modulus changes [m]; 0: nowhere
  double ratio = 1.0;    // of the modulus beyond it
  double edges = 2.5_mm; // of the mesh [m]
  double cell = 4.0_mm;
  double wall = 0.0; // height of what stands on its end, 25 mm wide [m]
  Tip tip = SphereTip{ 10.0_mm };
};

// planes from end to end, no further apart than that
inline std::vector<double> divided(const std::vector<double>& ends, double edges)
{
  std::vector<double> planes{ ends.front() };
  for (std::size_t i = 1; i < ends.size(); ++i)
  {
    const double length = ends[i] - ends[i - 1];
    const int count = static_cast<int>(std::ceil(length / edges - 1e-9));
    for (int k = 1; k <= count; ++k)
    {
      planes.push_back(ends[i - 1] + length * k / count);
    }
  }
  return planes;
}

// its top is at the origin
inline Mesh meshOf(const Body& body)
{
  if (body.wall <= 0.0)
  {
    Mesh box = makeBox(body.size, body.edges);
    for (Vector3d& point : box.points)
    {
      const double beyond = std::max(0.0, point.x() - 0.5 * body.size.x() + 30.0_mm);
      point.z() += std::tan(body.rise) * beyond * (1.0 + point.z() / body.size.z());
      point.x() += std::tan(body.lean) * point.z() * (0.5 - point.x() / body.size.x());
    }
    return box;
  }
  const double end = 0.5 * body.size.x();
  const double foot = 25.0_mm - end;
  const std::array planes{ divided({ -end, foot, end }, body.edges),
    divided({ -0.5 * body.size.y(), 0.5 * body.size.y() }, body.edges),
    divided({ -body.size.z(), 0.0, body.wall }, body.edges) };
  return cells(planes,
    [&](const std::array<int, 3>& cell)
    { return planes[0][at(cell[0])] < foot - 1e-9 || planes[2][at(cell[2])] < -1e-9; });
}

// over that of the tissue that is pressed
inline double ratioAt(const Body& body, const Vector3d& place)
{
  const bool isBeyond = place.dot(body.border) > body.border.squaredNorm();
  return isBeyond && !body.border.isZero() ? body.ratio : 1.0;
}

// what a body is on, and how it is solved
struct Held
{
  Support support;
  double cell = 4.0_mm;
  ModulusRatio ratio{};
};

// a ball or another tool on a surface by the law that a body's compliance is to complete
inline Scene halfSpace(const Mesh& mesh, const Tip& tip, LawMode mode = LawMode::Exact)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  LawSettings settings;
  settings.mode = mode;
  settings.constitution = ConstitutiveModel::Linear;
  settings.thickness = false; // what is below is in the body's compliance
  scene.law = ForceLaw(tip, makeMaterial(kYoung, kPoisson), settings);
  scene.forceLimit = 1e3;
  return scene;
}

// the places of an organ file around one
inline void addOrgan(Scene& scene, const Held& held, const Vector3d& middle, double around)
{
  const std::span support(&held.support, 1);
  const OrganModel model(*scene.surface, held.cell, kYoung, kPoisson, support, held.ratio);
  OrganTable table;
  table.cell = held.cell;
  table.spacing = spacingOf(*scene.surface, table.cell);
  std::vector<SurfacePoint> places = organPlaces(*scene.surface, table.spacing);
  std::erase_if(
    places, [&](const SurfacePoint& place) { return (place.position - middle).norm() > around; });
  table.count = places.size();
  EXPECT_TRUE(addPlaces(table, model, *scene.surface,
    { .places = places, .supports = support, .tell = [](const OrganTable&) {} }));
  scene.series = seriesBodyOf(
    std::make_shared<const ComplianceField>(table.places, table.spacing, kPoisson), scene.law);
}

// as by an organ file around where a body is pressed
inline Scene sceneOf(const Body& body, double around)
{
  const bool isEven = body.border.isZero();
  Scene scene = halfSpace(meshOf(body), body.tip, isEven ? LawMode::Exact : LawMode::Corrected);
  Held held{ .support{ [&](const Vector3d& x) {
              return body.isLobe ? x.x() > 0.4999 * body.size.x() : x.z() < -0.9999 * body.size.z();
            } },
    .cell = body.cell };
  if (!isEven)
  {
    held.ratio = [body](const Vector3d& place) { return ratioAt(body, place); };
    Mesh near = makeBox({ 30.0_mm, 30.0_mm, 30.0_mm }, 5.0_mm); // it is told for each place
    for (Vector3d& point : near.points)
    {
      point.x() += body.place;
    }
    scene.stiffness = embedStiffness(Surface(near.points, near.triangles), scene.law,
      [body](const Vector3d& place) { return kYoung * ratioAt(body, place); });
  }
  addOrgan(scene, held, { body.place, 0.0, 0.0 }, around);
  return scene;
}

inline ToolPose at(double x, double depth, double y = 0.0)
{
  return { .apex = { x, y, -depth }, .axis = -Vector3d::UnitZ() };
}

// forces of fine finite elements with contact
inline void expectForceOfElements(const Body& body)
{
  const Scene scene = sceneOf(body, 12.0_mm);
  Scene half = scene;
  half.series = nullptr;
  const test::CsvTable table =
    test::readCsv(std::string(PALP_SOURCE_DIR "/data/reference/organ_") + body.file + ".csv");
  double worst = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < table["depth_m"].size(); ++i)
  {
    const double depth = table["depth_m"][i];
    const double force = table["force_N"][i];
    const double felt = step(scene, at(body.place, depth)).response.force;
    EXPECT_NEAR(felt, force, body.limit * force) << depth;
    worst = std::max(worst, std::abs(felt / force - 1.0));
    before =
      std::max(before, std::abs(step(half, at(body.place, depth)).response.force / force - 1.0));
  }
  testing::Test::RecordProperty("error_percent", std::to_string(100.0 * worst));
  testing::Test::RecordProperty("half_space_percent", std::to_string(100.0 * before));
  EXPECT_LT(worst, before);
}

// work of the hand over a way of poses
inline double workOver(const Scene& scene, int steps, const std::function<ToolPose(double)>& path)
{
  double work = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const Vector3d move = path((i + 1.0) / steps).apex - path(static_cast<double>(i) / steps).apex;
    work -= step(scene, path((i + 0.5) / steps)).force.dot(move);
  }
  return work;
}

// what a press, a slide and a lift give, over the press's work
inline double gainOfLoop(const Scene& scene, double from, double to)
{
  const double pressed = workOver(scene, 600, [&](double t) { return at(from, 5.0_mm * t); });
  const double along =
    workOver(scene, 1500, [&](double t) { return at(from + (to - from) * t, 5.0_mm); });
  const double lifted = workOver(scene, 600, [&](double t) { return at(to, 5.0_mm * (1.0 - t)); });
  return std::abs(pressed + along + lifted) / pressed;
}

} // namespace palp::test
