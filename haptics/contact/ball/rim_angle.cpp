#include "haptics/contact/ball/rim_angle.h"

#include "haptics/numerics/angle.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kLarge =
  1e120; // [-] product that is made smaller again, or larger below 1 over that

// of unit length, along no direction in which bodies are built
Eigen::Vector3d pole() noexcept
{
  return { -36.0 / 65.0, 5.0 / 13.0, 48.0 / 65.0 };
}

} // namespace

RimAngle::RimAngle(double radius) noexcept
  : radius_(radius)
{
}

void RimAngle::add(const Arc& arc, const Disc& disc) noexcept
{
  if (arc.cosine > 0.0 && arc.sine >= -kRounding * arc.cosine)
  {
    addShort(arc, disc);
    return;
  }
  // in parts of at most a right angle: of half a turn the fan would not know to which side it goes
  double turn = angleOf(arc.sine, arc.cosine);
  turn += turn < 0.0 ? 2.0 * std::numbers::pi : 0.0;
  const double parts = std::ceil(turn / (0.5 * std::numbers::pi));
  const double cosine = std::cos(turn / parts);
  const double sine = std::sin(turn / parts);
  const Eigen::Vector3d foot = disc.height * disc.normal;
  Arc part{ arc.from, arc.to, disc.squared * cosine, disc.squared * sine };
  for (double i = 1.0; i <= parts; i += 1.0)
  {
    const Eigen::Vector3d out = part.from - foot;
    part.to = i < parts ? foot + cosine * out + sine * disc.normal.cross(out) : arc.to;
    addShort(part, disc);
    part.from = part.to;
  }
}

// a spherical triangle from the pole to the ends of the arc, less the same from the normal, whose
// sector is summed apart
void RimAngle::addShort(const Arc& arc, const Disc& disc) noexcept
{
  const Eigen::Vector3d fixed = pole();
  const double dot = arc.cosine + disc.height * disc.height;
  const double sine = fixed.dot(arc.from.cross(arc.to));
  const double cosine = radius_ * (radius_ + fixed.dot(arc.from + arc.to)) + dot;
  const double ownSine = (radius_ - disc.height) * arc.sine;
  const double ownCosine =
    (radius_ + disc.height) * disc.squared + (radius_ - disc.height) * arc.cosine;
  const double perSize = 0.5 / (radius_ * radius_ * radius_ * disc.squared);
  const double stepCosine = (cosine * ownCosine + sine * ownSine) * perSize;
  const double stepSine = (sine * ownCosine - cosine * ownSine) * perSize;
  const double turned = cosine_ * stepCosine - sine_ * stepSine;
  sine_ = cosine_ * stepSine + sine_ * stepCosine;
  cosine_ = turned;
  const double size = std::abs(cosine_) + std::abs(sine_);
  if (size > kLarge || size * kLarge < 1.0)
  {
    cosine_ /= size;
    sine_ /= size;
  }
}

double RimAngle::value() const noexcept
{
  return 2.0 * angleOf(sine_, cosine_) + sector_;
}

} // namespace palp
