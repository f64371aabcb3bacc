#pragma once

#include "haptics/force/series/series_law.h"
#include "haptics/units.h"

namespace palp::test
{

/// A tip, by the exact law, in series with a body of 50 kPa and a Poisson's ratio of 0.45.
class SeriesPress
{
public:
  explicit SeriesPress(const Tip& tip)
    : law_(tip, makeMaterial(units::fromKilopascals(50.0), 0.45), { .mode = LawMode::Exact })
    , series_(tip, law_.material().contactModulus())
  {
  }

  SeriesResponse operator()(const BodyCompliance& body, double depth) const noexcept
  {
    return series_([this](double at) noexcept { return alone(at); }, body, depth);
  }

  [[nodiscard]] double force(const BodyCompliance& body, double depth) const noexcept
  {
    return (*this)(body, depth).felt.force;
  }

  /// On a half-space.
  [[nodiscard]] Response alone(double depth) const noexcept
  {
    return law_({ .depth = depth });
  }

  [[nodiscard]] double modulus() const noexcept
  {
    return law_.material().contactModulus();
  }

  [[nodiscard]] const SeriesLaw& series() const noexcept
  {
    return series_;
  }

private:
  ForceLaw law_;
  SeriesLaw series_;
};

} // namespace palp::test
