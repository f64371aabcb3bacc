#include "app/bench/bench.h"
#include "data/shapes.h"
#include "haptics/contact/find_contact.h"
#include "haptics/surface/closest_point.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kTool = 10.0_mm;

// the force of Hertz, up to a constant
double hertz(double depth)
{
  return std::pow(std::max(0.0, depth), 1.5);
}

// a bumpy, organ-sized body over a sphere of 10 4^splits + 2 points
Surface makeBody(int splits)
{
  Mesh mesh = makeSphere(1.0, splits);
  for (Eigen::Vector3d& p : mesh.points)
  {
    const Eigen::Vector3d x = p.normalized();
    const double bump = 1.0 + 0.10 * std::sin(3.0 * x.x() + 1.0) * std::cos(2.0 * x.y()) +
      0.06 * std::sin(5.0 * x.z() + 2.0 * x.x());
    p = bump * x.cwiseProduct(Eigen::Vector3d(75.0_mm, 50.0_mm, 35.0_mm));
  }
  return { std::move(mesh.points), std::move(mesh.triangles) };
}

Contact press(const Surface& surface, const Eigen::Vector3d& apex, const Eigen::Vector3d& outward,
  ContactRule rule)
{
  return findContact(surface, SphereTip{ .radius = kTool },
    { .apex = apex, .axis = -outward, .velocity = Eigen::Vector3d::Zero() }, rule);
}

// error of the force against the distance of the tool's center to the fine mesh
void reportErrors(
  std::ostream& out, const Surface& coarse, const Surface& fine, double depth, ContactRule rule)
{
  constexpr int kPresses = 1000;
  std::mt19937 random(1);
  std::vector<double> percent;
  for (int i = 0; i < kPresses; ++i)
  {
    const std::size_t point = random() % fine.points().size();
    const Eigen::Vector3d outward = fine.normals()[point];
    const Eigen::Vector3d apex = fine.points()[point] - depth * outward;
    const double truth =
      hertz(kTool - findClosestPoint(fine, apex + kTool * outward, 1.0).distance);
    const double force = hertz(press(coarse, apex, outward, rule).depth);
    percent.push_back(100.0 * std::abs(force / truth - 1.0));
  }
  std::sort(percent.begin(), percent.end());
  out << std::setw(7) << coarse.points().size() << " points, " << std::setw(4)
      << units::toMillimeters(depth) << " mm deep, "
      << (rule == ContactRule::Exact ? "exact" : "paper") << ": p50 " << percent[kPresses / 2]
      << " %, p99 " << percent[kPresses * 99 / 100] << " %\n";
}

// 60 mm along a tessellated sphere at constant depth, 100 mm/s at 1 kHz
template <typename ForceAt>
void reportSlide(std::ostream& out, const char* name, ForceAt forceAt)
{
  constexpr double kBody = 50.0_mm;
  constexpr double kDepth = 3.0_mm;
  const Eigen::Vector3d start = Eigen::Vector3d(1.0, 0.3, 0.2).normalized();
  const Eigen::Vector3d toward = start.cross(Eigen::Vector3d(0.1, 0.2, 1.0)).normalized();
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  double direction = 0.0;
  double change = 0.0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int i = 0; i <= 600; ++i)
  {
    const double angle = i * 0.1_mm / kBody;
    const Eigen::Vector3d outward = std::cos(angle) * start + std::sin(angle) * toward;
    const Eigen::Vector3d force = forceAt((kBody - kDepth) * outward, outward);
    least = std::min(least, force.norm());
    most = std::max(most, force.norm());
    direction = std::max(direction, std::acos(std::min(1.0, force.dot(outward) / force.norm())));
    change = i > 0 ? std::max(change, (force - last).norm() / force.norm()) : 0.0;
    last = force;
  }
  out << name << ": ripple of |F| " << 100.0 * (most - least) / (most + least)
      << " %, direction off by up to " << units::toDegrees(direction)
      << " degrees, largest change in 1 ms " << 100.0 * change << " %\n";
}

} // namespace

void reportAccuracy(std::ostream& out)
{
  out << std::setprecision(3);
  const Surface fine = makeBody(8);
  out << "Force error from the mesh, sphere R = 10 mm, against the distance to "
      << fine.points().size() << " points:\n";
  for (const int splits : { 4, 5, 6 })
  {
    const Surface coarse = makeBody(splits);
    for (const double depth : { 1.0_mm, 5.0_mm })
    {
      for (const ContactRule rule : { ContactRule::Exact, ContactRule::Paper })
      {
        reportErrors(out, coarse, fine, depth, rule);
      }
    }
  }

  const Mesh mesh = makeSphere(50.0_mm, 4);
  const Surface ball(mesh.points, mesh.triangles);
  out << "Sliding 3 mm deep over a sphere of 50 mm with edges of "
      << units::toMillimeters(ball.edgeLength()) << " mm:\n";
  reportSlide(out, "exact  ",
    [&](const Eigen::Vector3d& apex, const Eigen::Vector3d& outward)
    {
      const Contact contact = press(ball, apex, outward, ContactRule::Exact);
      return Eigen::Vector3d(hertz(contact.depth) * contact.normal);
    });
  reportSlide(out, "nearest",
    [&](const Eigen::Vector3d& apex, const Eigen::Vector3d& outward)
    {
      const Eigen::Vector3d center = apex + kTool * outward;
      const ClosestPoint nearest = findClosestPoint(ball, center, 1.0);
      return Eigen::Vector3d(
        hertz(kTool - nearest.distance) * (center - nearest.point).normalized());
    });
  reportSlide(out, "paper  ",
    [&](const Eigen::Vector3d& apex, const Eigen::Vector3d& outward)
    {
      const Contact contact = press(ball, apex, outward, ContactRule::Paper);
      return Eigen::Vector3d(hertz(contact.depth) * contact.normal);
    });
}

} // namespace palp
