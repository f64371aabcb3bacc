#pragma once

#include "haptics/servo/scene.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/support/shipped_ratios.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palp::test
{

using namespace units::literals;

template <typename What>
struct Named
{
  std::string name;
  What what;
};

/// Without the triangles about the origin.
inline Mesh withHole(Mesh mesh, double radius)
{
  const auto isWithin = [&](const Triangle& t)
  {
    return std::ranges::any_of(
      t, [&](int i) { return mesh.first[static_cast<std::size_t>(i)].norm() < radius; });
  };
  std::erase_if(mesh.second, isWithin);
  return mesh;
}

/// Some of its triangles twice, some turned over, some without an area.
inline Mesh damaged(Mesh mesh)
{
  const std::vector<Triangle> whole = mesh.second;
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    const auto [a, b, c] = whole[i];
    if (i % 7 == 0)
    {
      mesh.second.push_back(whole[i]);
    }
    if (i % 11 == 0)
    {
      std::swap(mesh.second[i][0], mesh.second[i][1]);
    }
    if (i % 13 == 0)
    {
      mesh.second.push_back({ c, b, a });
    }
    if (i % 17 == 0)
    {
      mesh.second.push_back({ a, a, b });
    }
  }
  return mesh;
}

/// Of cubes, as a segmentation has it.
inline Mesh inSteps(Mesh mesh, double step)
{
  for (Eigen::Vector3d& point : mesh.first)
  {
    point = step * (point.array() / step).round();
  }
  return mesh;
}

/// What people load, and what no one should.
inline std::vector<Named<std::shared_ptr<const Surface>>> oddSurfaces()
{
  const Mesh flat = sheet(0.1, 11);
  const Mesh both = withCopyAt(flat, Eigen::Vector3d::Zero());
  Mesh twoSided = both;
  for (std::size_t i = flat.second.size(); i < both.second.size(); ++i)
  {
    std::swap(twoSided.second[i][0], twoSided.second[i][1]);
  }
  const auto wave = [](double x, double y) { return 0.004 * std::sin(80.0 * x + 50.0 * y); };
  const std::vector<Named<Mesh>> meshes{ { "block", block({ 0.1, 0.1, 0.05 }, 8) },
    { "ball", ball(50.0_mm, 8) }, { "plate", block({ 0.06, 0.06, 0.2_mm }, 6) }, { "sheet", flat },
    { "waves", sheet(0.1, 21, wave) }, { "sheet with a hole", withHole(flat, 25.0_mm) },
    { "ball with a hole", withHole(moved(ball(50.0_mm, 8), { 0.0, 0.0, 0.05 }), 30.0_mm) },
    { "sheets back to back", twoSided },
    { "sheets side by side", withCopyAt(flat, { 0.1, 0.0, 0.0 }) },
    { "damaged block", damaged(block({ 0.1, 0.1, 0.05 }, 5)) }, { "damaged sheet", damaged(flat) },
    { "triangle", { { { 0, 0, 0 }, { 0.02, 0, 0 }, { 0, 0.03, 0 } }, { { 0, 1, 2 } } } },
    { "needle", { { { 0, 0, 0 }, { 0.05, 0, 0 }, { 0, 1e-9, 0 } }, { { 0, 1, 2 } } } },
    { "1 mm", ball(0.5_mm, 4) }, { "10 m", block({ 10.0, 10.0, 10.0 }, 4) },
    { "steps", inSteps(ball(50.0_mm, 10), 5.0_mm) },
    { "1 km off", moved(ball(50.0_mm, 8), { 1e3, -1e3, 1e3 }) },
    { "sheet 1 km off", moved(flat, { 1e3, -1e3, 1e3 }) } };
  std::vector<Named<std::shared_ptr<const Surface>>> surfaces;
  surfaces.reserve(meshes.size());
  for (const auto& [name, mesh] : meshes)
  {
    surfaces.push_back({ name, std::make_shared<const Surface>(makeSurface(mesh)) });
  }
  return surfaces;
}

inline std::vector<Named<Tip>> allTips()
{
  const auto profile = std::make_shared<const Profile>(std::vector<Profile::Point>{
    { 0.0, 0.0 }, { 2.0_mm, 0.3_mm }, { 5.0_mm, 2.0_mm }, { 8.0_mm, 8.0_mm } });
  return { { "sphere", SphereTip{ 10.0_mm } }, { "grain", SphereTip{ 0.1_mm } },
    { "globe", SphereTip{ 1.0 } }, { "cone", ConeTip{ 45.0_deg, 10.0_mm } },
    { "pin", ConeTip{ 1.0_deg, 0.1_mm } }, { "wedge", ConeTip{ 89.0_deg, 1.0 } },
    { "punch", PunchTip{ 5.0_mm } }, { "truncated", TruncatedConeTip{ 30.0_deg, 1.0_mm, 8.0_mm } },
    { "blunt", BluntConeTip{ 30.0_deg, 1.0_mm, 8.0_mm } },
    { "paraboloid", ParaboloidTip{ 10.0_mm } }, { "profile", ProfileTip{ profile } } };
}

/// Whether it can be had for a tip is told by ForceLaw.
inline std::vector<Named<LawSettings>> allLaws()
{
  const LawSettings corrected{ .mode = LawMode::Corrected,
    .constitution = ConstitutiveModel::Linear };
  std::vector<Named<LawSettings>> laws{ { "paper", {} }, { "exact", { .mode = LawMode::Exact } },
    { "corrected", corrected } };
  const auto with = [&](const std::string& name, auto change)
  {
    laws.push_back({ name, corrected });
    change(laws.back().what);
  };
  with("neo-Hookean",
    [](LawSettings& of)
    {
      of.constitution = ConstitutiveModel::NeoHookean;
      of.largeStrain = shippedRatios();
    });
  with("slipping", [](LawSettings& of) { of.base = Base::Slip; });
  with("flat", [](LawSettings& of) { of.curvature = false; });
  with("deep", [](LawSettings& of) { of.thickness = false; });
  with("upright", [](LawSettings& of) { of.inclination = false; });
  with("coated", [](LawSettings& of) { of.coatings.add({ 1.0_mm, { 100.0_kPa, 0.4 } }); });
  with("relaxing",
    [](LawSettings& of)
    {
      of.relaxation.add({ 0.4, 0.1 });
      of.relaxation.add({ 0.4, 10.0 });
    });
  with("rubbing", [](LawSettings& of) { of.friction = 0.5; });
  with("all",
    [](LawSettings& of)
    {
      of.constitution = ConstitutiveModel::NeoHookean;
      of.largeStrain = shippedRatios();
      of.relaxation.add({ 0.9, 1.0_ms });
      of.friction = 10.0;
    });
  return laws;
}

} // namespace palp::test
