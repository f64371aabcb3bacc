#pragma once

#include "app/program/forwarded_signals.h"

#include <csignal>
#include <ctime>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace palp
{

/// While it lives, Ctrl-C, SIGTERM and a terminal that closes do not end the program at once.
///
/// Made before any other thread of ours, which then inherits that the signals wait here.
class Interrupt
{
public:
  /// They ask the work to stop.
  Interrupt();

  /// They call a function, from another thread, and then end the program as they always do.
  explicit Interrupt(std::function<void()> last);

  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Work that does not stop within 1.5 s, or at a second Ctrl-C, ends with the program: for work
  /// whose files are complete at any time.
  /// @param sentence  told then, with exit code 5; lives as long as this
  void endWhatDoesNotStop(const char* sentence);

  /// The same within 0.5 s, for a function, which is called from another thread then, has to put
  /// the files in order before it gives the sentence.
  /// @param last  empty: it stops by itself from now on; where it ends already, no return
  void endBy(std::function<std::string()> last);

  [[nodiscard]] std::stop_token token() const
  {
    return source_.get_token();
  }

private:
  void endBy(std::function<std::string()> last, const timespec& patience);
  [[nodiscard]] std::optional<timespec> patience();
  void endUnless(bool stopped);

  std::stop_source source_;
  std::function<void()> last_;
  std::mutex mutex_;
  std::function<std::string()> end_; // under the mutex; empty: it stops by itself
  timespec patience_{};              // likewise
  sigset_t signals_{};
  sigset_t before_{};
  std::jthread listener_;
  std::optional<ForwardedSignals> forwarded_;
};

} // namespace palp
