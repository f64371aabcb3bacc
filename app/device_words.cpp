#include "app/device_words.h"

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
  Words{ Flag::DeviceLost, "device lost" },
  Words{ Flag::Stale, "device silent" },
  Words{ Flag::Jump, "pose jumped" },
  Words{ Flag::NotHomed, "not homed" },
  Words{ Flag::Late, "tick late" },
  Words{ Flag::StiffnessLimited, "stiffness limited" },
  Words{ Flag::Passivity, "damped for passivity" },
  Words{ Flag::Limited, "largest force" },
  Words{ Flag::SlewLimited, "rate limited" },
  Words{ Flag::Workspace, "end of workspace" },
  Words{ Flag::Unwatched, "window too slow" },
  Words{ Flag::Reseated, "felt from below the surface until lifted" },
};

} // namespace

const char* describe(DeviceState state) noexcept
{
  switch (state)
  {
    case DeviceState::Closed:
      return "closed";
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

std::string describeFlags(std::uint32_t flags)
{
  std::string text;
  for (const Words& words : kWords)
  {
    if ((flags & static_cast<std::uint32_t>(words.flag)) != 0)
    {
      text.append(text.empty() ? "" : ", ").append(words.text);
    }
  }
  return text;
}

} // namespace palp
