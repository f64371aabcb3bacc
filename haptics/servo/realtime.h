#pragma once

#include <pthread.h>
#include <string>

namespace palp
{

/// Asks the system to run a thread before all others, and to keep the program's memory in place.
///
/// @return  in plain words what was granted, and which limit to raise where something was not
[[nodiscard]] std::string makeRealtime(pthread_t thread);

} // namespace palp
