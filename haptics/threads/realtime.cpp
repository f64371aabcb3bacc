#include "haptics/threads/realtime.h"

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

} // namespace

std::string makeRealtime(pthread_t thread, bool locked)
{
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  const int refused = pthread_setschedparam(thread, SCHED_FIFO, &wanted);
  const std::string words = refused == 0
    ? "real-time priority (SCHED_FIFO " + std::to_string(kPriority) + ")"
    : "normal priority: SCHED_FIFO refused (" + std::generic_category().message(refused) +
      "); raise rtprio to " + std::to_string(kPriority) + " in /etc/security/limits.d";

  if (!locked)
  {
    return words + "; memory not locked: no hand feels this device";
  }
  if (mayLockMemory() && mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
  {
    return words + ", memory locked";
  }
  return words + "; memory not locked: raise memlock to unlimited in /etc/security/limits.d";
}

} // namespace palp
