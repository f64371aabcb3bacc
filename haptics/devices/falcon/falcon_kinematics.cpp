#include "haptics/devices/falcon/falcon_kinematics.h"

#include "haptics/units.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// one leg: a driven arm, a parallelogram, and the offsets at its ends [m]
constexpr double kArm = 0.060;
constexpr double kRods = 0.1025;
constexpr double kGrip = 0.01443;
constexpr double kEnds = 2.0 * 0.01125;
constexpr double kAside = -0.025;
constexpr double kBaseRadius = 0.0400;
constexpr double kBaseAside = -0.02309;
constexpr std::array<double, 3> kDirections{ 105.0_deg, -15.0_deg, -135.0_deg };

constexpr double kSingular = 1e-6;
constexpr double kFound = 1e-11; // [m]
constexpr int kMaxSteps = 10;

struct Leg
{
  double arm;   // theta 1, driven [rad]
  double rods;  // theta 2 [rad]
  double splay; // theta 3 [rad]
};

std::optional<Leg> legAt(const Vector3d& position, double direction) noexcept
{
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double along = c * position.x() + s * position.y() - kBaseRadius + kGrip;
  const double across = -s * position.x() + c * position.y() - kBaseAside + kAside;
  const double up = position.z();
  const double splay = std::acos(across / kRods);
  const double reach = kEnds + kRods * std::sin(splay);
  const double distance = std::hypot(along, up);
  const double cosine =
    (distance * distance + kArm * kArm - reach * reach) / (2.0 * kArm * distance);
  if (!(std::abs(across) <= kRods) || !(std::abs(cosine) <= 1.0))
  {
    return std::nullopt;
  }
  const double arm = std::atan2(up, along) - std::acos(cosine);
  return Leg{ arm, std::atan2(up - kArm * std::sin(arm), along - kArm * std::cos(arm)), splay };
}

} // namespace

std::optional<Vector3d> falconAngles(const Vector3d& position) noexcept
{
  Vector3d angles;
  for (int i = 0; i < 3; ++i)
  {
    const auto leg = legAt(position, kDirections[static_cast<std::size_t>(i)]);
    if (!leg)
    {
      return std::nullopt;
    }
    angles[i] = leg->arm;
  }
  return angles;
}

// the rods keep their length: their direction times the motion of both ends is the same
std::optional<Matrix3d> falconJacobian(const Vector3d& position) noexcept
{
  Matrix3d jacobian;
  for (int i = 0; i < 3; ++i)
  {
    const double direction = kDirections[static_cast<std::size_t>(i)];
    const auto leg = legAt(position, direction);
    if (!leg)
    {
      return std::nullopt;
    }
    const double lever = kArm * std::sin(leg->splay) * std::sin(leg->rods - leg->arm);
    if (!(std::abs(lever) > kSingular))
    {
      return std::nullopt;
    }
    const double along = std::cos(leg->rods) * std::sin(leg->splay);
    const double across = std::cos(leg->splay);
    const double up = std::sin(leg->rods) * std::sin(leg->splay);
    const double c = std::cos(direction);
    const double s = std::sin(direction);
    jacobian.row(i) << (c * along - s * across) / lever, (s * along + c * across) / lever,
      up / lever;
  }
  return jacobian;
}

std::optional<Vector3d> falconPosition(const Vector3d& angles, const Vector3d& near) noexcept
{
  Vector3d position = near;
  for (int step = 0; step < kMaxSteps; ++step)
  {
    const auto reached = falconAngles(position);
    const auto jacobian = falconJacobian(position);
    if (!reached || !jacobian)
    {
      return std::nullopt;
    }
    bool invertible = false;
    Matrix3d inverse = Matrix3d::Zero();
    jacobian->computeInverseWithCheck(inverse, invertible);
    const Vector3d correction = inverse * (angles - *reached);
    if (!invertible || !correction.allFinite())
    {
      return std::nullopt;
    }
    position += correction;
    if (correction.norm() < kFound)
    {
      return position;
    }
  }
  return std::nullopt;
}

double falconAngle(double counts) noexcept
{
  constexpr double kDegreesPerCount = 360.0 * 0.01425 / (0.110 * 1280.0);
  return units::fromDegrees(35.0 + counts * kDegreesPerCount);
}

Vector3d falconCenter() noexcept
{
  return { 0.0, 0.0, 0.125 };
}

std::optional<Vector3d> falconTorques(const Vector3d& position, const Vector3d& force) noexcept
{
  const auto jacobian = falconJacobian(position);
  if (!jacobian)
  {
    return std::nullopt;
  }
  // power in the legs is power at the hand: tau . J dx = F . dx
  bool invertible = false;
  Matrix3d inverse = Matrix3d::Zero();
  jacobian->computeInverseWithCheck(inverse, invertible);
  const Vector3d torques = inverse.transpose() * force;
  return invertible && torques.allFinite() ? std::optional(torques) : std::nullopt;
}

} // namespace palp
