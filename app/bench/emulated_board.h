#pragma once

#include "haptics/devices/driver.h"
#include "haptics/servo/timing.h"

#include <chrono>
#include <random>

namespace palp
{

/// A board at the end of a bus that makes its host wait, which finds out by its own clock how late
/// the forces are.
///
/// Now and then it says that its handle has jumped between two depths, a fraction of a millimeter
/// apart, and takes the time until a force arrives that is nearer to the one that belongs to the
/// new depth. So it needs to know nothing of who computes the force.
class EmulatedBoard final : public Driver
{
public:
  /// @param bus    from a command on its way to the state in the host [s], half of it each way
  /// @param delays from a pose to its force; outlives this
  EmulatedBoard(std::chrono::duration<double> bus, Histogram& delays) noexcept;

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  using Clock = std::chrono::steady_clock;

  void takeForce(double force, Clock::time_point now) noexcept;
  void sampleHandle(Clock::time_point now) noexcept;

  Clock::duration half_;
  Histogram& delays_;
  std::minstd_rand random_;
  Clock::time_point opened_ = Clock::now();
  Clock::time_point jumped_; // the newest jump was sampled
  bool deep_ = false;
  bool waits_ = false;              // for the force of the newest jump
  int rest_ = 0;                    // exchanges until the next jump
  double forces_[2] = { 0.0, 0.0 }; // that belong to the two depths, as last felt at rest [N]
};

} // namespace palp
