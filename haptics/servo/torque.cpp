#include "haptics/servo/torque.h"

#include <Eigen/Geometry>

namespace palp
{
namespace
{

constexpr double kTurn = 1e-4; // [rad]: by less, a contact's depth is not exact enough

} // namespace

Eigen::Vector3d torqueAt(const Scene& scene, const Sample& sample, const TissueAt& tissue) noexcept
{
  const double depth = sample.proxyDepth;
  const double force = tissue(depth).force;
  const bool isByDepthAlone = !TissueAt::pushesAside(scene);
  const double energy = isByDepthAlone ? 0.0 : tissue.energy(depth);
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  Eigen::Vector3d about = sample.pose.axis.unitOrthogonal();
  for (int i = 0; i < 2; ++i, about = sample.pose.axis.cross(about))
  {
    ToolPose turned = sample.pose;
    turned.axis = (turned.axis + kTurn * about.cross(turned.axis)).normalized();
    const Contact contact = findContact(scene, turned);
    // the depth by the force itself, for an energy is an integral with an error of its own
    double more = force * (contact.depth - sample.contact.depth);
    if (!isByDepthAlone && contact.touching())
    {
      more += TissueAt(scene, contact).energy(depth) - energy;
    }
    torque -= more / kTurn * about;
  }
  return torque;
}

} // namespace palp
