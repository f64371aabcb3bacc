#include "app/session/device_words.h"

#include "haptics/files/listed.h"

#include <array>

namespace palp
{
namespace
{

struct Words
{
  Flag flag;
  const char* text;
};

constexpr std::array kWords{
  Words{ Flag::EmergencyStop, "stopped" },
  Words{ Flag::NotFinite, "value not finite" },
  Words{ Flag::DeviceLost, "was unplugged" },
  Words{ Flag::Stale, "device silent" },
  Words{ Flag::Jump, "pose jumped" },
  Words{ Flag::NotHomed, "not homed" },
  Words{ Flag::Late, "tick late" },
  Words{ Flag::DrivesMotion, "the force speeds up what it should brake" },
  Words{ Flag::StiffnessLimited, "stiffness limited" },
  Words{ Flag::DampingLimited, "damping limited" },
  Words{ Flag::Passivity, "damped for passivity" },
  Words{ Flag::Limited, "largest force" },
  Words{ Flag::SlewLimited, "rate limited" },
  Words{ Flag::Workspace, "end of workspace" },
  Words{ Flag::WatchdogExpired, "window too slow" },
  Words{ Flag::Clutched, "clutch held: the tool stays" },
  Words{ Flag::MotorsWarm, "motors warm" },
  Words{ Flag::Rebased, "felt from below the surface until lifted" },
};

} // namespace

const char* describe(DeviceState state) noexcept
{
  switch (state)
  {
    case DeviceState::Closed:
      return "not there";
    case DeviceState::Opening:
      return "opening";
    case DeviceState::NeedsHoming:
      return "needs homing";
    case DeviceState::Ready:
      return "ready, force off";
    case DeviceState::SoftStart:
      return "force growing";
    case DeviceState::Active:
      return "force on";
    case DeviceState::Decay:
      return "force falling";
  }
  return "";
}

const char* advise(DeviceState state, std::uint32_t flags) noexcept
{
  if (state == DeviceState::Closed)
  {
    return "plug it in again; it will be found";
  }
  if (state == DeviceState::NeedsHoming)
  {
    return "Falcon: pull the grip out, then push it in; WoodenHaptics: hold the arm at rest and "
           "press its button";
  }
  if ((flags & static_cast<std::uint32_t>(Flag::DrivesMotion)) != 0)
  {
    return "a motor seems to push the other way: measure this arm by palp devices --identify, or "
           "arm it again if you jerked it";
  }
  if (isFault(state, flags))
  {
    return "arm it again when the cause is gone";
  }
  if ((flags & static_cast<std::uint32_t>(Flag::MotorsWarm)) != 0)
  {
    return "press less, or let the arm rest for half a minute: its motors will soon give less "
           "force";
  }
  return "";
}

std::string describeFlags(std::uint32_t flags)
{
  std::string text;
  for (const Words& words : kWords)
  {
    if ((flags & static_cast<std::uint32_t>(words.flag)) != 0)
    {
      addListed(text, words.text);
    }
  }
  return text;
}

} // namespace palp
