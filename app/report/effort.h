#pragma once

#include <functional>
#include <stop_token>

namespace palp::report
{

/// Thrown by a part that was asked to stop; what it had is lost, what other parts have is not.
struct Interrupted
{
};

/// How much work a part may do, and whom it tells.
struct Effort
{
  bool quick = false; ///< two minutes for the whole report, not half an hour
  std::stop_token stop;
  std::function<void(double)> tell; ///< fraction of the part that is done, 0 to 1

  /// @throws Interrupted  when asked to stop
  void check() const
  {
    if (stop.stop_requested())
    {
      throw Interrupted();
    }
  }

  /// The same, and tells how far the part has come.
  void reached(double fraction) const
  {
    check();
    tell(fraction);
  }

  /// How often a figure is measured anew.
  [[nodiscard]] int repeats() const noexcept
  {
    return quick ? 3 : 5;
  }
};

} // namespace palp::report
