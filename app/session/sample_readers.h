#pragma once

#include "app/press/recording.h"

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

namespace palp
{

/// Lets other threads copy the samples of recordings that go on: a copy of ten minutes takes longer
/// than a picture may wait. Main thread only, but for what it hands out.
class SampleReaders
{
public:
  /// The samples as they are now, to be copied once, by any thread. Until what is returned is gone,
  /// samples may be added, but see wait().
  /// @param grows  more come
  [[nodiscard]] std::function<std::vector<Sample>()> of(
    const Recording& recording, bool grows) const;

  /// Whether anybody may still copy.
  [[nodiscard]] bool any() const noexcept
  {
    return *count_ > 0;
  }

  /// To be called before samples are moved, changed or freed.
  void wait() const noexcept;

private:
  std::shared_ptr<std::atomic<int>> count_ = std::make_shared<std::atomic<int>>(0);
};

} // namespace palp
