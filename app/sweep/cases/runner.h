#pragma once

#include "app/sweep/manifest.h"

#include <vector>

namespace palp
{

/// How it went.
struct RunOutcome
{
  std::size_t computed = 0;
  std::size_t before = 0; ///< were finished already, or by another runner meanwhile
  std::vector<std::size_t> failed{};
  std::vector<std::size_t> warned{}; ///< computed, but the command had a warning
};

/// Computes cases that are not finished, each by a process of its own, several at a time; tells on
/// standard error how far it is and what failed.
///
/// A case that another runner has is waited for, and computed here where that one fails. Whatever
/// ends this process, what was finished is whole and what was not can be computed again.
///
/// @param numbers  of the cases
/// @param jobs     how many at a time, 1 or more
/// @param checks   whether finished ones count only where they are what their cases left
/// @throws Error   BadFile: a case or a file of it was edited after planning, the folder cannot be
///                 written; NoSolution: Ctrl-C or SIGTERM
[[nodiscard]] RunOutcome runCases(
  Manifest& manifest, const std::vector<std::size_t>& numbers, unsigned jobs, bool checks = false);

} // namespace palp
