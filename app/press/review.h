#pragma once

#include "app/press/recording.h"
#include "haptics/devices/simulated/playhead.h"

#include <span>

namespace palp
{

/// The sample nearest to a time; null where there is none.
/// @param samples  in the order of their times
/// @param time     [s]
[[nodiscard]] const Sample* nearestSample(std::span<const Sample> samples, double time) noexcept;

/// Looks at a recording again, which may grow meanwhile: from the sample before the first contact
/// to the one after the last.
class Review
{
public:
  /// @param recording  with contact
  explicit Review(const Recording& recording);

  /// Its time begins with the contact.
  [[nodiscard]] Playhead& head() noexcept
  {
    return head_;
  }

  /// What the head is at; null where nothing of the recording is left.
  [[nodiscard]] const Sample* at(const Recording& recording) const noexcept
  {
    return nearestSample(recording.samples, begin_ + head_.time());
  }

private:
  double begin_; // time in the recording [s]
  Playhead head_;
};

} // namespace palp
