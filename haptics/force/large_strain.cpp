#include "haptics/force/large_strain.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/smooth_step.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

namespace palp
{
namespace
{

constexpr double kNear = 0.05; // [-] or [rad], how far beyond a table of shapes or nu may be used

void checkAxis(const std::vector<double>& axis, const std::string& name, std::size_t fewest)
{
  const bool sorted = std::adjacent_find(axis.begin(), axis.end(),
                        [](double a, double b) { return !(b > a); }) == axis.end();
  if (axis.size() < fewest || !sorted)
  {
    throw Error(ErrorCode::BadValue,
      "large strain, axis of " + name + ": not increasing; give at least " +
        std::to_string(fewest) + " values in order");
  }
}

bool near(const std::vector<double>& axis, double value) noexcept
{
  return value >= axis.front() - kNear && value <= axis.back() + kNear;
}

bool within(const std::vector<double>& axis, double value) noexcept
{
  constexpr double kRounding = 1e-9;
  return value >= axis.front() - kRounding && value <= axis.back() + kRounding;
}

// the grid in a file; scale brings the second column to SI
LargeStrainGrid readGrid(
  const std::filesystem::path& file, const std::string& header, double (*scale)(double))
{
  const NumberTable table = NumberTable::readFinite(file, header);
  std::array<std::vector<double>, 3> axes;
  for (const NumberTable::Row& row : table.rows)
  {
    for (std::size_t k = 0; k < axes.size(); ++k)
    {
      axes[k].push_back(row.values[k]);
    }
  }
  for (std::vector<double>& axis : axes)
  {
    std::sort(axis.begin(), axis.end());
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
  }
  std::vector<double> ratios(axes[0].size() * axes[1].size() * axes[2].size(), 0.0);
  for (const NumberTable::Row& row : table.rows)
  {
    std::size_t index = 0;
    for (const std::size_t k : { 2U, 1U, 0U })
    {
      const auto node = std::lower_bound(axes[k].begin(), axes[k].end(), row.values[k]);
      index = index * axes[k].size() + static_cast<std::size_t>(node - axes[k].begin());
    }
    if (ratios[index] != 0.0)
    {
      throw Error(ErrorCode::BadFile, where(file, row.line) + "given twice; give each row once");
    }
    ratios[index] = row.values[3];
  }
  std::transform(axes[1].begin(), axes[1].end(), axes[1].begin(), scale);
  try
  {
    return { std::move(axes[0]), std::move(axes[1]), std::move(axes[2]), std::move(ratios) };
  }
  catch (const Error& error)
  {
    throw Error(ErrorCode::BadFile, where(file, table.lastLine) + error.what());
  }
}

} // namespace

LargeStrainGrid::LargeStrainGrid(std::vector<double> first, std::vector<double> second,
  std::vector<double> poisson, std::vector<double> ratios)
  : first_(std::move(first))
  , second_(std::move(second))
  , poisson_(std::move(poisson))
  , ratios_(std::move(ratios))
{
  checkAxis(first_, "depth", 2);
  checkAxis(second_, "shape", 1);
  checkAxis(poisson_, "Poisson's ratio", 1);
  const std::size_t count = first_.size();
  if (ratios_.size() != count * second_.size() * poisson_.size() ||
    !std::all_of(ratios_.begin(), ratios_.end(), [](double r) { return r >= 0.1 && r <= 10.0; }))
  {
    throw Error(ErrorCode::BadValue,
      "large strain: " + std::to_string(ratios_.size()) + " ratios; give " +
        std::to_string(count * second_.size() * poisson_.size()) + ", each 0.1 to 10");
  }
  slopes_.reserve(ratios_.size());
  for (std::size_t row = 0; row < ratios_.size(); row += count)
  {
    auto slopes = monotoneSlopes(first_, std::span(ratios_).subspan(row, count));
    slopes.back() = 0.0; // the ratio stays what it is beyond the last depth, without a corner
    slopes_.insert(slopes_.end(), slopes.begin(), slopes.end());
  }
}

LargeStrainGrid::Ratio LargeStrainGrid::along(std::size_t row, double first) const noexcept
{
  const std::size_t count = first_.size();
  const auto of = [&](const std::vector<double>& all)
  { return std::span(all).subspan(row * count, count); };
  const Cubic cubic = cubicAt(first_, of(ratios_), of(slopes_), first);
  const bool inside = first >= first_.front() && first <= first_.back();
  return { cubic.value, inside ? cubic.slope : 0.0, inside };
}

LargeStrainGrid::Ratio LargeStrainGrid::operator()(
  double first, double second, double poisson) const noexcept
{
  if (!near(poisson_, poisson))
  {
    return {};
  }
  Bracket s = bracket(second_, second);
  const Bracket n = bracket(poisson_, poisson);
  const std::size_t nextShape = std::min(s.low + 1, second_.size() - 1);
  if (second > second_.back() && nextShape > s.low)
  {
    // what changes from place to place pushes a tool aside: no corner there
    const double leveled = smoothMin(second, second_.back() + 0.5 * kNear, 0.5 * kNear);
    s.fraction += (leveled - second_.back()) / (second_[nextShape] - second_[s.low]);
  }
  const std::size_t nextPoisson = std::min(n.low + 1, poisson_.size() - 1);
  Ratio result{ 0.0, 0.0, within(second_, second) && within(poisson_, poisson) };
  const auto add = [&](std::size_t nu, std::size_t shape, double weight)
  {
    const Ratio one = along(nu * second_.size() + shape, first);
    result.value += weight * one.value;
    result.slope += weight * one.slope;
    result.inside = result.inside && one.inside;
  };
  add(n.low, s.low, (1.0 - n.fraction) * (1.0 - s.fraction));
  add(n.low, nextShape, (1.0 - n.fraction) * s.fraction);
  add(nextPoisson, s.low, n.fraction * (1.0 - s.fraction));
  add(nextPoisson, nextShape, n.fraction * s.fraction);
  return result;
}

bool LargeStrainGrid::covers(double second, double poisson) const noexcept
{
  return within(second_, second) && within(poisson_, poisson);
}

double largeStrainOf(double depth, double contactRadius, double thickness, double poisson) noexcept
{
  constexpr double kLargestShare = 0.5; // [-] of the thickness
  constexpr double kRoundedShare = 0.1; // [-] beyond what was fitted
  const double strain = depth / contactRadius;
  const double local = 0.28 - poisson * (0.52 + 0.52 * poisson);
  const double layer = 0.29 - poisson * (0.27 + 0.87 * poisson);
  return 1.0 + local * strain / (1.0 + 0.76 * strain) +
    layer * smoothMin(depth / thickness, kLargestShare, kRoundedShare);
}

bool isLargeStrainKnown(
  double depth, double contactRadius, double thickness, double poisson) noexcept
{
  const double nearlyKept = std::clamp((poisson - 0.3) / 0.15, 0.0, 1.0); // the volume
  return depth <= 1.6 * contactRadius && depth <= (0.4 - 0.2 * nearlyKept) * thickness;
}

LargeStrainTable readLargeStrain(
  const std::filesystem::path& sphere, const std::filesystem::path& cone)
{
  return std::make_shared<const LargeStrain>(LargeStrain{
    readGrid(sphere, "depth_over_radius,radius_over_thickness,poisson_ratio,force_ratio",
      [](double ratio) { return ratio; }),
    readGrid(
      cone, "depth_over_thickness,half_angle_deg,poisson_ratio,force_ratio", units::fromDegrees) });
}

} // namespace palp
