#pragma once

#include <cstdint>

namespace palp
{

/// How something is to be played.
struct PlayOrder
{
  bool plays = true; ///< or pauses
  bool loops = false;
  double speed = 1.0;      ///< times its own, see Playhead
  double place = 0.0;      ///< that was sought last, from the beginning [s]
  std::uint64_t seeks = 0; ///< so far; each goes to its place once
};

/// The time at which something of a length is played; pure arithmetic, of one thread.
class Playhead
{
public:
  static constexpr double kSlowest = 0.1;
  static constexpr double kFastest = 4.0;

  /// @param length  [s], 0 or more
  explicit Playhead(double length) noexcept
    : length_(length)
  {
  }

  /// Speeds and places out of range are taken to its end; one that is not finite is ignored.
  /// @return    whether it went to a place
  /// @realtime  no allocation, no lock, no exception
  bool obey(const PlayOrder& order) noexcept;

  /// Plays on; at the end it stays, or where it loops begins anew.
  /// @param dt  since the last call [s]; nothing happens unless it is above 0
  /// @return    whether it began anew
  /// @realtime  no allocation, no lock, no exception
  bool advance(double dt) noexcept;

  /// From the beginning, 0 to the length [s].
  [[nodiscard]] double time() const noexcept
  {
    return time_;
  }

  /// How fast it went in the last advance(), times its own speed; 0 where it paused or had ended.
  [[nodiscard]] double rate() const noexcept
  {
    return rate_;
  }

  [[nodiscard]] double length() const noexcept
  {
    return length_;
  }

private:
  double length_;
  double time_ = 0.0;
  double rate_ = 0.0;
  double speed_ = 1.0;
  bool plays_ = true;
  bool loops_ = false;
  std::uint64_t seeks_ = 0;
};

} // namespace palp
