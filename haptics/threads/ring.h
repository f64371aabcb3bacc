#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace palp
{

/// Every value, in order, from one writer thread to one reader thread.
///
/// A full ring drops the new value and counts it: the writer never waits. Of our own, for Boost's
/// counts no drops and would be the only reason to depend on it.
///
/// @tparam T  its copy assignment neither allocates nor throws
template <typename T>
class Ring
{
public:
  /// @param capacity  at least; rounded up to a power of two
  explicit Ring(std::size_t capacity)
    : slots_(std::bit_ceil(capacity))
  {
  }

  /// Writer thread only.
  /// @return    whether there was room
  /// @realtime  no allocation, no lock, no exception
  bool push(const T& value) noexcept
  {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == slots_.size())
    {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[end & (slots_.size() - 1)] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// Reader thread only: calls use(value) for each value that waits, oldest first.
  /// @return  how many there were
  template <typename Use>
  std::size_t drain(Use use)
  {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    const std::size_t end = end_.load(std::memory_order_acquire);
    for (std::size_t i = begin; i != end; ++i)
    {
      use(static_cast<const T&>(slots_[i & (slots_.size() - 1)]));
      begin_.store(i + 1, std::memory_order_release);
    }
    return end - begin;
  }

  /// Values that found no room, since the start. Any thread.
  [[nodiscard]] std::size_t dropped() const noexcept
  {
    return dropped_.load(std::memory_order_relaxed);
  }

private:
  static constexpr std::size_t kCacheLine = 64; // [bytes], keeps the threads off each other's lines

  std::vector<T> slots_;
  alignas(kCacheLine) std::atomic<std::size_t> begin_ = 0; // reader's
  alignas(kCacheLine) std::atomic<std::size_t> end_ = 0;   // writer's
  std::atomic<std::size_t> dropped_ = 0;
};

} // namespace palp
