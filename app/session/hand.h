#pragma once

#include "app/input/scene_plan.h"
#include "haptics/devices/device.h"
#include "haptics/servo/servo.h"

#include <memory>
#include <optional>

namespace palp
{

class GuidedTool;
class LaggingTool;

/// One hand of a session: its device, with a servo thread, safety chain and tissue memory of its
/// own. The surface is shared with the other.
struct Hand
{
  DeviceChoice choice{};
  std::unique_ptr<Device> device{};
  GuidedTool* guided = nullptr;    ///< of the device; null where it moves by itself
  LaggingTool* lagging = nullptr;  ///< the device; null where it is another
  std::optional<Sample> resting{}; ///< the last that was like the one recorded before it
  std::unique_ptr<Servo> servo{};  ///< last: it uses the device

  /// Whether the device has a place of its own in the scene.
  [[nodiscard]] bool isPlaced() const noexcept
  {
    return choice.kind == DeviceChoice::Kind::Driver;
  }
};

} // namespace palp
