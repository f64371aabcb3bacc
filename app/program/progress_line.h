#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace palp
{

/// How far long work is, on standard error: after two seconds, on a terminal as a line that is
/// written over itself every second, elsewhere as a line every ten.
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
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable_any wakeUp_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  double fraction_ = 0.0;
  std::jthread writer_;
};

} // namespace palp
