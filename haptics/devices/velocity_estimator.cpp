#include "haptics/devices/velocity_estimator.h"

#include <algorithm>
#include <limits>

namespace palp
{
namespace
{

constexpr double kTouching = 1.0 + 1e-9; // of a quantum: encoders are often a whole one off
// the sum of ten periods may be a rounding error more than ten times a period
constexpr double kLongestWindow = 2.0 * VelocityEstimator::kLongestDelay * (1.0 + 1e-9); // [s]

} // namespace

Eigen::Vector3d VelocityEstimator::operator()(const Eigen::Vector3d& position, double dt) noexcept
{
  if (!(dt > 0.0) || !position.allFinite())
  {
    return Eigen::Vector3d::Zero();
  }
  std::ranges::for_each(ages_, [dt](double& age) { age += dt; });
  newest_ = (newest_ + 1) % kPositions;
  positions_[newest_] = position;
  ages_[newest_] = 0.0;
  count_ = std::min(count_ + 1, kPositions);
  return count_ < 2 ? Eigen::Vector3d::Zero() : Eigen::Vector3d{ axis(0), axis(1), axis(2) };
}

double VelocityEstimator::axis(int which) const noexcept
{
  const double newest = positions_[newest_][which];
  double velocity = 0.0;
  double least =
    -std::numeric_limits<double>::infinity(); // slopes of lines that pass by all others
  double largest = -least;
  for (std::size_t window = 1; window < count_; ++window)
  {
    if (window > 1 && ages_[slot(window)] > kLongestWindow)
    {
      break;
    }
    const double age = ages_[slot(window)];
    const double slope = (newest - positions_[slot(window)][which]) / age;
    if (slope < least || slope > largest)
    {
      break;
    }
    velocity = slope;
    if (quantum_ == 0.0)
    {
      break;
    }
    least = std::max(least, slope - kTouching * quantum_ / age);
    largest = std::min(largest, slope + kTouching * quantum_ / age);
  }
  return velocity;
}

} // namespace palp
