#include "haptics/threads/realtime.h"

#include "haptics/threads/rtkit.h"

#include <cerrno>
#include <ctime>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr int kPriority = 80; // of 1 to 99, below the kernel's own threads

// under a limit, memory locked now would make a later allocation fail
bool mayLockMemory()
{
  rlimit limit{};
  return geteuid() == 0 ||
    (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

// what a servo step reaches of it, which fits into the default limit
bool lockStack(pthread_t thread)
{
  constexpr std::size_t kDeep = 256UL << 10U; // [bytes]
  pthread_attr_t attributes;
  if (pthread_getattr_np(thread, &attributes) != 0)
  {
    return false;
  }
  void* lowest = nullptr;
  std::size_t size = 0;
  const bool known = pthread_attr_getstack(&attributes, &lowest, &size) == 0;
  pthread_attr_destroy(&attributes);
  return known && size > kDeep && mlock(static_cast<char*>(lowest) + size - kDeep, kDeep) == 0;
}

std::string raisePriority(pid_t thread)
{
  sched_param priority{};
  priority.sched_priority = kPriority;
  if (sched_setscheduler(thread, SCHED_FIFO, &priority) == 0)
  {
    return "real-time priority (SCHED_FIFO " + std::to_string(kPriority) + ")";
  }
  const std::string why = std::generic_category().message(errno);
  if (askRtkit(thread) && sched_getparam(thread, &priority) == 0 && priority.sched_priority > 0)
  {
    return "real-time priority (SCHED_RR " + std::to_string(priority.sched_priority) +
      ", by RealtimeKit)";
  }
  return "normal priority: SCHED_FIFO refused (" + why +
    "), and no RealtimeKit grants one; raise rtprio to " + std::to_string(kPriority) +
    " in /etc/security/limits.d";
}

} // namespace

std::string makeRealtime(
  pthread_t thread, pid_t number, bool locked, std::span<const std::byte> own)
{
  const std::string words = raisePriority(number);
  if (!locked)
  {
    return words + "; memory not locked: no hand feels this device";
  }
  if (mayLockMemory() && mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
  {
    return words + ", memory locked";
  }
  const bool some = mlock(own.data(), own.size()) == 0 && lockStack(thread);
  return words + (some ? "; only the thread's own memory locked" : "; memory not locked") +
    ": raise memlock to unlimited in /etc/security/limits.d";
}

bool stayOn(pthread_t thread, int processor) noexcept
{
  if (processor < 0 || processor >= CPU_SETSIZE)
  {
    return false;
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(processor), &one);
  return pthread_setaffinity_np(thread, sizeof(one), &one) == 0;
}

// steady_clock is CLOCK_MONOTONIC; sleep_until of libstdc++ would sleep for a difference
void sleepUntil(std::chrono::steady_clock::time_point due) noexcept
{
  using namespace std::chrono;
  const nanoseconds since = due.time_since_epoch();
  const timespec until{ .tv_sec = duration_cast<std::chrono::seconds>(since).count(),
    .tv_nsec = (since % std::chrono::seconds(1)).count() };
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR)
  {
  }
}

} // namespace palp
