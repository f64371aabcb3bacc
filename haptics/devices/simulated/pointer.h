#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/simulated/guided_tool.h"

namespace palp
{

/// A tool that goes where the mouse says, over the surface, whatever the force.
class Pointer final : public Device
{
public:
  /// @throws Error  as GuidedTool
  explicit Pointer(const ToolPose& start)
    : tool_(start)
  {
  }

  [[nodiscard]] GuidedTool* guided() noexcept override
  {
    return &tool_;
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "mouse" };
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench&, double dt) noexcept override
  {
    return tool_.advance(dt);
  }

private:
  GuidedTool tool_;
};

} // namespace palp
