#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

namespace palp
{

/// Work of a thread that another one follows: what it does, how much of that is done, and whether
/// it is still wanted. Every function is for any thread.
///
/// What the thread runs finds it by itself, as Qt's isInterruptionRequested() is found: no function
/// between has to pass it on.
class FollowedWork
{
public:
  struct Step
  {
    std::string what{};           ///< for people; empty: not told
    std::optional<double> done{}; ///< 0 to 1; none: nobody knows
  };

  /// A step begins.
  void begin(std::string what);

  /// How much of the step is done.
  void tell(double done);

  [[nodiscard]] Step step() const;

  void giveUp()
  {
    stop_.request_stop();
  }
  [[nodiscard]] bool isWanted() const
  {
    return !stop_.stop_requested();
  }
  [[nodiscard]] std::stop_token token() const
  {
    return stop_.get_token();
  }

  /// That of the calling thread; null: nobody follows what it does.
  [[nodiscard]] static FollowedWork* ofThisThread() noexcept;

  /// While it lives, the work of the calling thread.
  class OfThread
  {
  public:
    explicit OfThread(FollowedWork& work) noexcept;
    ~OfThread();
    OfThread(const OfThread&) = delete;
    OfThread& operator=(const OfThread&) = delete;
  };

private:
  mutable std::mutex mutex_; // of the step
  Step step_;
  std::stop_source stop_;
};

/// Ends work that was given up; where nobody follows, nothing.
/// @throws Error  NoSolution: it is not wanted any longer
void checkWanted();

/// How much of the step of this thread's work is done, 0 to 1; where nobody follows, nothing.
/// @throws Error  as checkWanted
void tellDone(double done);

} // namespace palp
