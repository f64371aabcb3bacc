#pragma once

#include "app/sweep/cases/runner.h"

#include <vector>

namespace palp
{

/// What a case took, in seconds and bytes of memory.
struct CaseCost
{
  double seconds;
  double memory;
};

/// Computes pilot cases one after the other.
/// @return        the longest time and the largest memory of any of them
/// @throws Error  as runCases; NoSolution: one of them failed; BadFile: a record is damaged
[[nodiscard]] CaseCost runPilots(Manifest& manifest, const std::vector<std::size_t>& pilots);

/// @param otherwise  what else the user may do, after a comma
/// @throws Error     NoSolution: cases failed
void refuseFailed(const RunOutcome& outcome, const std::filesystem::path& folder,
  const std::string& otherwise = "");

} // namespace palp
