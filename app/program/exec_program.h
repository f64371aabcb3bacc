#pragma once

#include <string>

namespace palp
{

/// Keeps the arguments of main for commandLine() and execProgram().
/// @param arguments  as main gets them; they live as long as the process
void setArguments(char** arguments);

/// A word for a shell; on one line whatever it holds.
[[nodiscard]] std::string quoted(const std::string& word);

/// How this process was started, as for a shell, without --out and --overwrite; empty in a test.
[[nodiscard]] std::string commandLine();

/// Turns this process into a sibling program with the arguments it was started with.
/// @throws Error  NoPicture: the sibling is not installed beside this program
[[noreturn]] void execProgram(const char* name);

} // namespace palp
