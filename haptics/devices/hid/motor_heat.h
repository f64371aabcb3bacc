#pragma once

#include <array>

namespace palp
{

/// What three motors and their amplifiers have taken up: I^2 t of first order.
///
/// A cold motor bears its peak current for the peak time and its continuous current for ever; in
/// between, the mean of I^2 over a time constant that follows from the two may not pass the
/// square of the continuous current.
/// @source  2 A for 4 s: forsslund/haptikfabrikenapi, fsusbhapticdevicethread.cpp, of its
/// amplifiers
class MotorHeat
{
public:
  /// @param peak        [A]
  /// @param continuous  below the peak [A]
  /// @param peakTime    [s]
  MotorHeat(double peak, double continuous, double peakTime) noexcept;

  /// Takes up the currents that flowed until now, then shortens new ones, all alike, as far as the
  /// hottest motor needs.
  /// @param currents  that flow from now on [A], at most the peak each
  /// @param dt        since the last call [s]
  /// @return          what is left of each, 0 to 1
  /// @realtime        no allocation, no lock, no exception
  double take(std::array<double, 3>& currents, double dt) noexcept;

  /// Of the hottest motor: 1 is where only the continuous current is left.
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] double fraction() const noexcept;

private:
  double peak_;
  double continuous_;
  double timeConstant_;             // [s]
  std::array<double, 3> squares_{}; // mean of I^2 [A^2]
  std::array<double, 3> flowing_{}; // since the last call [A]
};

} // namespace palp
