#include "haptics/contact/paper_contact.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kShaft = 4.0; // [-] base radii of the shaft that are looked at

} // namespace

double paperLength(const Tip& tip) noexcept
{
  const double base = baseRadius(tip);
  return tipHeight(tip, base) + kShaft * base;
}

Contact paperContact(const Surface& surface, const Tip& tip, const ToolPose& pose) noexcept
{
  const BoxTree& tree = surface.tree();
  const double base = baseRadius(tip);
  const double length = paperLength(tip);

  // broad phase: the box around the tool
  const Eigen::Array3d end = (pose.apex - length * pose.axis).array();
  const Eigen::Array3d low = pose.apex.array().min(end) - base;
  const Eigen::Array3d high = pose.apex.array().max(end) + base;
  const auto near = [&](const BoxTree::Node& box)
  {
    const Eigen::Array3d boxLow(box.low[0], box.low[1], box.low[2]);
    const Eigen::Array3d boxHigh(box.high[0], box.high[1], box.high[2]);
    return (boxLow <= high).all() && (boxHigh >= low).all();
  };

  // narrow phase: the implicit function of the tool
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int count = 0;
  Contact contact;
  const auto add = [&](int facet)
  {
    const int triangle = tree.triangle(facet);
    for (const int point : surface.triangles()[static_cast<std::size_t>(triangle)])
    {
      const auto i = static_cast<std::size_t>(point);
      if (surface.firstTriangle(point) != triangle || !(surface.normals()[i].dot(pose.axis) < 0.0))
      {
        continue; // counted with another triangle, or turned away
      }
      const Eigen::Vector3d offset = surface.points()[i] - pose.apex;
      const double height = -offset.dot(pose.axis);
      const double radius = std::sqrt(std::max(0.0, offset.squaredNorm() - height * height));
      if (radius <= base && height >= tipHeight(tip, radius) && height <= length)
      {
        normal += surface.normals()[i];
        center += surface.points()[i];
        contact.triangle = triangle;
        ++count;
      }
    }
  };
  tree.search(near, add);
  if (count == 0)
  {
    return {};
  }

  contact.normal = normal.normalized();
  contact.normalSpread = std::acos(std::min(1.0, normal.norm() / count));
  const double depth = (center / count - pose.apex).dot(contact.normal);
  contact.center = pose.apex + depth * contact.normal;
  contact.depth = depth;
  contact.bodyNormal = contact.normal;
  contact.height = -depth;
  contact.rising = contact.normal;
  contact.tilt = std::acos(std::clamp(-pose.axis.dot(contact.normal), -1.0, 1.0));
  contact.edgeDistance = std::min(surface.shape().edgeDistance(contact.center),
    surface.edgeDistance(contact.center, contact.triangle));
  return contact;
}

} // namespace palp
