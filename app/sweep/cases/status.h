#pragma once

#include "app/sweep/manifest.h"

#include <string>
#include <vector>

namespace palp
{

/// A case that failed the last time it was computed.
struct FailedCase
{
  std::size_t number;
  std::string sentence;
  std::filesystem::path log;
};

/// How far a sweep is.
struct SweepStatus
{
  std::size_t count = 0;
  std::size_t done = 0;
  std::size_t running = 0; ///< by a runner that lives, or may
  std::vector<FailedCase> failed{};
  double secondsEach = 0.0; ///< median of those that are done; 0: none is

  [[nodiscard]] std::size_t waiting() const
  {
    return count - done - running - failed.size();
  }
};

[[nodiscard]] SweepStatus statusOf(Manifest& manifest);

/// For people: a line, and one for each of the first failures.
[[nodiscard]] std::string describe(const SweepStatus& status, const SweepHead& head);

} // namespace palp
