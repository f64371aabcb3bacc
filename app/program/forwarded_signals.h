#pragma once

#include <array>
#include <csignal>
#include <pthread.h>

namespace palp
{

/// While it lives, signals that a thread of a library catches go on to the one that waits for them:
/// such a thread may have started with the program, as those of OpenBLAS do, and then blocks none.
class ForwardedSignals
{
public:
  /// @param to  blocks the signals and waits for them; outlives this
  ForwardedSignals(const sigset_t& signals, pthread_t to);
  ~ForwardedSignals();
  ForwardedSignals(const ForwardedSignals&) = delete;
  ForwardedSignals& operator=(const ForwardedSignals&) = delete;

private:
  static constexpr int kSignals = 32; // without those of real time

  sigset_t signals_;
  pthread_t before_;
  std::array<struct sigaction, kSignals> actions_{}; // before
};

} // namespace palp
