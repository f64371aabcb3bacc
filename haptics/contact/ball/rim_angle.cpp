#include "haptics/contact/ball/rim_angle.h"

#include "haptics/numerics/angle.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace palp
{

RimAngle::RimAngle(double radius) noexcept
  : radius_(radius)
{
}

// of at most a right angle: of half a turn the fan would not know to which side it goes
void RimAngle::addInParts(const Arc& arc, const Disc& disc) noexcept
{
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

double RimAngle::value() const noexcept
{
  return 2.0 * angleOf(sine_, cosine_) + sector_;
}

} // namespace palp
