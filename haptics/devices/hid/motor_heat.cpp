#include "haptics/devices/hid/motor_heat.h"

#include <algorithm>
#include <cmath>

namespace palp
{

// peak^2 (1 - exp(-peakTime / timeConstant)) = continuous^2
MotorHeat::MotorHeat(double peak, double continuous, double peakTime) noexcept
  : peak_(peak)
  , continuous_(continuous)
  , timeConstant_(-peakTime / std::log1p(-(continuous * continuous) / (peak * peak)))
{
}

double MotorHeat::fraction() const noexcept
{
  return *std::max_element(squares_.begin(), squares_.end()) / (continuous_ * continuous_);
}

double MotorHeat::take(std::array<double, 3>& currents, double dt) noexcept
{
  constexpr double kTaper = 0.95; // from here on the peak goes over into the continuous current
  const double kept = std::exp(-std::max(0.0, dt) / timeConstant_);
  double shortened = 1.0;
  for (std::size_t i = 0; i < currents.size(); ++i)
  {
    squares_[i] = kept * squares_[i] + (1.0 - kept) * flowing_[i] * flowing_[i];
    const double heat = squares_[i] / (continuous_ * continuous_);
    const double share = std::clamp((1.0 - heat) / (1.0 - kTaper), 0.0, 1.0);
    const double most = continuous_ + share * (peak_ - continuous_);
    shortened =
      std::min(shortened, std::abs(currents[i]) > most ? most / std::abs(currents[i]) : 1.0);
  }
  for (std::size_t i = 0; i < currents.size(); ++i)
  {
    flowing_[i] = currents[i] *= shortened;
  }
  return shortened;
}

} // namespace palp
