#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>

namespace palp
{

/// How many cases a sweep is measured by.
struct BenchedSweep
{
  std::size_t planned = 10'000; ///< with results that nobody computed
  std::size_t computed = 40;    ///< short ones, for what each costs
  std::size_t timed = 40;       ///< long ones, for what several cores give
  unsigned rounds = 2;          ///< of these
};

/// Writes what a sweep costs on the disk of a folder: to plan, to ask how far it is and to merge;
/// per case beyond the case's own command; and how much faster it is on all cores.
/// @param folder   made here, gone at the end
/// @throws Error   BadFile: it is there, or cannot be written
void reportSweep(std::ostream& out, const std::filesystem::path& folder, const BenchedSweep& count);

} // namespace palp
