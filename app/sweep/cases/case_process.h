#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace palp
{

/// What a program left that has ended.
struct Ended
{
  pid_t process = -1;
  int status = 0;      ///< as wait() tells it
  double memory = 0.0; ///< most of it that was resident [bytes]
};

/// Starts a program that ends with this process, whatever ends that. It obeys the usual signals.
///
/// @param words  of its command line, the path of the program first
/// @param out    file for its standard output
/// @param log    file for its standard error
/// @throws Error BadFile: cannot be started, or a file not written
[[nodiscard]] pid_t startProcess(const std::vector<std::string>& words,
  const std::filesystem::path& out, const std::filesystem::path& log);

/// One that has ended; process is -1 where none has.
[[nodiscard]] Ended endedProcess();

/// Whether a program that did its work had a warning.
[[nodiscard]] bool hasWarning(const std::filesystem::path& log);

/// Why a program failed, in one sentence: its last words, or the signal that ended it.
[[nodiscard]] std::string lastWords(const std::filesystem::path& log, int status);

/// Of a full disk the next case would fail, too.
/// @param sentence  why a case failed; empty: it did not
/// @param number    of the case
/// @throws Error    BadFile: a full disk is why
void refuseFull(const std::string& sentence, std::size_t number);

} // namespace palp
