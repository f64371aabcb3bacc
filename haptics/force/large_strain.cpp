#include "haptics/force/large_strain.h"

#include "haptics/error.h"
#include "haptics/force/monotone_cubic.h"

#include <algorithm>
#include <span>
#include <string>

namespace palp
{
namespace
{

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

// neighbours on an axis and the weight of the upper one
struct Bracket
{
  std::size_t low = 0;
  std::size_t high = 0;
  double weight = 0.0;
  bool inside = true;
};

Bracket bracket(const std::vector<double>& axis, double value) noexcept
{
  if (axis.size() == 1)
  {
    return {};
  }
  const bool inside = value >= axis.front() && value <= axis.back();
  const double x = std::clamp(value, axis.front(), axis.back());
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto high = static_cast<std::size_t>(above - axis.begin());
  const std::size_t low = high - 1;
  return { low, high, (x - axis[low]) / (axis[high] - axis[low]), inside };
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
  const Bracket b = bracket(first_, first);
  const std::size_t low = row * first_.size() + b.low;
  const double width = first_[b.high] - first_[b.low];
  const Cubic cubic =
    hermite(b.weight, width, ratios_[low], ratios_[low + 1], slopes_[low], slopes_[low + 1]);
  return { cubic.value, first > first_.front() && first < first_.back() ? cubic.slope : 0.0,
    b.inside };
}

LargeStrainGrid::Ratio LargeStrainGrid::operator()(
  double first, double second, double poisson) const noexcept
{
  const Bracket s = bracket(second_, second);
  const Bracket n = bracket(poisson_, poisson);
  Ratio result{ 0.0, 0.0, s.inside && n.inside };
  const auto add = [&](std::size_t nu, std::size_t shape, double weight)
  {
    const Ratio one = along(nu * second_.size() + shape, first);
    result.value += weight * one.value;
    result.slope += weight * one.slope;
    result.inside = result.inside && one.inside;
  };
  add(n.low, s.low, (1.0 - n.weight) * (1.0 - s.weight));
  add(n.low, s.high, (1.0 - n.weight) * s.weight);
  add(n.high, s.low, n.weight * (1.0 - s.weight));
  add(n.high, s.high, n.weight * s.weight);
  return result;
}

} // namespace palp
