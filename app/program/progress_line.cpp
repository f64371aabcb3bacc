#include "app/program/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <unistd.h>

namespace palp
{

ProgressLine::ProgressLine(std::string what)
  : what_(std::move(what))
  , terminal_(isatty(STDERR_FILENO) != 0)
  , isForProgram_(
      std::getenv("PALP_PROGRESS") != nullptr) // NOLINT(concurrency-mt-unsafe): nobody sets it
  , work_(FollowedWork::ofThisThread())
{
  if (work_ == nullptr)
  {
    isOwn_.emplace(own_);
    work_ = &own_;
  }
  work_->begin(what_);
  writer_ = std::jthread(
    [this](const std::stop_token& finished)
    {
      constexpr auto kOften = std::chrono::milliseconds(100);
      std::chrono::milliseconds pause = isForProgram_ ? kOften : std::chrono::seconds(2);
      std::unique_lock lock(mutex_);
      while (!wakeUp_.wait_for(lock, finished, pause, [&] { return finished.stop_requested(); }))
      {
        print();
        pause = isForProgram_ ? kOften : std::chrono::seconds(terminal_ ? 1 : 10);
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
  work_->tell(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(total, 1)));
}

void ProgressLine::operator()(double fraction)
{
  work_->tell(fraction);
}

void ProgressLine::tell(const std::string& line)
{
  const std::lock_guard lock(mutex_);
  std::cerr << (terminal_ ? "\r\033[K" : "") << "palp: " << line << '\n';
}

void ProgressLine::print() const
{
  const long percent = std::lround(100.0 * work_->step().done.value_or(0.0));
  if (isForProgram_)
  {
    std::cerr << "palp: progress " << percent << ' ' << what_ << '\n' << std::flush;
    return;
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  const std::string count = std::to_string(done_) + " of " + std::to_string(total_) + ' ';
  const std::string part = percent > 0 ? ": " + std::to_string(percent) + " %" : "";
  std::cerr << (terminal_ ? "\r\033[Kpalp: " : "palp: ")
            << (total_ > 0 ? count + what_ + " done" : what_ + part) << ", "
            << std::lround(spent.count()) << " s" << (terminal_ ? "" : "\n") << std::flush;
}

} // namespace palp
