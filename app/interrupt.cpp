#include "app/interrupt.h"

#include <pthread.h>

namespace palp
{

Interrupt::Interrupt()
{
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  listener_ = std::jthread(
    [this](const std::stop_token& finished)
    {
      const timespec wait{ .tv_sec = 0, .tv_nsec = 100'000'000 };
      while (!finished.stop_requested())
      {
        if (sigtimedwait(&signals_, nullptr, &wait) > 0)
        {
          source_.request_stop();
        }
      }
    });
}

Interrupt::~Interrupt()
{
  listener_ = {}; // ends before the signals act again
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

} // namespace palp
