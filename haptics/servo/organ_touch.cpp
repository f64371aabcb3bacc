#include "haptics/servo/organ_touch.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

constexpr int kKnown = 64; // organs of which it is known which are near

// an organ that was entered
struct Met
{
  Contact contact{};
  int organ = 0;
  double ago = 0.0; // [-] of the last tick's motion
};

bool reaches(const Reach& reach, const Surface& surface, double more = 0.0) noexcept
{
  const double radius = reach.radius + more;
  return squaredDistance(surface.tree().nodes()[0], reach.center) <= radius * radius;
}

// anew where the tool has come too far
void lookAround(const Scene& scene, const Reach& reach, OrganTouch& touch) noexcept
{
  constexpr double kMargin = 0.05; // [m]
  if (touch.nearTo && (reach.center - *touch.nearTo).squaredNorm() < kMargin * kMargin)
  {
    return;
  }
  touch.nearTo = reach.center;
  touch.near = 0;
  for (int i = 0; i < std::min(organCount(scene), kKnown); ++i)
  {
    const bool isNear = reaches(reach, *organOf(scene, i).surface, kMargin);
    touch.near |= static_cast<std::uint64_t>(isNear) << static_cast<unsigned>(i);
  }
}

// how long ago the tool came to the surface, in ticks, by its present motion
double entered(const Contact& contact, const Eigen::Vector3d& motion) noexcept
{
  const double inward = -motion.dot(contact.normal);
  return inward > 0.0 ? contact.depth / inward : std::numeric_limits<double>::infinity();
}

Met meet(const Scene& scene, const ToolPose& pose, OrganTouch& before) noexcept
{
  const Reach reach = reachOf(scene.law.tip(), pose, scene.rule);
  const Eigen::Vector3d motion = pose.apex - before.apex.value_or(pose.apex);
  Met first{ .organ = before.organ };
  const auto look = [&](int i) noexcept
  {
    const Scene& organ = organOf(scene, i);
    if (reaches(reach, *organ.surface))
    {
      const Contact contact = findContact(organ, pose);
      const double ago = contact.touching() ? entered(contact, motion) : 0.0;
      const bool isFirst =
        std::pair(ago, contact.depth) > std::pair(first.ago, first.contact.depth);
      first = isFirst ? Met{ contact, i, ago } : first;
    }
  };
  lookAround(scene, reach, before);
  for (std::uint64_t left = before.near; left != 0; left &= left - 1)
  {
    look(std::countr_zero(left));
  }
  for (int i = kKnown; i < organCount(scene); ++i)
  {
    look(i);
  }
  return first;
}

} // namespace

Contact touchOrgan(const Scene& scene, const ToolPose& pose, OrganTouch& before) noexcept
{
  before.follow(scene);
  if (scene.others.empty())
  {
    return findContact(scene, pose);
  }
  Contact contact;
  if (before.touching)
  {
    contact = findContact(organOf(scene, before.organ), pose);
    before.withheld -= (pose.apex - before.apex.value_or(pose.apex)).norm();
  }
  if (!contact.touching())
  {
    const Met met = meet(scene, pose, before);
    contact = met.contact;
    before.organ = met.organ;
    before.withheld = before.touching ? contact.depth - before.depth : 0.0;
  }
  before.touching = contact.touching();
  before.apex = pose.apex;
  before.withheld = std::clamp(before.withheld, 0.0, contact.depth);
  contact.depth -= before.withheld;
  before.depth = contact.depth;
  return contact.touching() ? contact : Contact{};
}

} // namespace palp
