#pragma once

#include "app/sweep/sweep.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace palp
{

/// The options of a command that a sweep may set, without their dashes.
struct CommandOptions
{
  std::set<std::string> values; ///< take a value
  std::set<std::string> flags;  ///< are there or not: true or false
  std::set<std::string> own{};  ///< has, too, but no case may set them
};

/// The values with every {name} in them replaced by the value of that name, and {{ by a brace.
/// @throws Error  BadValue: a name that nothing has, or a circle of names
[[nodiscard]] SweepValues filledIn(const SweepValues& values);

/// The names that stand in braces in a text.
[[nodiscard]] std::vector<std::string> namesIn(const std::string& text);

/// The file that a value names; empty: none.
[[nodiscard]] std::string fileOf(const std::string& option, const std::string& value);

/// All files that the options of a case name.
[[nodiscard]] std::vector<std::string> filesOf(const SweepValues& options);

/// The same value with its file beside a folder, unless that is an absolute path.
[[nodiscard]] std::string besideFolder(
  const std::string& option, const std::string& value, const std::filesystem::path& folder);

/// What names a case: everything that decides its result.
///
/// @param kind     the command
/// @param options  of the case, filled in
/// @param files    SHA-256 of every file that they name, which stands for its path
/// @return         32 hexadecimal digits, of SHA-256, the program's version included
[[nodiscard]] std::string caseName(const std::string& kind, const SweepValues& options,
  const std::map<std::string, std::string>& files);

/// The words of the command line that is the case, the command first.
/// @param flags  of the command
[[nodiscard]] std::vector<std::string> caseWords(
  const std::string& kind, const SweepValues& options, const std::set<std::string>& flags);

} // namespace palp
