#include "haptics/devices/simulated/playhead.h"

#include <algorithm>
#include <cmath>

namespace palp
{

bool Playhead::obey(const PlayOrder& order) noexcept
{
  plays_ = order.plays;
  loops_ = order.loops;
  speed_ = std::isfinite(order.speed) ? std::clamp(order.speed, kSlowest, kFastest) : speed_;
  if (seeks_ == order.seeks || !std::isfinite(order.place))
  {
    return false;
  }
  seeks_ = order.seeks;
  time_ = std::clamp(order.place, 0.0, length_);
  return true;
}

bool Playhead::advance(double dt) noexcept
{
  const bool goesOn = loops_ ? length_ > 0.0 : time_ < length_;
  rate_ = plays_ && goesOn ? speed_ : 0.0;
  if (!(dt > 0.0) || !std::isfinite(dt))
  {
    return false;
  }
  time_ += rate_ * dt;
  if (time_ <= length_)
  {
    return false;
  }
  time_ = loops_ ? std::fmod(time_, length_) : length_;
  return loops_;
}

} // namespace palp
