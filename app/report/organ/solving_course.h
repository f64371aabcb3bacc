#pragma once

#include "app/report/organ/organ_bodies.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <span>
#include <thread>

namespace palp::report
{

/// How far several solutions are. A factorization tells nothing of itself: while one goes on, its
/// part is taken from the time of those before it, and never reaches its end.
class SolvingCourse
{
public:
  /// @param bodies  each by cells of each of the sides
  /// @param tell    part that is done, 0 to 1; called from any thread, and grows
  SolvingCourse(std::span<const OrganBody> bodies, std::span<const double> sides,
    std::function<void(double)> tell);

  /// The next one begins, and those before are done.
  /// @param side  of the cells [m]
  void begin(const OrganBody& body, double side);

private:
  using Clock = std::chrono::steady_clock;

  void show(Clock::time_point now) const;

  std::function<void(double)> tell_;
  double all_ = 0.0; // work
  Clock::time_point start_ = Clock::now();
  mutable std::mutex mutex_;
  double done_ = 0.0;         // of the work
  double now_ = 0.0;          // likewise, of what goes on
  Clock::time_point begun_{}; // when that began
  std::jthread teller_;       // last: it uses the others
};

/// Tells who follows this thread, from any thread.
[[nodiscard]] std::function<void(double)> tellFollower();

} // namespace palp::report
