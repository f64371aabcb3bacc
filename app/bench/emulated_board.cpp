#include "app/bench/emulated_board.h"

#include "haptics/threads/realtime.h"
#include "haptics/units.h"

#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kDepths[] = { 1.00_mm, 1.15_mm };
constexpr auto kWarmUp = std::chrono::seconds(1); // in which a force starts
constexpr int kLongestRest = 12;                  // exchanges after a jump
constexpr int kShortestRest = 6;

} // namespace

EmulatedBoard::EmulatedBoard(std::chrono::duration<double> bus, Histogram& delays) noexcept
  : half_(std::chrono::duration_cast<Clock::duration>(bus / 2))
  , delays_(delays)
{
}

DeviceLimits EmulatedBoard::limits() const
{
  return { .model = "emulated board", .rendersForce = true, .maxForce = 8.0, .damping = 2.0 };
}

IoCode EmulatedBoard::tick(const Wrench& wrench, double, DriverSample& sample) noexcept
{
  const Clock::time_point begin = Clock::now();
  sleepUntil(begin + half_);
  const Clock::time_point now = Clock::now();
  takeForce(wrench.force.z(), now);
  sampleHandle(now);
  const bool started = now - opened_ > kWarmUp; // a force begins in free space
  sample = { .position = Eigen::Vector3d(0.0, 0.0, started ? -kDepths[deep_ ? 1 : 0] : 0.1_mm) };
  sleepUntil(begin + 2 * half_);
  return IoCode::Ok;
}

void EmulatedBoard::takeForce(double force, Clock::time_point now) noexcept
{
  const double here = forces_[deep_ ? 1 : 0];
  const double before = forces_[deep_ ? 0 : 1];
  if (waits_ && here > 0.0 && before > 0.0 && std::abs(force - here) < std::abs(force - before))
  {
    delays_.record(now - jumped_);
    waits_ = false;
  }
  if (rest_ == 1)
  {
    forces_[deep_ ? 1 : 0] = force;
  }
}

void EmulatedBoard::sampleHandle(Clock::time_point now) noexcept
{
  if (--rest_ <= 0)
  {
    rest_ = std::uniform_int_distribution(kShortestRest, kLongestRest)(random_);
    deep_ = !deep_;
    waits_ = true;
    jumped_ = now;
  }
}

} // namespace palp
