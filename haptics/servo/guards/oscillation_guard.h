#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace palp
{

/// The net below the passivity controller: finds swings in contact that do not die away, from the
/// motion alone, whatever was stated of damping or delay, and calms the loop until the tool lifts.
///
/// A swing counts as kept up when four half periods in a row are as fast as those before. Then the
/// rendered springs are damped as if their force were late by kDelay more, which a hand that
/// palpates on purpose hardly feels; and where the swing is quicker than a hand can, they are made
/// softer, a step for every few half periods.
class OscillationGuard
{
public:
  static constexpr double kDelay = 0.006; ///< [s]

  /// @param quantum  smallest step of the positions [m]
  explicit OscillationGuard(double quantum) noexcept
    : quantum_(quantum)
  {
  }

  /// @param speed     along the normal of the contact [m/s]
  /// @param loaded    a spring is felt
  /// @param dt        since the last tick [s]
  /// @realtime        no allocation, no lock, no exception
  void record(double speed, bool loaded, double dt) noexcept
  {
    apart_ = loaded ? 0.0 : apart_ + dt;
    if (apart_ > kLifted)
    {
      *this = OscillationGuard(quantum_);
      return;
    }
    if (speed * sign_ < 0.0)
    {
      endHalfPeriod();
      sign_ = speed > 0.0 ? 1.0 : -1.0;
    }
    sign_ = sign_ == 0.0 && speed != 0.0 ? std::copysign(1.0, speed) : sign_;
    peak_ = std::fmax(peak_, std::abs(speed));
    travel_ += std::abs(speed) * dt;
    duration_ += dt;
    loaded_ += loaded ? dt : 0.0;
  }

  /// Of the stiffness that may be rendered [-].
  [[nodiscard]] double stiffnessShare() const noexcept
  {
    return share_;
  }

  /// That a damping can hold [N/m].
  [[nodiscard]] double stiffest(double damping) const noexcept
  {
    return isOn_ ? damping / kDelay : std::numeric_limits<double>::infinity();
  }

  /// For a rendered stiffness [N/m], what has to damp it [N s/m].
  [[nodiscard]] double damping(double stiffness) const noexcept
  {
    return isOn_ ? kDelay * stiffness : 0.0;
  }

private:
  static constexpr double kLifted = 2.0;      // [s]
  static constexpr double kKept = 0.95;       // of the speed of the swing before
  static constexpr double kSlowest = 0.003;   // peak speed that is felt [m/s]
  static constexpr double kQuanta = 3.0;      // of travel that are no noise
  static constexpr double kHandTakes = 0.060; // for half a period [s]
  static constexpr double kFast = 0.02;       // that growth is told by [m/s]
  static constexpr double kGrown = 1.05;      // by the half period before
  static constexpr double kSofter = 0.7;
  static constexpr double kSoftest = 0.25;
  static constexpr int kSwings = 4;

  void endHalfPeriod() noexcept
  {
    const bool isSwing = peak_ > kSlowest && travel_ > kQuanta * quantum_;
    const bool isQuick = duration_ < kHandTakes;
    const bool isTap = loaded_ > 0.0 && loaded_ < kHandTakes;
    if (isSwing && isTap && peak_ > kFast && peaks_[0] > 0.0 && peak_ > kGrown * peaks_[0])
    {
      const double ratio = peaks_[0] / peak_;
      share_ *= std::fmin(kSofter, std::fmax(ratio * ratio, kSoftest));
      isOn_ = true;
      kept_ = 0;
    }
    kept_ = isSwing && peaks_[1] > 0.0 && peak_ >= kKept * peaks_[1] ? kept_ + 1 : 0;
    if (kept_ >= kSwings)
    {
      share_ *= isOn_ && isQuick ? kSofter : 1.0;
      isOn_ = true;
      kept_ = 0;
    }
    peaks_ = { isSwing ? peak_ : 0.0, peaks_[0] };
    peak_ = 0.0;
    travel_ = 0.0;
    duration_ = 0.0;
    loaded_ = 0.0;
  }

  double quantum_;
  double share_ = 1.0;
  bool isOn_ = false;
  double apart_ = 0.0;                      // since a spring was felt [s]
  double sign_ = 0.0;                       // of the speed
  double peak_ = 0.0;                       // of this half period [m/s]
  double travel_ = 0.0;                     // [m]
  double duration_ = 0.0;                   // [s]
  double loaded_ = 0.0;                     // of it, with a spring [s]
  std::array<double, 2> peaks_{ 0.0, 0.0 }; // of the half periods before, newest first [m/s]
  int kept_ = 0;                            // half periods in a row
};

} // namespace palp
