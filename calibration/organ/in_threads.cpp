#include "calibration/organ/in_threads.h"

#include <dlfcn.h>

namespace palp
{

// Which BLAS there is the system decides when the program starts, by its alternatives.
std::size_t solverThreads()
{
  if (void* const set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
  {
    reinterpret_cast<void (*)(int)>(set)(1); // threads of its own would wait for ours
  }
  void* const parallel = dlsym(RTLD_DEFAULT, "openblas_get_parallel");
  const bool isForOne = parallel != nullptr && reinterpret_cast<int (*)()>(parallel)() == 0;
  return isForOne ? 1 : std::max(1U, std::thread::hardware_concurrency());
}

} // namespace palp
