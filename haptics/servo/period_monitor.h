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
      slower_ -= ticks_[next_] > bin_ ? 1U : 0U;
    }
    ++histogram_[bin];
    slower_ += bin > bin_ ? 1U : 0U;
    ticks_[next_] = bin;
    next_ = (next_ + 1) % ticks_.size();
    leaveOutSlowest();
  }

  /// @return    [s], to a tenth of the nominal period, at least the shortest
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] double period() const noexcept
  {
    const double longest = nominal_ * static_cast<double>(bin_ + 1) / kBinsPerPeriod;
    if (bin_ > kBinsPerPeriod)
    {
      return longest;
    }
    const bool known = bin_ < kBinsPerPeriod && count_ == ticks_.size();
    return known ? std::fmax(longest, shortest_) : nominal_;
  }

private:
  static constexpr int kBinsPerPeriod = 10;
  static constexpr int kBins = 40 * kBinsPerPeriod;

  // a tick moves the bin by little: from its last place on, as period() is asked in every tick
  void leaveOutSlowest() noexcept
  {
    for (; slower_ * 100 > count_; slower_ -= histogram_[bin_])
    {
      ++bin_;
    }
    for (; bin_ > 0 && (slower_ + histogram_[bin_]) * 100 <= count_; --bin_)
    {
      slower_ += histogram_[bin_];
    }
  }

  double nominal_;
  double shortest_;
  std::array<std::uint16_t, 1000> ticks_{};
  std::array<std::uint16_t, kBins> histogram_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t bin_ = 0;    // of the slowest tick but for a hundredth of all
  std::size_t slower_ = 0; // ticks in the bins beyond
};

} // namespace palp
