#include "pipeline/deform/fitted_surfaces.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr const char* kHeader =
  "depth_mm,inner_mm,outer_mm,sink_mm,slope,control_outer_mm,control_inner_mm";
constexpr double kRest = 0.01; // [-] of the depth

// a + t (b - a) of every length and the slope
SurfaceProfile between(const SurfaceProfile& a, const SurfaceProfile& b, double t)
{
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  return { .inner = mix(a.inner, b.inner),
    .outer = mix(a.outer, b.outer),
    .sink = mix(a.sink, b.sink),
    .slope = mix(a.slope, b.slope),
    .control = { mix(a.control[0], b.control[0]), mix(a.control[1], b.control[1]) } };
}

} // namespace

FittedSurfaces FittedSurfaces::read(const std::filesystem::path& file, double scale, double deepest)
{
  constexpr std::size_t kSlope = 4; // the only column that is no length
  constexpr double kRounding = 1e-9;
  std::vector<std::vector<double>> rows;
  for (const NumberTable::Row& read : NumberTable::readFinite(file, kHeader).rows)
  {
    rows.push_back(read.values);
    for (std::size_t i = 0; i < kColumns; ++i)
    {
      rows.back()[i] *= i == kSlope ? 1.0 : scale;
    }
    if (units::fromMillimeters(rows.back().front()) > (1.0 + kRounding) * deepest)
    {
      rows.pop_back();
    }
  }
  try
  {
    return FittedSurfaces(rows);
  }
  catch (const Error& error)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": " + error.what());
  }
}

FittedSurfaces::FittedSurfaces(const std::vector<std::vector<double>>& rows)
{
  const auto meters = &units::fromMillimeters;
  for (const std::vector<double>& row : rows)
  {
    const bool isNext =
      row.size() == kColumns && meters(row[0]) > (rows_.empty() ? 0.0 : rows_.back().depth);
    if (!isNext)
    {
      throw Error(ErrorCode::BadValue,
        "fitted surfaces: needs seven columns and increasing depths; make the tables again");
    }
    rows_.push_back({ meters(row[0]),
      { .inner = meters(row[1]),
        .outer = meters(row[2]),
        .sink = meters(row[3]),
        .slope = row[4],
        .control = { meters(row[5]), meters(row[6]) } } });
  }
  if (rows_.size() < 2)
  {
    throw Error(ErrorCode::BadValue, "fitted surfaces: fewer than two rows; make the tables again");
  }
}

std::optional<SurfaceProfile> FittedSurfaces::at(double depth) const noexcept
{
  if (!(depth > 0.0))
  {
    return std::nullopt;
  }
  SurfaceProfile profile = profileAt(std::min(depth, rows_.back().depth));
  const double deeper = std::max(0.0, depth - rows_.back().depth);
  const double grown = (profile.sink + deeper) / profile.sink;
  profile.sink += deeper;
  profile.control = { grown * profile.control[0], grown * profile.control[1] };
  profile.rest = kRest * depth;
  return profile;
}

SurfaceProfile FittedSurfaces::profileAt(double depth) const noexcept
{
  const auto above = std::lower_bound(rows_.begin(), rows_.end(), depth,
    [](const DepthProfile& row, double value) { return row.depth < value; });
  if (above != rows_.begin())
  {
    const DepthProfile& below = *(above - 1);
    return between(
      below.profile, above->profile, (depth - below.depth) / (above->depth - below.depth));
  }
  return shallower(depth / above->depth);
}

// Below the first row the contact narrows by the power of the depth by which it does between the
// first two, about 1/2 for a sphere and 1 for a cone; narrower, it would overtake a bent surface
SurfaceProfile FittedSurfaces::shallower(double fraction) const noexcept
{
  const DepthProfile& first = rows_[0];
  const DepthProfile& second = rows_[1];
  const double power = std::clamp(
    std::log(second.profile.inner / first.profile.inner) / std::log(second.depth / first.depth),
    0.0, 1.0);
  SurfaceProfile profile = first.profile;
  profile.inner *= std::pow(fraction, power);
  profile.sink *= fraction;
  profile.slope *= std::pow(fraction, 1.0 - power);
  profile.control = { fraction * profile.control[0], fraction * profile.control[1] };
  return profile;
}

} // namespace palp
