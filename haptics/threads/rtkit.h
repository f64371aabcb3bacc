#pragma once

#include <sys/types.h>

namespace palp
{

/// Asks RealtimeKit, which desktops run, to let a thread of this program run before others, where
/// the system itself does not let the user. It demands that no such thread runs for more than 0.2 s
/// without a pause, which this process is limited to from then on.
///
/// @param thread  its number in the kernel
/// @return        whether it was granted; waits up to a second where nothing answers
[[nodiscard]] bool askRtkit(pid_t thread);

} // namespace palp
