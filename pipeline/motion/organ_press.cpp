#include "pipeline/motion/organ_press.h"

#include "haptics/servo/tissue_at.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace palp
{

OrganLoad organLoadOf(const Sample& sample, double depth, const Scene& tissue)
{
  const SeriesResponse answer = TissueAt(tissue, sample.contact).answer(depth);
  return { .center = sample.contact.center,
    .normal = sample.contact.normal,
    .force = answer.felt.force / tissue.series->law.modulus(),
    .given = depth - answer.local };
}

void seeFromBody(const OrganMotion& motion, std::span<const OrganLoad> loads, const Tip& tip,
  Contact& contact, ToolPose& pose)
{
  const OrganMotion::Moved moved = motion.movedAt(contact.center, loads);
  const Eigen::Vector3d turn = vectorOf(moved.turn);
  const double angle = turn.norm();
  Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
  if (angle > 0.0)
  {
    back = Eigen::AngleAxisd(-angle, turn / angle).toRotationMatrix();
  }
  // a ball stays where it is as it turns
  const auto* sphere = std::get_if<SphereTip>(&tip);
  const double height = sphere != nullptr ? sphere->radius : 0.0;
  const Eigen::Vector3d before = pose.apex - height * pose.axis;
  const Eigen::Vector3d after =
    contact.center + back * (before - contact.center - vectorOf(moved.move));
  pose.axis = back * pose.axis;
  pose.apex = after + height * pose.axis;
  const double up = (after - before).dot(contact.normal);
  contact.center += after - before - up * contact.normal;
  contact.depth = std::max(0.0, contact.depth - up);
}

} // namespace palp
