#include "app/report/references.h"

#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>

namespace palp::report
{
namespace
{

using namespace units::literals;

BlockPress spherePress(double radius, double height, const char* name, const char* table,
  const char* neoHookean, const char* linear, const char* corotated)
{
  const Tip tip = SphereTip{ radius };
  return { name, tip, tip, height, radius, table, neoHookean, linear, corotated };
}

BlockPress conePress(double base, double height, const char* name, const char* table,
  const char* neoHookean, const char* linear, const char* corotated)
{
  return { name, BluntConeTip{ .halfAngle = 45.0_deg, .tipRadius = 0.3_mm, .baseRadius = base },
    ConeTip{ .halfAngle = 45.0_deg, .baseRadius = base }, height, base, table, neoHookean, linear,
    corotated };
}

} // namespace

const std::array<BlockPress, 4>& presses()
{
  static const std::array<BlockPress, 4> kPresses{
    spherePress(6.0_mm, 30.0_mm, "sphere R6 H30", "sphere_r6_h30", "fig15_sphere_R6__NH_h0.25",
      "fig15_sphere_R6__LINS_h0.25", "fig15_sphere_R6__COROT_h1"),
    spherePress(10.0_mm, 50.0_mm, "sphere R10 H50", "sphere_r10_h50", "calib_sphere_R10__NH_h0.5",
      "calib_sphere_R10__LINS_h0.25", "calib_sphere_R10__COROT_h1"),
    conePress(6.0_mm, 30.0_mm, "cone R6 H30", "cone45_r6_h30", "fig15_cone45__NH_h0.25",
      "fig15_cone45__LINS_h0.25", "fig15_cone45__COROT_h0.5"),
    conePress(10.0_mm, 50.0_mm, "cone R10 H50", "cone45_r10_h50", "calib_cone45__NH_h0.5",
      "calib_cone45__LINS_h0.25", "calib_cone45__COROT_h0.5"),
  };
  return kPresses;
}

ReferenceForces referenceForces(const BlockPress& press, fem::StrainEnergy energy)
{
  const std::string& name = energy == fem::StrainEnergy::Linear ? press.linear
    : energy == fem::StrainEnergy::Corotated                    ? press.corotated
                                                                : press.neoHookean;
  // one table has fewer columns, its values being restored from a summary
  const char* header = name == "calib_cone45__COROT_h0.5"
    ? "delta_m,F_N,Rd05_ref_m"
    : "delta_m,F_N,a_ref_m,a_def_m,Rd05_ref_m,Rd05_def_m";
  ReferenceForces reference;
  const auto table = NumberTable::readFinite(dataFile("reference/" + name + ".csv"), header);
  for (const auto& [values, line] : table.rows)
  {
    reference.depths.push_back(values[0]);
    reference.forces.push_back(values[1]);
  }
  return reference;
}

double ReferenceSurface::sinkAt(double at) const
{
  const auto above = std::ranges::upper_bound(radius, at);
  if (above == radius.begin())
  {
    return sink.front();
  }
  if (above == radius.end())
  {
    return sink.back();
  }
  const auto i = static_cast<std::size_t>(above - radius.begin());
  const double t = (at - radius[i - 1]) / (radius[i] - radius[i - 1]);
  return (1.0 - t) * sink[i - 1] + t * sink[i];
}

std::vector<ReferenceSurface> referenceSurfaces(const BlockPress& press)
{
  std::vector<ReferenceSurface> surfaces;
  const auto file = dataFile("reference/" + press.neoHookean + "__profiles.csv");
  const auto table = NumberTable::readFinite(file, "delta_m,r_ref_m,ur_m,uz_m");
  for (const auto& [values, line] : table.rows)
  {
    if (surfaces.empty() || surfaces.back().depth != values[0])
    {
      surfaces.push_back({ .depth = values[0], .radius = {}, .sink = {} });
    }
    surfaces.back().radius.push_back(values[1] + values[2]);
    surfaces.back().sink.push_back(-values[3]);
  }
  return surfaces;
}

bool isIn(const Regime& regime, double depth, double size)
{
  constexpr double kRounding = 1e-9;
  const double relative = depth / size;
  return relative > regime.from + kRounding && relative < regime.to + kRounding;
}

ForceError forceError(const ReferenceForces& reference, std::span<const double> forces,
  const Regime& regime, double size)
{
  ForceError error;
  double most = 0.0;
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < reference.depths.size(); ++i)
  {
    if (!isIn(regime, reference.depths[i], size) || std::isnan(forces[i]))
    {
      continue;
    }
    const double off = std::abs(forces[i] - reference.forces[i]);
    most = std::max(most, reference.forces[i]);
    error.largest = std::max(error.largest, off);
    error.local = std::max(error.local, 100.0 * off / reference.forces[i]);
    squares += off * off;
    ++count;
  }
  error.largest *= 100.0 / most;
  error.rms = 100.0 * std::sqrt(squares / count) / most;
  return error;
}

} // namespace palp::report
