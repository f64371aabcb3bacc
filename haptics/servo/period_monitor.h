#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace palp
{

/// The period a servo loop really keeps: the 99th percentile of its last thousand ticks. Also of
/// other times that come with each tick.
class PeriodMonitor
{
public:
  /// @param nominal   [s], above 0
  /// @param shortest  that is believed after a thousand ticks [s]
  PeriodMonitor(double nominal, double shortest) noexcept
    : nominal_(nominal)
    , shortest_(shortest)
  {
  }

  explicit PeriodMonitor(double nominal) noexcept
    : PeriodMonitor(nominal, nominal)
  {
  }

  /// @param dt        since the last tick [s], 0 or more
  /// @realtime        no allocation, no lock, no exception
  void record(double dt) noexcept
  {
    const double fraction = dt / nominal_ * kBinsPerPeriod;
    const auto bin = static_cast<std::uint16_t>(fraction < kBins - 1 ? fraction : kBins - 1);
    if (count_ < ticks_.size())
    {
      ++count_;
    }
    else
    {
      --histogram_[ticks_[next_]];
    }
    ++histogram_[bin];
    ticks_[next_] = bin;
    next_ = (next_ + 1) % ticks_.size();
  }

  /// @return    [s], to a tenth of the nominal period, at least the shortest
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] double period() const noexcept
  {
    // the slowest hundredth is left out
    std::size_t slower = 0;
    std::size_t bin = kBins - 1;
    for (; bin > 0; --bin)
    {
      slower += histogram_[bin];
      if (slower * 100 > count_)
      {
        break;
      }
    }
    const double longest = nominal_ * static_cast<double>(bin + 1) / kBinsPerPeriod;
    if (bin > kBinsPerPeriod)
    {
      return longest;
    }
    const bool known = bin < kBinsPerPeriod && count_ == ticks_.size();
    return known ? std::fmax(longest, shortest_) : nominal_;
  }

private:
  static constexpr int kBinsPerPeriod = 10;
  static constexpr int kBins = 40 * kBinsPerPeriod;

  double nominal_;
  double shortest_;
  std::array<std::uint16_t, 1000> ticks_{};
  std::array<std::uint16_t, kBins> histogram_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
};

} // namespace palp
