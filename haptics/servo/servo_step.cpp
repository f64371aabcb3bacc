#include "haptics/servo/servo_step.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_nodules.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

void raise(Sample& sample, Flag flag) noexcept
{
  sample.flags |= static_cast<std::uint32_t>(flag);
}

// damping and limit of what the law gives and what acts along the surface
void push(Sample& sample, const Scene& scene, const Eigen::Vector3d& lateral) noexcept
{
  const Eigen::Vector3d& normal = sample.contact.normal;
  const double viscous = -scene.damping * sample.pose.velocity.dot(normal);
  const double sum = sample.response.force + viscous;
  if (!std::isfinite(sum) || !(scene.forceLimit >= 0.0)) // before max and min, which hide a NaN
  {
    raise(sample, Flag::NotFinite);
    return;
  }
  const double wanted = std::max(0.0, sum);
  const double pushed = std::min(wanted, scene.forceLimit);
  if (pushed < wanted)
  {
    raise(sample, Flag::Limited);
  }
  sample.force = pushed * normal;
  if (lateral.isZero(0.0))
  {
    return;
  }
  sample.force = wanted * normal + lateral;
  if (const double size = sample.force.norm(); size > scene.forceLimit)
  {
    raise(sample, Flag::Limited);
    sample.force *= scene.forceLimit / size;
  }
}

} // namespace

Response evaluateLaw(const Scene& scene, const Contact& contact, double depth) noexcept
{
  ContactGeometry geometry = contactGeometryOf(contact);
  geometry.depth = depth;
  Response response = scene.law(geometry);
  if (scene.nodules != nullptr)
  {
    const NoduleResponse more = (*scene.nodules)(noduleContactOf(contact), depth).response;
    response.force += more.force;
    response.stiffness += more.stiffness;
  }
  return response;
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
    if (scene.nodules != nullptr)
    {
      sample.lateral =
        (*scene.nodules)(noduleContactOf(sample.contact), sample.contact.depth).lateral;
    }
  }
  return sample;
}

Sample step(const Scene& scene, const ToolPose& pose) noexcept
{
  Sample sample = evaluateContact(scene, pose);
  if (sample.contact.touching())
  {
    push(sample, scene, sample.lateral);
  }
  return sample;
}

Sample step(const Scene& scene, TissueMemory& memory, const ToolPose& pose, double dt) noexcept
{
  Sample sample = evaluateContact(scene, pose);
  Eigen::Vector3d friction = Eigen::Vector3d::Zero();
  const bool remembers = memory.begin(scene, sample, dt);
  if (remembers)
  {
    const double depth = sample.contact.depth;
    sample.response = sample.contact.touching() ? memory.at(depth) : Response{};
    const Rendered felt{ sample.response.force, sample.response.stiffness, depth };
    friction = memory.settle(felt, std::numeric_limits<double>::infinity(), sample);
  }
  // what lies deeper than the tool damps nothing
  if (sample.contact.touching() && !(remembers && sample.response.force == 0.0))
  {
    push(sample, scene, friction);
  }
  return sample;
}

Sample step(const Scene& scene, TissueMemory& memory, SafetyChain& chain,
  const std::optional<ToolPose>& pose, const DeviceStatus& status, const SafetyOrders& orders,
  double dt, const ToolPose& held) noexcept
{
  const std::optional<ToolPose> admitted = chain.admit(pose, status, orders, dt);
  Sample sample;
  sample.pose = held;
  if (admitted)
  {
    sample = evaluateContact(scene, *admitted);
  }
  if (memory.begin(scene, sample, dt))
  {
    const auto law = [&](double depth) noexcept { return memory.at(depth); };
    chain.limit(sample, law, scene, &memory);
    return sample;
  }
  const auto law = [&](double depth) noexcept { return evaluateLaw(scene, sample.contact, depth); };
  chain.limit(sample, law, scene);
  return sample;
}

} // namespace palp
