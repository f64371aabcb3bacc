#include "app/interrupt.h"

#include <pthread.h>
#include <unistd.h>
#include <utility>

namespace palp
{

Interrupt::Interrupt()
  : Interrupt(nullptr)
{
}

Interrupt::Interrupt(std::function<void()> last)
  : last_(std::move(last))
{
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  struct sigaction hangup = {};
  if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN)
  {
    sigaddset(&signals_, SIGHUP); // else nohup
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  listener_ = std::jthread(
    [this](const std::stop_token& finished)
    {
      const timespec wait{ .tv_sec = 0, .tv_nsec = 100'000'000 };
      while (!finished.stop_requested())
      {
        const int signal = sigtimedwait(&signals_, nullptr, &wait);
        if (signal > 0 && last_)
        {
          last_();
          std::signal(signal, SIG_DFL); // a shell ignores Ctrl-C for what runs in the background
          kill(getpid(), signal);
          pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr); // ends the program
        }
        else if (signal > 0)
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
