#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// Runs a program; its standard error goes nowhere.
///
/// @param command  path of the program, and its arguments; no shell reads them
/// @return         what it wrote to standard output; nothing when it failed or crashed
/// @throws Error   BadFile: it cannot be started; as checkWanted, which ends it
[[nodiscard]] std::optional<std::string> outputOf(const std::vector<std::string>& command);

/// Runs a program that answers, so that a crash there is an answer here.
/// It gets no environment.
///
/// A program rather than a fork of this one: that would hold for ever the locks that other threads
/// hold at that moment.
///
/// @param command  path of a program whose main function is answer, and its arguments
/// What it tells of its progress goes to who follows the work of this thread (followed_work.h);
/// work that is given up ends the program at once.
///
/// @return         nothing when the program crashed, or reached a limit
/// @throws Error   what the work threw; BadFile when the program cannot be started; as checkWanted
[[nodiscard]] std::optional<std::string> answerOf(const std::vector<std::string>& command);

/// What a process may use before it is ended.
struct ChildLimits
{
  std::uint64_t memory; ///< [bytes]
  std::uint64_t time;   ///< of the processor [s]
};

/// Main function of a program that answers: limits itself, does the work, and writes what that
/// returns or throws to standard output.
///
/// The work runs in a sandbox (sandbox.h) and ends with the program that asked. Whatever else
/// prints, prints nothing, and a crash leaves no core file.
///
/// @param readable  files or folders that the work may read
[[noreturn]] void answer(const std::function<std::string()>& work, ChildLimits limits,
  const std::vector<std::filesystem::path>& readable = {});

/// Within such work: what is answered if it crashes from here on, an error of this file; an empty
/// path takes that back.
void blameForACrash(const std::filesystem::path& file);

/// Within such work: how much of it is done, 0 to 1; elsewhere nothing.
void answerProgress(double done);

} // namespace palp
