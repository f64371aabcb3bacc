#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace palp
{

/// The newest value, handed from one writer thread to one reader thread.
///
/// A triple buffer: the writer owns one slot, the reader owns one, and the third changes hands by a
/// single atomic exchange. Both sides are wait-free. The reader may skip values but never sees a
/// torn or an older one.
///
/// A value is only ever destroyed by the writer, when it reuses the slot. The servo thread can
/// therefore read shared_ptr<const Surface> without ever freeing memory, which no library's queue
/// or mailbox promises.
///
/// @tparam T  copyable
template <typename T>
class Latest
{
public:
  explicit Latest(const T& initial = T{})
    : slots_{ Slot{ initial }, Slot{ initial }, Slot{ initial } }
  {
  }

  Latest(const Latest&) = delete;
  Latest& operator=(const Latest&) = delete;

  /// Writer thread only.
  void publish(T value)
  {
    slots_[back_].value = std::move(value);
    back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader thread only. The reference stays valid until the next call.
  [[nodiscard]] const T& read() noexcept
  {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0)
    {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    }
    return slots_[front_].value;
  }

private:
  static constexpr std::size_t kCacheLine = 64; // [bytes], keeps the threads off each other's lines
  static constexpr unsigned kFresh = 4;
  static constexpr unsigned kIndex = 3;

  struct alignas(kCacheLine) Slot
  {
    T value;
  };

  std::array<Slot, 3> slots_;
  alignas(kCacheLine) unsigned back_ = 0;                // writer's slot
  alignas(kCacheLine) unsigned front_ = 1;               // reader's slot
  alignas(kCacheLine) std::atomic<unsigned> middle_ = 2; // slot in transit, plus the fresh bit
  static_assert(std::atomic<unsigned>::is_always_lock_free);
};

} // namespace palp
