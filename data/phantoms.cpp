#include "data/phantoms.h"

#include "data/contour.h"
#include "data/liver.h"
#include "data/liver_mesh.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kAround = 5.0_mm; // of the box, outside the body

// a block whose upper face is centered at a height
PhantomPart block(std::string name, const Vector3d& size, double top)
{
  const Vector3d middle(0.0, 0.0, top - 0.5 * size.z());
  PhantomPart part{ .name = std::move(name),
    .distance = [size, middle](const Vector3d& p)
    { return ((p - middle).cwiseAbs() - 0.5 * size).maxCoeff(); },
    .surface = makeBox(size, 2.5_mm) };
  for (Vector3d& point : part.surface.points)
  {
    point.z() += top;
  }
  return part;
}

Phantom within(std::vector<PhantomPart> parts)
{
  Phantom phantom{ .parts = std::move(parts), .low = {}, .high = {} };
  const std::vector<Vector3d>& points = phantom.parts.front().surface.points;
  phantom.low = phantom.high = points.front();
  for (const Vector3d& point : points)
  {
    phantom.low = phantom.low.cwiseMin(point);
    phantom.high = phantom.high.cwiseMax(point);
  }
  phantom.low.array() -= kAround;
  phantom.high.array() += kAround;
  return phantom;
}

PhantomPart ball(std::string name, const PhantomNodule& nodule, int splits)
{
  PhantomPart part{ .name = std::move(name),
    .distance = [nodule](const Vector3d& p) { return (p - nodule.center).norm() - nodule.radius; },
    .surface = makeSphere(nodule.radius, splits) };
  for (Vector3d& point : part.surface.points)
  {
    point += nodule.center;
  }
  return part;
}

struct Vessel
{
  Vector3d from;
  Vector3d to;
  double radius; // [m]
};

// two thinner ones at each end, whose cubes of radii add up (Murray, PNAS 12(3), 1926)
void branch(const Vessel& vessel, const Vector3d& aside, int more, std::vector<Vessel>& all)
{
  all.push_back(vessel);
  if (more == 0)
  {
    return;
  }
  const Vector3d along = (vessel.to - vessel.from).normalized();
  const double length = 0.75 * (vessel.to - vessel.from).norm();
  for (const double side : { 1.0, -1.0 })
  {
    constexpr double spread = 38.0_deg;
    const Vector3d way = std::cos(spread) * along + side * std::sin(spread) * aside;
    branch({ vessel.to, vessel.to + length * way, vessel.radius / std::cbrt(2.0) },
      way.cross(along.cross(aside)).cross(way).normalized(), more - 1, all);
  }
}

std::vector<Vessel> vesselTree()
{
  std::vector<Vessel> all;
  branch({ { -5.0_mm, 10.0_mm, -25.0_mm }, { -12.0_mm, -2.0_mm, 5.0_mm }, 5.0_mm },
    Vector3d(1.0, 0.0, 0.25).normalized(), 3, all);
  return all;
}

double vesselDistance(const std::vector<Vessel>& vessels, const Vector3d& p)
{
  constexpr double fillet = 2.0_mm; // where they meet
  double least = 1.0;
  for (const Vessel& vessel : vessels)
  {
    const Vector3d axis = vessel.to - vessel.from;
    const double t = std::clamp((p - vessel.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    const double own = (p - vessel.from - t * axis).norm() - vessel.radius;
    const double h = std::max(fillet - std::abs(own - least), 0.0) / fillet;
    least = std::min(own, least) - h * h * h * fillet / 6.0;
  }
  constexpr double cover = 3.0_mm; // of liver around them
  return std::max(least, liverDistance(p) + cover);
}

PhantomPart vesselPart(const Phantom& body)
{
  const auto distance = [vessels = vesselTree()](const Vector3d& p)
  { return vesselDistance(vessels, p); };
  return { "vessels", distance, contoured(distance, body.low, body.high, 1.0_mm, 1.2_mm) };
}

std::vector<PhantomNodule> nodulesIn(const Phantom& body, unsigned seed)
{
  constexpr std::size_t count = 5;
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) // the same on every machine
  { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
  std::vector<PhantomNodule> nodules;
  while (nodules.size() < count)
  {
    PhantomNodule one{ Vector3d::Zero(), between(4.0_mm, 9.0_mm) };
    for (int k = 0; k < 3; ++k)
    {
      one.center[k] = between(body.low[k], body.high[k]);
    }
    const double cover = -liverDistance(one.center) - one.radius;
    const bool isFree = std::ranges::none_of(nodules,
      [&](const PhantomNodule& other)
      { return (other.center - one.center).norm() < other.radius + one.radius + 2.0_mm; });
    if (cover > 4.0_mm && cover < 12.0_mm && isFree)
    {
      nodules.push_back(one);
    }
  }
  return nodules;
}

PhantomPart nodulePart(const std::vector<PhantomNodule>& nodules)
{
  PhantomPart all{ .name = "nodules",
    .distance =
      [nodules](const Vector3d& p)
    {
      double least = 1.0;
      for (const PhantomNodule& one : nodules)
      {
        least = std::min(least, (p - one.center).norm() - one.radius);
      }
      return least;
    },
    .surface = {} };
  for (const PhantomNodule& nodule : nodules)
  {
    const Mesh one = ball("", nodule, 3).surface;
    const auto first = static_cast<int>(all.surface.points.size());
    all.surface.points.insert(all.surface.points.end(), one.points.begin(), one.points.end());
    for (const auto& [a, b, c] : one.triangles)
    {
      all.surface.triangles.push_back({ first + a, first + b, first + c });
    }
  }
  return all;
}

} // namespace

Phantom blockPhantom()
{
  return within({ block("block", { 100.0_mm, 100.0_mm, 50.0_mm }, 0.0) });
}

Phantom slabPhantom()
{
  Phantom phantom = within({ block("slab", { 120.0_mm, 120.0_mm, 62.0_mm }, 0.0),
    block("fat", { 120.0_mm, 120.0_mm, 10.0_mm }, -2.0_mm),
    block("liver", { 120.0_mm, 120.0_mm, 50.0_mm }, -12.0_mm) });
  phantom.parts.front().label = "skin";
  return phantom;
}

Phantom spherePhantom()
{
  return within({ ball("sphere", { Vector3d::Zero(), 30.0_mm }, 5) });
}

Phantom liverPhantom(unsigned seed)
{
  Phantom phantom = within({ { "liver", liverDistance, makeLiver(2.12_mm) } });
  phantom.parts.push_back(vesselPart(phantom));
  phantom.nodules = nodulesIn(phantom, seed);
  phantom.parts.push_back(nodulePart(phantom.nodules));
  return phantom;
}

} // namespace palp
