#include "haptics/devices/velocity_estimator.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

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
  for (std::size_t window = 1; window < count_; ++window)
  {
    if (window > 1 && ages_[slot(window)] > kLongestWindow)
    {
      break;
    }
    const double slope = (newest - positions_[slot(window)][which]) / ages_[slot(window)];
    for (std::size_t i = 1; i < window; ++i)
    {
      const double onLine = newest - slope * ages_[slot(i)];
      if (std::abs(positions_[slot(i)][which] - onLine) > quantum_)
      {
        return velocity;
      }
    }
    velocity = slope;
    if (quantum_ == 0.0)
    {
      break;
    }
  }
  return velocity;
}

} // namespace palp
