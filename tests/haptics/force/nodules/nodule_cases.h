#pragma once

#include "haptics/force/nodules/nodules.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"

#include <string>

namespace palp::test
{

using namespace units::literals;

/// A press of the tables of finite elements on a linear bonded layer of 50 kPa.
struct NoduleCase
{
  Tip tip;
  double poisson;
  double thickness; ///< [m]
  double deepest;   ///< [m]

  [[nodiscard]] ForceLaw law() const
  {
    return { tip, Material{ 50.0_kPa, poisson },
      LawSettings{ .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear } };
  }

  [[nodiscard]] ContactGeometry place() const
  {
    return { .thickness = thickness };
  }

  [[nodiscard]] HomogeneousPress press() const
  {
    return { law(), place(), deepest };
  }
};

inline Tip tipOf(const std::string& kind, double radius)
{
  if (kind == "sphere")
  {
    return SphereTip{ radius };
  }
  if (kind == "punch")
  {
    return PunchTip{ radius };
  }
  return BluntConeTip{ 45.0_deg, radius, 50.0_mm };
}

inline Tip tipOf(const ReferenceRow& row)
{
  return tipOf(row.text("tip"), row.number("R_m"));
}

inline Nodule noduleOf(const ReferenceRow& row)
{
  return { .radius = row.number("b_m"), .top = row.number("top_m"), .ratio = row.number("k") };
}

} // namespace palp::test
