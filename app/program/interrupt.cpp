#include "app/program/interrupt.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <pthread.h>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

constexpr int kWake = SIGURG; // does nothing by default
constexpr timespec kPatience{ .tv_sec = 1, .tv_nsec = 500'000'000 };
constexpr timespec kLess{ .tv_sec = 0, .tv_nsec = 500'000'000 }; // files take time, too
constexpr int kNoSolution = 5;                                   // exit code

} // namespace

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
  sigaddset(&signals_, kWake);
  struct sigaction hangup = {};
  if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN)
  {
    sigaddset(&signals_, SIGHUP); // else nohup
  }
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  listener_ = std::jthread(
    [this](const std::stop_token& finished)
    {
      while (!finished.stop_requested())
      {
        const int signal = sigwaitinfo(&signals_, nullptr);
        if (signal <= 0 || signal == kWake)
        {
          continue;
        }
        if (!last_)
        {
          source_.request_stop();
          if (const std::optional<timespec> longest = patience())
          {
            (void)sigtimedwait(&signals_, nullptr, &*longest);
            endUnless(finished.stop_requested());
          }
          continue;
        }
        last_();
        std::signal(signal, SIG_DFL); // a shell ignores Ctrl-C for what runs in the background
        kill(getpid(), signal);
        pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr); // ends the program
      }
    });
  forwarded_.emplace(signals_, listener_.native_handle());
}

void Interrupt::endWhatDoesNotStop(const char* sentence)
{
  endBy([sentence] { return std::string(sentence); }, kPatience);
}

void Interrupt::endBy(std::function<std::string()> last)
{
  endBy(std::move(last), kLess);
}

void Interrupt::endBy(std::function<std::string()> last, const timespec& patience)
{
  const std::lock_guard lock(mutex_);
  end_ = std::move(last);
  patience_ = patience;
}

std::optional<timespec> Interrupt::patience()
{
  const std::lock_guard lock(mutex_);
  return end_ ? std::optional(patience_) : std::nullopt;
}

void Interrupt::endUnless(bool stopped)
{
  const std::lock_guard lock(mutex_);
  if (!stopped && end_)
  {
    try
    {
      std::fprintf(stderr, "\npalp: %s\n", end_().c_str());
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "\npalp: %s\n", error.what());
    }
    std::_Exit(kNoSolution);
  }
}

Interrupt::~Interrupt()
{
  forwarded_.reset();
  listener_.request_stop();
  pthread_kill(listener_.native_handle(), kWake);
  listener_.join(); // before the signals act again
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

} // namespace palp
