#pragma once

#include "haptics/threads/followed_work.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palp
{

/// How far long work is, on standard error: after two seconds, on a terminal as a line that is
/// written over itself every second, elsewhere as a line every ten. Where the variable
/// PALP_PROGRESS is set, as for a program that follows, a line "palp: progress 34 places" of
/// percent ten times a second. What the thread tells of its work (followed_work.h) counts here, and
/// this in turn for who follows it.
class ProgressLine
{
public:
  /// @param what  that is counted, as "depths"; or what is done, where nothing is counted
  explicit ProgressLine(std::string what);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// From any thread.
  void operator()(std::size_t done, std::size_t total);

  /// The part of what is done, 0 to 1. From any thread.
  void operator()(double fraction);

  /// A line of its own, above the one that is written over. From any thread.
  void tell(const std::string& line);

private:
  void print() const;

  const std::string what_;
  const bool terminal_;
  const bool isForProgram_;
  FollowedWork own_;
  std::optional<FollowedWork::OfThread> isOwn_; // where nobody else follows this thread
  FollowedWork* work_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable_any wakeUp_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  std::jthread writer_;
};

} // namespace palp
