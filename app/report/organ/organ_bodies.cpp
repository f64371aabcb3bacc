#include "app/report/organ/organ_bodies.h"

#include "app/press/body.h"
#include "app/program/data_files.h"
#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp::report
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

ReferenceForces referenceOf(const std::string& name)
{
  const std::filesystem::path file = dataFile("reference/" + name + ".csv");
  constexpr std::array kOrgan{ "depth_m", "force_N" };
  constexpr std::array kBall{ "delta_m", "F_N" }; // of another program
  const auto table = NumberTable::readColumns(file, name.starts_with("organ") ? kOrgan : kBall);
  ReferenceForces found;
  for (const auto& [values, line] : table.rows)
  {
    constexpr double kResolved = 0.99_mm;
    if (values[0] > kResolved)
    {
      found.depths.push_back(values[0]);
      found.forces.push_back(values[1]);
    }
  }
  return found;
}

std::shared_ptr<const Surface> turned(Mesh mesh, const Eigen::Matrix3d& turn)
{
  for (Vector3d& point : mesh.points)
  {
    point = turn * point;
  }
  return std::make_shared<const Surface>(std::move(mesh.points), std::move(mesh.triangles));
}

struct BoxPress
{
  double place; // along x, from the middle of the top [m]
  const char* file;
};

// a box, held at its base, or a lobe, held at its end
struct Box
{
  const char* kind;
  const char* name;
  std::array<double, 3> size; // [m]
  double lean;                // of the side face at -x [rad]
  double turn;                // in the grid of the cells [rad]
  bool isQuick;
  std::vector<BoxPress> presses;
};

const std::vector<Box>& boxes()
{
  constexpr double kThird = std::numbers::pi / 6.0; // of a right angle
  static const std::vector<Box> all{
    { "layers", "layer of 20 mm", { 0.1, 0.1, 0.02 }, 0.0, 0.0, true, { { 0.0, "layer_20mm" } } },
    { "layers", "layer of 20 mm, turned", { 0.1, 0.1, 0.02 }, 0.0, 0.35, false,
      { { 0.0, "layer_20mm" } } },
    { "layers", "layer of 50 mm", { 0.2, 0.2, 0.05 }, 0.0, 0.0, false, { { 0.0, "layer_50mm" } } },
    { "edges", "block", { 0.1, 0.1, 0.05 }, 0.0, 0.0, true,
      { { 0.0, "edge90_centre" }, { -30.0_mm, "edge90_20mm" }, { -42.0_mm, "edge90_8mm" },
        { -44.0_mm, "edge90_6mm" }, { -46.0_mm, "edge90_4mm" }, { -48.0_mm, "edge90_2mm" } } },
    { "edges", "wedge of 120 degrees", { 0.1, 0.1, 0.05 }, kThird, 0.0, false,
      { { -42.0_mm, "edge120_8mm" } } },
    { "edges", "wedge of 60 degrees", { 0.1, 0.1, 0.05 }, -kThird, 0.0, false,
      { { -46.0_mm, "edge60_4mm" } } },
    { "lobes", "lobe of 30 mm", { 0.06, 0.1, 0.03 }, 0.0, 0.0, true,
      { { -10.0_mm, "lobe30_20mm" } } },
    { "lobes", "lobe of 30 mm, turned", { 0.06, 0.1, 0.03 }, 0.0, 0.35, false,
      { { -10.0_mm, "lobe30_20mm" } } },
    { "lobes", "lobe of 16 mm", { 0.06, 0.1, 0.016 }, 0.0, 0.0, false, { { 0.0, "lobe16_30mm" } } },
    { "lobes", "lobe of 16 mm, turned", { 0.06, 0.1, 0.016 }, 0.0, 0.35, false,
      { { 0.0, "lobe16_30mm" } } },
  };
  return all;
}

OrganBody bodyOf(const Box& box)
{
  const Vector3d size(box.size[0], box.size[1], box.size[2]);
  Mesh mesh = makeBox(size, 2.5_mm);
  for (Vector3d& point : mesh.points)
  {
    point.x() += std::tan(box.lean) * point.z() * (0.5 - point.x() / size.x());
  }
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(box.turn, Vector3d(3.0, 1.0, 2.0).normalized()).toRotationMatrix();
  const bool isLobe = box.kind == std::string("lobes");
  OrganBody body{ .kind = box.kind,
    .name = box.name,
    .surface = turned(std::move(mesh), turn),
    .support = { [=](const Vector3d& x)
      {
        constexpr double kNearly = 0.9999;
        const Vector3d at = turn.transpose() * x;
        return isLobe ? at.x() > 0.5 * kNearly * size.x() : at.z() < -kNearly * size.z();
      } } };
  for (const auto& [place, file] : box.presses)
  {
    const std::string aside =
      units::inMillimeters(0.5 * size.x() + place) + " from the " + (isLobe ? "tip" : "edge");
    body.presses.push_back({ .name = box.kind == std::string("layers") ? "middle" : aside,
      .place = { .position = turn * Vector3d(place, 0.0, 0.0), .normal = turn.col(2) },
      .reference = referenceOf(std::string("organ_") + file) });
  }
  return body;
}

