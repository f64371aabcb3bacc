#pragma once

#include "haptics/contact/find_contact.h"
#include "haptics/surface/closest_point.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace palp::test
{

using namespace units::literals;

constexpr double kStep = 0.02_mm;

// what stays the same along a slide
enum class Held
{
  Distance, // of the tool's middle to the nearest triangle: knows nothing of the contact's depth
  Depth,    // of the contact, which is what a hand is told and a press is commanded
};

struct Tool
{
  double radius;
  double depth;
};

// one pose of the tool along a cut
struct Pose
{
  Eigen::Vector3d middle;
  Eigen::Vector3d away; // from the surface, within the cut
  double along;         // [m] of the path so far
  Contact contact;
};

// moves the tool's middle within the cut until it is as near to the surface as it is held
inline void settle(
  const Surface& surface, const Tool& tool, const Eigen::Vector3d& across, Held held, Pose& pose)
{
  const auto inCut = [&](const Eigen::Vector3d& v)
  { return Eigen::Vector3d((v - v.dot(across) * across).normalized()); };
  const auto touch = [&]
  {
    pose.contact = findContact(surface, SphereTip{ tool.radius },
      { .apex = pose.middle - tool.radius * pose.away, .axis = -pose.away }, ContactRule::Exact);
  };
  for (int i = 0; i < 60; ++i)
  {
    const ClosestPoint nearest = findClosestPoint(surface, pose.middle, 10.0);
    pose.away = inCut((pose.middle - nearest.point) * (nearest.distance < 0.0 ? -1.0 : 1.0));
    double excess = nearest.distance - (tool.radius - tool.depth);
    if (held == Held::Depth && excess < 0.9 * tool.depth)
    {
      touch();
      const double slope = std::max(0.3, pose.away.dot(pose.contact.normal));
      excess = (tool.depth - pose.contact.depth) / slope;
    }
    if (std::abs(excess) < 1e-9)
    {
      break;
    }
    pose.middle -= excess * pose.away;
  }
  touch();
}

// once around the body
inline std::vector<Pose> slide(
  const Surface& surface, const Tool& tool, const Eigen::Vector3d& across, Held held)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : surface.points())
  {
    middle += point / static_cast<double>(surface.points().size());
  }
  const Eigen::Vector3d out = across.unitOrthogonal();
  Pose pose{ middle + 1.0 * out, out, 0.0, {} };
  settle(surface, tool, across, held, pose);
  std::vector<Pose> poses;
  do
  {
    poses.push_back(pose);
    pose.middle += kStep * across.cross(pose.away);
    settle(surface, tool, across, held, pose);
    pose.along += (pose.middle - poses.back().middle).norm();
  } while (poses.size() < 40000 &&
    (pose.along < 0.02 || (pose.middle - poses.front().middle).norm() > 2.0 * kStep));
  return poses;
}

// Folds: where the path of the tool's middle bends more than the tool itself, seen over a radius of
// the contact. There the body has an edge, or a cleft that the tool bridges, at the tool's scale,
// and the direction of whatever force turns by the step over the tool's radius or more.
inline std::vector<bool> folds(const std::vector<Pose>& poses, const Tool& tool)
{
  const double window = 0.5 * std::sqrt(tool.depth * (2.0 * tool.radius - tool.depth));
  const auto count = static_cast<int>(poses.size());
  const double length = poses.back().along + (poses.back().middle - poses.front().middle).norm();
  // the path is closed: one pose after the last comes the first
  const auto at = [&](int i) -> const Pose&
  { return poses[static_cast<std::size_t>((i + count) % count)]; };
  const auto along = [&](int i) {
    return at(i).along + (i < 0 ? -length : i < count ? 0.0 : length);
  };
  std::vector<bool> result(poses.size());
  for (int i = 0, first = -count, last = 0; i < count; ++i)
  {
    while (along(i) - along(first) > window)
    {
      ++first;
    }
    while (along(last + 1) - along(i) < window)
    {
      ++last;
    }
    const double turn = std::acos(std::clamp(at(first).away.dot(at(last).away), -1.0, 1.0));
    result[static_cast<std::size_t>(i)] = turn * tool.radius > along(last) - along(first);
  }
  return result;
}

} // namespace palp::test
