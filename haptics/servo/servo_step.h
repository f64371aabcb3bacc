#pragma once

#include "haptics/servo/safety.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/tissue_memory.h"

namespace palp
{

/// Contact and law at a pose, without a force: what a safety chain starts from. Of several organs
/// only the first is looked at, here and where there is no memory of the one that is touched.
///
/// @return    flagged, and without contact, where the pose is not finite
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Sample evaluateContact(const Scene& scene, const ToolPose& pose) noexcept;

/// The tissue of a scene at a contact, as if it were another depth there.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Response evaluateLaw(
  const Scene& scene, const Contact& contact, double depth) noexcept;

/// Tool pose in, force out: contact, analytical law, damping, limit.
///
/// The tissue pushes and never pulls, however fast the tool withdraws. The caller sets the time.
///
/// @return    a sample whose force is finite and no longer than scene.forceLimit; zero, and
///            flagged, where the pose or what follows from it is not finite, or the limit none
/// @source    Fig. 9(b)
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Sample step(const Scene& scene, const ToolPose& pose) noexcept;

/// The same of tissue that relaxes or rubs, which it may also do along the surface.
/// @param dt  since the last tick [s]
[[nodiscard]] Sample step(
  const Scene& scene, TissueMemory& memory, const ToolPose& pose, double dt) noexcept;

/// A tick through a safety chain: admit the pose, contact and law there, limit the force.
///
/// @param pose     of Device::exchange; nothing: the device gave none
/// @param held     pose of the sample where none is admitted
/// @param dt       since the last tick [s]
/// @realtime       no allocation, no lock, no exception
[[nodiscard]] Sample step(const Scene& scene, TissueMemory& memory, SafetyChain& chain,
  const std::optional<ToolPose>& pose, const DeviceStatus& status, const SafetyOrders& orders,
  double dt, const ToolPose& held = {}) noexcept;

} // namespace palp
