#pragma once

#include "haptics/devices/device.h"
#include "haptics/servo/organ_touch.h"
#include "haptics/threads/latest.h"

#include <memory>

namespace palp
{

/// A tool that shows stiffness where no hand can feel it: it goes less deep than the device asks,
/// the less the stiffer the tissue is there.
///
/// In tissue as stiff as a reference it goes half as deep, in tissue twice as stiff a quarter: the
/// part of the asked depth is half of the reference's force over that of the tissue, both at the
/// depth that is asked, and at most all of it. Depth over force is compliance, so tissues whose
/// compliance differs by some percent show depths that differ by as many.
///
/// @source  control and display: Lecuyer et al., "Pseudo-haptic feedback: can isometric input
///          devices simulate force feedback?", IEEE VR 2000
class LaggingTool final : public Device
{
public:
  static constexpr double kPart = 0.5; ///< of the depth that is asked, in tissue as the reference

  /// @param device     that asks, and renders no force
  /// @param reference  on a half-space, pressed by the same tool and by the same kind of law
  LaggingTool(std::unique_ptr<Device> device, const Material& reference);

  /// What the tool touches; main thread only. Without a surface it goes where it is asked.
  void setScene(const Scene& scene);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] bool place(const DevicePlacement& placement) override
  {
    return device_->place(placement);
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override;
  [[nodiscard]] GuidedTool* guided() noexcept override;
  [[nodiscard]] DeviceStatus status() const noexcept override;

private:
  struct World
  {
    Scene scene{};
    ForceLaw reference = scene.law;
  };

  std::unique_ptr<Device> device_;
  Material reference_;
  Latest<World> world_;
  OrganTouch touch_; // of the thread that exchanges, at the asked pose
};

} // namespace palp
