#pragma once

#include <pthread.h>
#include <string>

namespace palp
{

/// Asks the system to run a thread before all others, and to keep the program's memory in place.
///
/// @param locked  keep it; takes several times the memory, so only where a hand feels a late tick
/// @return  in plain words what was granted, and which limit to raise where something was not
[[nodiscard]] std::string makeRealtime(pthread_t thread, bool locked);

} // namespace palp
