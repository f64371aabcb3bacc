#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace palp
{

/// What a child process may use before it is ended.
struct ChildLimits
{
  std::uint64_t memory; ///< [bytes]
  std::uint64_t time;   ///< of the processor [s]
};

/// Does work in a process of its own, so that a crash there is an answer here.
///
/// For readers of other people's files, which no check beforehand makes safe. The process prints
/// nothing and leaves no core file.
///
/// @param work    starts no thread and needs none; what it returns is carried over
/// @return        nothing when the process crashed, or reached a limit
/// @throws Error  what the work threw; BadFile when no process can be started
[[nodiscard]] std::optional<std::string> runInChild(
  const std::function<std::string()>& work, ChildLimits limits);

} // namespace palp
