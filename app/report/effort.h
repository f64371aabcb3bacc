#pragma once

#include <algorithm>
#include <functional>
#include <stop_token>
#include <vector>

namespace palp::report
{

/// Thrown by a part that was asked to stop; what it had is lost, what other parts have is not.
struct Interrupted
{
};

/// How much work a part may do, and whom it tells.
struct Effort
{
  bool quick = false; ///< a minute for the whole report, not a quarter of an hour
  std::stop_token stop;
  std::function<void(double)> tell; ///< share of the part that is done, 0 to 1

  /// @throws Interrupted  when asked to stop
  void check() const
  {
    if (stop.stop_requested())
    {
      throw Interrupted();
    }
  }

  /// The same, and tells how far the part has come.
  void reached(double share) const
  {
    check();
    tell(share);
  }

  /// How often a figure is measured anew.
  [[nodiscard]] int repeats() const noexcept
  {
    return quick ? 3 : 5;
  }
};

/// Repeated measurements of one figure.
struct Spread
{
  double median = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// @param values  at least one, in any order
[[nodiscard]] inline Spread spreadOf(std::vector<double> values)
{
  std::ranges::sort(values);
  return { values[values.size() / 2], values.front(), values.back() };
}

} // namespace palp::report
