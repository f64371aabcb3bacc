#include "app/program/forwarded_signals.h"

#include <atomic>
#include <cerrno>

namespace palp
{
namespace
{

std::atomic<pthread_t> waiting{}; // a handler sees nothing else; none: 0
static_assert(std::atomic<pthread_t>::is_always_lock_free);

void passOn(int signal)
{
  const int error = errno;
  if (const pthread_t to = waiting; to != pthread_t{}) // else it waits no more
  {
    pthread_kill(to, signal);
  }
  errno = error;
}

} // namespace

ForwardedSignals::ForwardedSignals(const sigset_t& signals, pthread_t to)
  : signals_(signals)
  , before_(waiting.exchange(to))
{
  struct sigaction action = {};
  action.sa_handler = passOn;
  action.sa_flags = SA_RESTART;
  for (int signal = 1; signal < kSignals; ++signal)
  {
    if (sigismember(&signals_, signal) == 1)
    {
      sigaction(signal, &action, &actions_[static_cast<std::size_t>(signal)]);
    }
  }
}

ForwardedSignals::~ForwardedSignals()
{
  for (int signal = 1; signal < kSignals; ++signal)
  {
    if (sigismember(&signals_, signal) == 1)
    {
      sigaction(signal, &actions_[static_cast<std::size_t>(signal)], nullptr);
    }
  }
  waiting = before_;
}

} // namespace palp
