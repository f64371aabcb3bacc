#include "haptics/servo/servo_step.h"

#include "haptics/servo/tissue_at.h"

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
  const double sum = sample.contact.slope * sample.response.force + viscous;
  // before max and min, which hide a NaN
  if (!std::isfinite(sum) || !lateral.allFinite() || !(scene.forceLimit >= 0.0))
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
  sample.force += std::max(0.0, -sample.force.dot(normal)) * normal; // never pulls, either
  if (const double size = sample.force.norm(); size > scene.forceLimit)
  {
    raise(sample, Flag::Limited);
    sample.force *= scene.forceLimit / size;
  }
}

Sample sampleAt(const ToolPose& pose) noexcept
{
  Sample sample;
  sample.pose = pose;
  if (!(pose.apex.allFinite() && pose.axis.allFinite() && pose.velocity.allFinite()))
  {
    raise(sample, Flag::NotFinite);
  }
  return sample;
}

void respond(Sample& sample, const TissueAt& tissue) noexcept
{
  const SeriesResponse answer = tissue.answer(sample.contact.depth);
  sample.response = answer.felt;
  sample.localDepth = answer.local;
  sample.lateral = tissue.lateral(answer);
  sample.proxyDepth = sample.contact.depth;
}

// of the first organ
Sample touchFirst(const Scene& scene, const ToolPose& pose) noexcept
{
  Sample sample = sampleAt(pose);
  if (sample.flags == 0 && scene.surface != nullptr)
  {
    sample.contact = findContact(scene, pose);
  }
  return sample;
}

// of the organ that is touched, where there are several
Sample touch(const Scene& scene, OrganTouch& before, const ToolPose& pose) noexcept
{
  if (scene.others.empty())
  {
    return touchFirst(scene, pose);
  }
  before.follow(scene);
  Sample sample = sampleAt(pose);
  if (sample.flags == 0)
  {
    sample.contact = touchOrgan(scene, pose, before);
  }
  sample.organ = before.organ;
  return sample;
}

} // namespace

Response evaluateLaw(const Scene& scene, const Contact& contact, double depth) noexcept
{
  return TissueAt(scene, contact)(depth);
}

Sample evaluateContact(const Scene& scene, const ToolPose& pose) noexcept
{
  Sample sample = touchFirst(scene, pose);
  if (sample.contact.touching())
  {
    respond(sample, TissueAt(scene, sample.contact));
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
  Sample sample = touch(scene, memory.touch(), pose);
  const Scene& organ = organOf(scene, sample.organ);
  const bool remembers = memory.begin(organ, sample, dt);
  if (sample.contact.touching())
  {
    respond(sample, memory.tissue());
  }
  Eigen::Vector3d aside = sample.lateral;
  if (remembers)
  {
    const double depth = sample.contact.depth;
    const double elastic = sample.response.force;
    sample.response = sample.contact.touching() ? memory.at(depth) : Response{};
    const Rendered felt{ sample.response.force, sample.response.stiffness, depth };
    aside = memory.settle(felt, std::numeric_limits<double>::infinity(), sample);
    // what the body pushes aside relaxes as the rest
    sample.lateral *= sample.contact.touching() && elastic > 0.0 ? felt.force / elastic : 0.0;
    aside += sample.lateral;
  }
  // what lies deeper than the tool damps nothing
  if (sample.contact.touching() && !(remembers && sample.response.force == 0.0))
  {
    push(sample, organ, aside);
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
  memory.touch().follow(scene);
  sample.organ = memory.touch().organ;
  if (admitted)
  {
    sample = touch(scene, memory.touch(), *admitted);
  }
  const Scene& organ = organOf(scene, sample.organ);
  const bool remembers = memory.begin(organ, sample, dt);
  const TissueAt& tissue = memory.tissue();
  sample.localDepth = tissue.answer(sample.contact.depth).local;
  if (remembers)
  {
    const auto law = [&](double depth) noexcept { return memory.at(depth); };
    chain.limit(sample, law, organ, &tissue, &memory);
  }
  else
  {
    chain.limit(sample, tissue, organ, &tissue, nullptr);
  }
  return sample;
}

} // namespace palp
