#pragma once

#include <chrono>
#include <cstddef>
#include <pthread.h>
#include <span>
#include <string>
#include <sys/types.h>

namespace palp
{

/// Asks the system, else RealtimeKit, to run a thread before all others, and to keep the program's
/// memory in place.
///
/// @param number  of the thread in the kernel
/// @param locked  keep it; takes several times the memory, so only where a hand feels a late tick
/// @param own     of the thread, locked with the top of its stack where the system locks no more
/// @return  in plain words what was granted, and which limit to raise where something was not
[[nodiscard]] std::string makeRealtime(
  pthread_t thread, pid_t number, bool locked, std::span<const std::byte> own = {});

/// Keeps a thread on one processor.
/// @return  whether the system lets it
[[nodiscard]] bool stayOn(pthread_t thread, int processor) noexcept;

/// Sleeps until a point in time, which no interruption between its reading and the sleep can shift.
/// @realtime  waits; no allocation, no lock, no exception
void sleepUntil(std::chrono::steady_clock::time_point due) noexcept;

} // namespace palp
