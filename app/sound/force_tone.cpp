#include "app/sound/force_tone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{

double ForceTone::pitchOf(double force) noexcept
{
  constexpr double kPitch = 220.0; // [Hz] of that force
  constexpr double kForce = 0.1;   // [N]
  constexpr double kHighest = 7040.0;
  return std::min(kHighest, kPitch * std::sqrt(force / kForce));
}

void ForceTone::fill(double force, std::span<float> samples) noexcept
{
  constexpr double kLeast = 0.01;    // [N]
  constexpr double kLoudness = 0.25; // of what a speaker can
  constexpr double kRise = 0.01;     // [s]
  const bool isHeard = std::isfinite(force) && force >= kLeast;
  const double wanted = isHeard ? pitchOf(force) : pitch_; // what fades keeps its pitch
  const double step = 1.0 / (kRise * rate_);
  for (float& sample : samples)
  {
    loudness_ += step * ((isHeard ? kLoudness : 0.0) - loudness_);
    pitch_ = pitch_ > 0.0 ? pitch_ + step * (wanted - pitch_) : wanted;
    turn_ += pitch_ / rate_;
    turn_ -= std::floor(turn_);
    sample = static_cast<float>(loudness_ * std::sin(2.0 * std::numbers::pi * turn_));
  }
}

} // namespace palp
