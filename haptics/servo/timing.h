#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace palp
{

/// Distribution of durations, counted by one thread and read by any.
///
/// Sixteen buckets to each doubling: a quantile is right within 5 %.
class Histogram
{
public:
  using Duration = std::chrono::nanoseconds;

  /// @realtime  no allocation, no lock, no exception
  void record(Duration duration) noexcept;

  /// A bound that at least a fraction of the durations stays below.
  ///
  /// @param fraction  0 to 1
  /// @return          0 when nothing was recorded; never beyond longest()
  [[nodiscard]] Duration quantile(double fraction) const noexcept;

  /// Calls f(upper bound, count) for every bucket that holds something, shortest first.
  template <typename Function>
  void forEach(const Function& f) const
  {
    for (std::size_t i = 0; i < kBuckets; ++i)
    {
      if (const std::uint64_t here = counts_[i].load(std::memory_order_relaxed); here > 0)
      {
        f(Duration(upperBound(i)), here);
      }
    }
  }

  [[nodiscard]] Duration longest() const noexcept;
  [[nodiscard]] std::uint64_t count() const noexcept;

private:
  static constexpr std::size_t kPerDoubling = 16;
  static constexpr std::size_t kBuckets = 40 * kPerDoubling; // to beyond an hour

  [[nodiscard]] static std::size_t bucket(std::uint64_t nanoseconds) noexcept;
  [[nodiscard]] static std::uint64_t upperBound(std::size_t bucket) noexcept;

  std::array<std::atomic<std::uint64_t>, kBuckets> counts_{};
  std::atomic<std::int64_t> longest_ = 0; // [ns]
};

/// How well the servo thread keeps its period.
struct Timing
{
  Histogram lateness;    ///< of the wake-up, behind its deadline
  Histogram step;        ///< contact, law and limits
  Histogram poseToForce; ///< from a pose to the force that answers it, where a bus is between
  std::atomic<double> elapsed = 0.0; ///< [s]
  std::atomic<std::uint64_t> ticks = 0;
  std::atomic<std::uint64_t> skipped = 0; ///< whole periods missed; ticks + skipped = elapsed
};

} // namespace palp
