#include "haptics/devices/simulated/lagging_tool.h"

#include "haptics/servo/tissue_at.h"

#include <algorithm>
#include <utility>

namespace palp
{

LaggingTool::LaggingTool(std::unique_ptr<Device> device, const Material& reference)
  : device_(std::move(device))
  , reference_(reference)
{
}

void LaggingTool::setScene(const Scene& scene)
{
  LawSettings settings = scene.law.settings();
  settings.coatings = {};
  settings.relaxation = {};
  settings.friction = 0.0;
  world_.publish({ scene, ForceLaw(scene.law.tip(), reference_, settings) });
}

DeviceLimits LaggingTool::limits() const
{
  return device_->limits();
}

GuidedTool* LaggingTool::guided() noexcept
{
  return device_->guided();
}

DeviceStatus LaggingTool::status() const noexcept
{
  return device_->status();
}

std::optional<ToolPose> LaggingTool::exchange(const Wrench& wrench, double dt) noexcept
{
  std::optional<ToolPose> pose = device_->exchange(wrench, dt);
  const auto& [scene, reference] = world_.read();
  if (!pose || scene.surface == nullptr)
  {
    return pose;
  }
  const Contact contact = touchOrgan(scene, *pose, touch_);
  if (!contact.touching())
  {
    return pose;
  }
  const double felt = TissueAt(organOf(scene, touch_.organ), contact)(contact.depth).force;
  const double plain = reference({ .depth = contact.depth }).force;
  const double part = felt > 0.0 ? std::min(1.0, kPart * plain / felt) : 1.0;
  const auto less = [&](double along) { return (part - 1.0) * along * contact.normal; };
  pose->apex += less(-contact.depth);
  pose->velocity += less(pose->velocity.dot(contact.normal));
  return pose;
}

} // namespace palp
