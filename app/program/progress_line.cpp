#include "app/program/progress_line.h"

#include <cmath>
#include <iostream>
#include <unistd.h>

namespace palp
{

ProgressLine::ProgressLine(std::string what)
  : what_(std::move(what))
  , terminal_(isatty(STDERR_FILENO) != 0)
{
  writer_ = std::jthread(
    [this](const std::stop_token& finished)
    {
      const auto pause = std::chrono::seconds(terminal_ ? 1 : 10);
      std::unique_lock lock(mutex_);
      while (!wakeUp_.wait_for(lock, finished, pause, [&] { return finished.stop_requested(); }))
      {
        print();
      }
    });
}

ProgressLine::~ProgressLine()
{
  writer_ = {};
  std::cerr << (terminal_ ? "\r\033[K" : "") << std::flush;
}

void ProgressLine::operator()(std::size_t done, std::size_t total)
{
  const std::lock_guard lock(mutex_);
  done_ = done;
  total_ = total;
}

void ProgressLine::tell(const std::string& line)
{
  const std::lock_guard lock(mutex_);
  std::cerr << (terminal_ ? "\r\033[K" : "") << "palp: " << line << '\n';
}

void ProgressLine::print() const
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  std::cerr << (terminal_ ? "\r\033[Kpalp: " : "palp: ") << done_ << " of " << total_ << ' '
            << what_ << " done, " << std::lround(spent.count()) << " s" << (terminal_ ? "" : "\n")
            << std::flush;
}

} // namespace palp
