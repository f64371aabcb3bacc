#include "haptics/servo/servo_step.h"

#include "haptics/contact/contact_geometry_of.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

void raise(Sample& sample, Flag flag) noexcept
{
  sample.flags |= static_cast<std::uint32_t>(flag);
}

} // namespace

Response evaluateLaw(const Scene& scene, const Contact& contact, double depth) noexcept
{
  ContactGeometry geometry = contactGeometryOf(contact);
  geometry.depth = depth;
  return scene.law(geometry);
}

Sample evaluateContact(const Scene& scene, const ToolPose& pose) noexcept
{
  Sample sample;
  sample.pose = pose;
  if (!(pose.apex.allFinite() && pose.axis.allFinite() && pose.velocity.allFinite()))
  {
    raise(sample, Flag::NotFinite);
    return sample;
  }
  if (scene.surface == nullptr)
  {
    return sample;
  }
  sample.contact = findContact(*scene.surface, scene.law.tip(), pose, scene.rule);
  if (sample.contact.touching())
  {
    sample.response = evaluateLaw(scene, sample.contact, sample.contact.depth);
    sample.proxyDepth = sample.contact.depth;
  }
  return sample;
}

Sample step(const Scene& scene, const ToolPose& pose) noexcept
{
  Sample sample = evaluateContact(scene, pose);
  if (!sample.contact.touching())
  {
    return sample;
  }
  const double viscous = -scene.damping * pose.velocity.dot(sample.contact.normal);
  const double sum = sample.response.force + viscous;
  if (!std::isfinite(sum) || !(scene.forceLimit >= 0.0)) // before max and min, which hide a NaN
  {
    raise(sample, Flag::NotFinite);
    return sample;
  }
  const double wanted = std::max(0.0, sum);
  const double push = std::min(wanted, scene.forceLimit);
  if (push < wanted)
  {
    raise(sample, Flag::Limited);
  }
  sample.force = push * sample.contact.normal;
  return sample;
}

Sample step(const Scene& scene, SafetyChain& chain, const std::optional<ToolPose>& pose,
  const DeviceStatus& status, const SafetyOrders& orders, double dt, const ToolPose& held) noexcept
{
  const std::optional<ToolPose> admitted = chain.admit(pose, status, orders, dt);
  Sample sample;
  sample.pose = held;
  if (admitted)
  {
    sample = evaluateContact(scene, *admitted);
  }
  const auto law = [&](double depth) noexcept { return evaluateLaw(scene, sample.contact, depth); };
  chain.limit(sample, law, scene);
  return sample;
}

} // namespace palp
