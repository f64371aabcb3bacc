#pragma once

#include <span>

namespace palp
{

/// A tone whose pitch tells a force: four times the force is an octave, so that forces of one ratio
/// are one interval apart whatever they are, as hands compare them (Weber 1834).
class ForceTone
{
public:
  /// @param rate  samples a second [Hz]
  explicit ForceTone(double rate) noexcept
    : rate_(rate)
  {
  }

  /// The next samples, without a click where the force has leapt.
  ///
  /// @param force    [N]; silent below 10 mN and where it is no number
  /// @param samples  set to -0.25 to 0.25
  void fill(double force, std::span<float> samples) noexcept;

  /// @param force  [N], 0 or more
  /// @return       220 Hz at 0.1 N, at most 7,040 Hz
  [[nodiscard]] static double pitchOf(double force) noexcept;

private:
  double rate_;
  double turn_ = 0.0; // of the wave, from 0 to 1
  double pitch_ = 0.0;
  double loudness_ = 0.0;
};

} // namespace palp
