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
      std::chrono::seconds pause(2);
      std::unique_lock lock(mutex_);
      while (!wakeUp_.wait_for(lock, finished, pause, [&] { return finished.stop_requested(); }))
      {
        print();
        pause = std::chrono::seconds(terminal_ ? 1 : 10);
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

void ProgressLine::operator()(double fraction)
{
  const std::lock_guard lock(mutex_);
  fraction_ = fraction;
}

void ProgressLine::tell(const std::string& line)
{
  const std::lock_guard lock(mutex_);
  std::cerr << (terminal_ ? "\r\033[K" : "") << "palp: " << line << '\n';
}

void ProgressLine::print() const
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  const std::string count = std::to_string(done_) + " of " + std::to_string(total_) + ' ';
  const std::string part =
    fraction_ > 0.0 ? ": " + std::to_string(std::lround(100.0 * fraction_)) + " %" : "";
  std::cerr << (terminal_ ? "\r\033[Kpalp: " : "palp: ")
            << (total_ > 0 ? count + what_ + " done" : what_ + part) << ", "
            << std::lround(spent.count()) << " s" << (terminal_ ? "" : "\n") << std::flush;
}

} // namespace palp