// what an outline, (r, z) from the axis to the axis, sweeps around z
Mesh revolved(const std::vector<Eigen::Vector2d>& outline)
{
  constexpr int kAround = 48;
  const int rings = static_cast<int>(outline.size()) - 2;
  Mesh mesh;
  const auto at = [](int ring, int k) { return 1 + ring * kAround + k % kAround; };
  const int last = at(rings, 0);
  mesh.points.emplace_back(0.0, 0.0, outline.front().y());
  for (int ring = 0; ring < rings; ++ring)
  {
    const Eigen::Vector2d& corner = outline[static_cast<std::size_t>(ring) + 1];
    for (int k = 0; k < kAround; ++k)
    {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      mesh.points.emplace_back(
        corner.x() * std::cos(angle), corner.x() * std::sin(angle), corner.y());
    }
  }
  mesh.points.emplace_back(0.0, 0.0, outline.back().y());
  for (int k = 0; k < kAround; ++k)
  {
    mesh.triangles.push_back({ 0, at(0, k), at(0, k + 1) });
    for (int ring = 0; ring + 1 < rings; ++ring)
    {
      mesh.triangles.push_back({ at(ring, k), at(ring + 1, k), at(ring + 1, k + 1) });
      mesh.triangles.push_back({ at(ring, k), at(ring + 1, k + 1), at(ring, k + 1) });
    }
    mesh.triangles.push_back({ last, at(rings - 1, k + 1), at(rings - 1, k) });
  }
  return mesh;
}

// a dome on a cylinder, bonded at its flat base; its pole in the origin
OrganBody domeOf(
  const char* name, double radius, double side, double height, double poisson, const char* file)
{
  constexpr double kStep = 2.5_mm;
  const auto line = [](std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& to)
  {
    const Eigen::Vector2d from = points.back();
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kStep)));
    for (int i = 1; i <= parts && from != to; ++i)
    {
      points.emplace_back(from + (to - from) * i / parts);
    }
  };
  std::vector<Eigen::Vector2d> outline{ { 0.0, 0.0 } };
  const double most = std::asin(side / radius);
  const int parts = static_cast<int>(std::ceil(radius * most / kStep));
  for (int i = 1; i <= parts; ++i)
  {
    const double angle = most * i / parts;
    outline.emplace_back(radius * std::sin(angle), radius * (std::cos(angle) - 1.0));
  }
  outline.back().y() < 1e-9 - height ? void(outline.back().y() = -height)
                                     : line(outline, { side, -height });
  line(outline, { 0.0, -height });
  return { .kind = "domes",
    .name = name,
    .poisson = poisson,
    .surface = turned(revolved(outline), Eigen::Matrix3d::Identity()),
    .support = { [height](const Vector3d& x) { return x.z() < 1e-6 - height; } },
    .presses = { { .name = "pole",
      .place = { .position = Vector3d::Zero(), .normal = Vector3d::UnitZ() },
      .reference = referenceOf(file) } } };
}

// the back of its right lobe rests, the left one is free
OrganBody liver(bool quick)
{
  OrganBody body{ .kind = "liver",
    .name = "liver",
    .surface = loadBody({ { .bundled = "liver" } }, false).haptic,
    .support = { [](const Vector3d& x) { return x.x() <= -5.0_mm && x.y() >= 15.0_mm; } } };
  struct Lobe
  {
    const char* name;
    Vector3d place; // outside, over what is pressed [mm]
    Vector3d outward;
    const char* file;
  };
  const std::array lobes{
    Lobe{ "left lobe", { 65.0, -37.36, 35.0 }, { 0.1128, -0.9783, 0.1736 }, "organ_liver_left" },
    Lobe{
      "right lobe", { -45.0, -39.83, 30.0 }, { -0.1720, -0.9491, 0.2638 }, "organ_liver_right" },
  };
  for (const Lobe& lobe : std::span(lobes).first(quick ? 1 : lobes.size()))
  {
    const Vector3d outward = lobe.outward.normalized();
    const Vector3d from = 1e-3 * lobe.place + 20.0_mm * outward;
    const RayHit hit = rayEntry(body.surface->tree(), from, -outward);
    body.presses.push_back({ .name = lobe.name,
      .place = { .position = from - hit.distance * outward, .normal = outward },
      .reference = referenceOf(lobe.file) });
  }
  return body;
}

} // namespace

std::vector<OrganBody> organBodies(bool quick)
{
  std::vector<OrganBody> bodies;
  for (const Box& box : boxes())
  {
    if (box.isQuick || !quick)
    {
      bodies.push_back(bodyOf(box));
    }
  }
  bodies.push_back(domeOf("dome", 30.0_mm, 24.0_mm, 30.0_mm, 0.45, "organ_cap_R30"));
  if (!quick)
  {
    bodies.push_back(domeOf("half of a ball of 30 mm", 30.0_mm, 30.0_mm, 30.0_mm, 0.33,
      "fig3_sphere_R10_on_elastic_sphere_R0_30_hemi__LINS_h1"));
  }
  bodies.push_back(liver(quick));
  return bodies;
}

} // namespace palp::report
