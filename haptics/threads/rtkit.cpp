#include "haptics/threads/rtkit.h"

#include "haptics/files/prefix.h"

#include <array>
#include <cerrno>
#include <spawn.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palp
{

// by a program of its own, so that no other links a library for the bus
bool askRtkit(pid_t thread)
{
  constexpr rlim_t kLongest = 200'000; // [us], RealtimeKit's RTTimeUSecMax
  rlimit limit{};
  if (getrlimit(RLIMIT_RTTIME, &limit) != 0)
  {
    return false;
  }
  limit.rlim_max = limit.rlim_max < kLongest ? limit.rlim_max : kLongest;
  limit.rlim_cur = limit.rlim_max;
  if (setrlimit(RLIMIT_RTTIME, &limit) != 0)
  {
    return false;
  }
  std::string program = (prefix() / "bin/palp-rtkit").string();
  std::string process = std::to_string(getpid());
  std::string number = std::to_string(thread);
  std::array<char*, 4> arguments{ program.data(), process.data(), number.data(), nullptr };
  pid_t child = -1;
  if (posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ) != 0)
  {
    return false;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
  {
    if (errno != EINTR)
    {
      return false;
    }
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace palp
