#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palp
{

/// The last stretch of a signal as columns of a plot: the least and the largest value in each.
///
/// Keeps what the eye can see of any number of samples; adding one costs the same however many
/// there were. The columns begin narrow and double as the signal grows, up to the whole span; from
/// then on the oldest are forgotten.
class SampleColumns
{
public:
  struct Column
  {
    double start; ///< of the column [s]
    double least;
    double largest;
    bool isFalling; ///< the least came last, so that a line through both goes on from where it was
  };

  /// @param span   of time kept [s], more than 0
  /// @param count  columns in it, at least 1
  SampleColumns(double span, std::size_t count)
    : widest_(span / static_cast<double>(count))
    , width_(widest_ / kNarrow)
    , slots_(count)
  {
  }

  /// @param time   [s], 0 or more and never less than before; samples that are not finite are left
  ///               out
  /// @realtime     no allocation, no lock, no exception
  void add(double time, double value) noexcept
  {
    if (!std::isfinite(time) || !std::isfinite(value) || time < 0.0)
    {
      return;
    }
    const auto count = static_cast<std::int64_t>(slots_.size());
    while (time >= width_ * static_cast<double>(count) && width_ < widest_)
    {
      joinPairs();
    }
    const auto index = static_cast<std::int64_t>(time / width_);
    if (index < newest_)
    {
      return;
    }
    // what lies between the last sample and this one is empty
    for (std::int64_t i = std::max(newest_ + 1, index - count + 1); i <= index; ++i)
    {
      slots_[static_cast<std::size_t>(i % count)] = Slot{};
    }
    newest_ = index;
    slots_[static_cast<std::size_t>(index % count)].join({ value, value, false, true });
  }

  /// Forgets everything.
  void clear() noexcept
  {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    newest_ = -1;
    width_ = widest_ / kNarrow;
  }

  /// Calls with each column that has a sample, oldest first.
  template <typename Function>
  void forEach(Function function) const
  {
    const auto count = static_cast<std::int64_t>(slots_.size());
    for (std::int64_t i = std::max<std::int64_t>(0, newest_ - count + 1); i <= newest_; ++i)
    {
      const Slot& slot = slots_[static_cast<std::size_t>(i % count)];
      if (slot.filled)
      {
        function(
          Column{ static_cast<double>(i) * width_, slot.least, slot.largest, slot.isFalling });
      }
    }
  }

private:
  static constexpr double kNarrow = 16.0; // a power of two: how much narrower the first columns are

  struct Slot
  {
    double least = 0.0;
    double largest = 0.0;
    bool isFalling = false;
    bool filled = false;

    // with what came after it
    void join(const Slot& later) noexcept
    {
      if (!filled || !later.filled)
      {
        *this = filled ? *this : later;
        return;
      }
      const bool isLess = later.least <= least;
      const bool isMore = later.largest >= largest;
      isFalling = isLess == isMore ? (isLess ? later.isFalling : isFalling) : isLess;
      least = std::min(least, later.least);
      largest = std::max(largest, later.largest);
    }
  };

  // only while no column has been forgotten, so that column i is slot i
  void joinPairs() noexcept
  {
    const auto half = static_cast<std::size_t>(newest_ / 2);
    for (std::size_t i = 0; newest_ >= 0 && i <= half; ++i)
    {
      Slot pair = slots_[2 * i];
      if (2 * i + 1 <= static_cast<std::size_t>(newest_))
      {
        pair.join(slots_[2 * i + 1]);
      }
      slots_[i] = pair;
    }
    newest_ = newest_ >= 0 ? newest_ / 2 : -1;
    width_ *= 2.0;
  }

  double widest_; // columns of the whole span [s]
  double width_;  // of a column now [s]
  std::vector<Slot> slots_;
  std::int64_t newest_ = -1; // column of the last sample, counted from time 0
};

} // namespace palp
