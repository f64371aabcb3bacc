#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
    forEach(0.0, std::numeric_limits<double>::infinity(), 0.0, function);
  }

  /// Calls with those of a part of the signal, joined to columns that are no wider than asked for
  /// and stay the same while the part moves on; the first and the last reach beyond it.
  ///
  /// @param from   [s]
  /// @param to     [s]
  /// @param width  of a column [s]; those kept are not divided
  template <typename Function>
  void forEach(double from, double to, double width, Function function) const
  {
    const auto count = static_cast<std::int64_t>(slots_.size());
    const std::int64_t oldest = std::max<std::int64_t>(0, newest_ - count + 1);
    const auto joined = std::max<std::int64_t>(1, static_cast<std::int64_t>(width / width_));
    const auto within = [&](double time)
    {
      const double index = std::floor(time / width_ / static_cast<double>(joined));
      return static_cast<std::int64_t>(std::clamp(index, -1.0, static_cast<double>(newest_ + 1)));
    };
    const std::int64_t last = within(to) + 1;
    for (std::int64_t i = std::max<std::int64_t>(0, within(from) - 1); i <= last; ++i)
    {
      Slot slot;
      for (std::int64_t k = std::max(oldest, i * joined); k < (i + 1) * joined && k <= newest_; ++k)
      {
        slot.join(slots_[static_cast<std::size_t>(k % count)]);
      }
      if (slot.filled)
      {
        function(Column{
          static_cast<double>(i * joined) * width_, slot.least, slot.largest, slot.isFalling });
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
