#include "haptics/devices/spacenav/spacenav_driver.h"

#include "haptics/devices/hid/rate_motion.h"
#include "haptics/error.h"

#include <algorithm>
#include <poll.h>
#include <spnav.h>
#include <sys/socket.h>

namespace palp
{
namespace
{

constexpr int kEvents = 64; // in a tick: whoever floods must not hold it up

// right, up and away from the user, as the daemon has turned them
// @source  spacenavd cfgfile.c, def_axmap and def_axinv
void take(const spnav_event_motion& motion, SpaceMouseState& state) noexcept
{
  const auto axis = [](int value) { return nearestInt<std::int16_t>(value); };
  state.axes = { axis(motion.x), axis(-motion.z), axis(-motion.y), axis(motion.rx),
    axis(-motion.rz), axis(-motion.ry) };
}

void take(const spnav_event_button& button, SpaceMouseState& state) noexcept
{
  if (button.bnum >= 0 && button.bnum < 32)
  {
    const std::uint32_t bit = 1U << static_cast<unsigned>(button.bnum);
    state.buttons = button.press != 0 ? state.buttons | bit : state.buttons & ~bit;
  }
}

class SpacenavDriver final : public Driver
{
public:
  SpacenavDriver()
  {
    if (spnav_open() != 0)
    {
      throw Error(ErrorCode::NoDevice,
        "spacenavd: does not run, or another device of this window uses it; start it, or give "
        "--device spacemouse");
    }
  }
  ~SpacenavDriver() override
  {
    (void)spnav_close();
  }
  SpacenavDriver(const SpacenavDriver&) = delete;
  SpacenavDriver& operator=(const SpacenavDriver&) = delete;

  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "six-axis mouse (spacenavd)" };
  }

  [[nodiscard]] IoCode tick(const Wrench&, double dt, DriverSample& sample) noexcept override
  {
    bool heard = false;
    for (int i = 0; i < kEvents && isReadable(); ++i)
    {
      spnav_event event{};
      const int type = spnav_poll_event(&event);
      if (type == SPNAV_EVENT_MOTION)
      {
        take(event.motion, state_);
      }
      else if (type == SPNAV_EVENT_BUTTON)
      {
        take(event.button, state_);
      }
      heard = true;
    }
    if (hasEnded())
    {
      return IoCode::Gone;
    }
    sample = motion_.move(state_, heard, dt);
    return IoCode::Ok;
  }

private:
  [[nodiscard]] static bool isReadable() noexcept
  {
    pollfd one{ spnav_fd(), POLLIN, 0 };
    return poll(&one, 1, 0) > 0 && !hasEnded();
  }

  // the library does not tell an end of its daemon from no event
  [[nodiscard]] static bool hasEnded() noexcept
  {
    char one = 0;
    const int socket = spnav_fd(); // -1 once it has noticed
    return socket < 0 || recv(socket, &one, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }

  SpaceMouseState state_;
  RateMotion motion_;
};

} // namespace

std::unique_ptr<Driver> openSpacenav()
{
  return std::make_unique<SpacenavDriver>();
}

} // namespace palp
