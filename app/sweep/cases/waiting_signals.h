#pragma once

#include "app/program/forwarded_signals.h"

#include <array>
#include <csignal>
#include <ctime>
#include <optional>

namespace palp
{

/// Lets the end of a child, and what asks this process to end, wait for wait() while it lives.
class WaitingSignals
{
public:
  WaitingSignals()
  {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGCHLD);
    for (const int signal : std::array{ SIGINT, SIGTERM, SIGHUP })
    {
      struct sigaction how = {};
      sigaction(signal, nullptr, &how);
      if (how.sa_handler != SIG_IGN) // as nohup has it
      {
        sigaddset(&signals_, signal);
      }
    }
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    forwarded_.emplace(signals_, pthread_self());
  }
  ~WaitingSignals()
  {
    forwarded_.reset();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WaitingSignals(const WaitingSignals&) = delete;
  WaitingSignals& operator=(const WaitingSignals&) = delete;

  /// @return  the signal; -1: none came
  [[nodiscard]] int wait(const timespec& most) const
  {
    return sigtimedwait(&signals_, nullptr, &most);
  }

private:
  sigset_t signals_{};
  sigset_t before_{};
  std::optional<ForwardedSignals> forwarded_;
};

} // namespace palp
