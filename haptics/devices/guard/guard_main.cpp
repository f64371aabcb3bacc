// palp-guard: outlives the program that drives an arm, and ends its force. Started by startGuard.

#include "haptics/devices/guard/sleep_notice.h"
#include "haptics/devices/guard/watch.h"

#include <cstdio>
#include <cstdlib>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <thread>

int main()
{
  void* shared = mmap(
    nullptr, sizeof(palp::GuardBlock), PROT_READ | PROT_WRITE, MAP_SHARED, palp::kGuardBlock, 0);
  if (shared == MAP_FAILED)
  {
    std::fputs("palp-guard: is started by palp where a device has motors\n", stderr);
    return 2;
  }
  auto& block = *static_cast<palp::GuardBlock*>(shared);
  // before all memory is locked, which may leave none for it; at the usual priority
  std::thread([&block] { palp::followSleep(block); }).detach();
  constexpr int kPriority = 85; // above the threads that it watches, as it only sleeps
  sched_param wanted{};
  wanted.sched_priority = kPriority;
  (void)sched_setscheduler(0, SCHED_FIFO, &wanted);
  (void)prctl(PR_SET_TIMERSLACK, 1UL);
  (void)mlockall(MCL_CURRENT | MCL_FUTURE);
  palp::watch(block, palp::kGuardDevice, palp::kGuardProgram, palp::kGuardLink);
  std::_Exit(0); // the other thread may still wait
}
