#pragma once

#include <QString>
#include <QStringList>

namespace palp
{

/// How a program of ours ended.
struct EndedProgram
{
  int code;     ///< exit code; -1: it crashed, or could not be started
  QString said; ///< last, in one sentence
};

/// Runs a program of ours to its end on a thread of Background, whose follower is told what it
/// tells of its progress; work that is given up ends it, and it leaves nothing behind.
/// @param name  in our prefix
[[nodiscard]] EndedProgram runProgram(const char* name, const QStringList& arguments);

/// @throws Error  BadFile: what it said, unless it ended well
void throwUnlessWell(const EndedProgram& ended);

} // namespace palp
