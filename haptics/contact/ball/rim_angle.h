#pragma once

#include <Eigen/Core>
#include <cmath>

namespace palp
{

/// a (b x c), number by number: read in pairs soon after it was stored, b x c would be waited for.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline double tripleProduct(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) noexcept
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The plane of a triangle that a ball cuts a disc out of, seen from the ball's center.
struct Disc
{
  Eigen::Vector3d normal; ///< of the triangle, of unit length
  double height;          ///< of the plane along it [m]
  double squared;         ///< radius of the disc, squared [m^2]; above 0
};

/// A way along the rim of a disc, counter-clockwise about its normal.
struct Arc
{
  Eigen::Vector3d from; ///< on the ball [m]
  Eigen::Vector3d to;   ///< on the ball [m]
  double cosine;        ///< of the turn, times the squared radius of the disc [m^2]
  double sine;          ///< of the turn, times the same [m^2]
};

/// The solid angle of a surface within a ball, from the center, by where it leaves the ball: a fan
/// from a fixed direction to each arc of its rim. What is wholly within the ball costs nothing.
///
/// Known up to whole spheres, 4 pi.
class RimAngle
{
public:
  /// A turn back by less is none: by rounding, where a corner is upon the ball [rad].
  static constexpr double kRounding = 1e-9;

  /// @param radius  of the ball [m]
  explicit RimAngle(double radius) noexcept;

  /// The part of a triangle's rim.
  /// @param turn  of all arcs of the disc [rad]
  /// @realtime    pure; no allocation, no lock, no exception
  void turn(double turn, const Disc& disc) noexcept
  {
    sector_ += turn * (1.0 - disc.height / radius_);
  }

  /// One of its arcs.
  /// @realtime  pure; no allocation, no lock, no exception
  void add(const Arc& arc, const Disc& disc) noexcept
  {
    if (arc.cosine > 0.0 && arc.sine >= -kRounding * arc.cosine)
    {
      addShort(arc, disc);
    }
    else
    {
      addInParts(arc, disc);
    }
  }

  /// @return  up to whole spheres [rad^2]
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double value() const noexcept;

private:
  static constexpr double kLarge =
    1e120; // [-] product that is made smaller again, or larger below 1 over that

  // of unit length, along no direction in which bodies are built
  static Eigen::Vector3d pole() noexcept
  {
    return { -36.0 / 65.0, 5.0 / 13.0, 48.0 / 65.0 };
  }

  void addInParts(const Arc& arc, const Disc& disc) noexcept;

  // a spherical triangle from the pole to the ends of the arc, less the same from the normal, whose
  // sector is summed apart
  void addShort(const Arc& arc, const Disc& disc) noexcept
  {
    const Eigen::Vector3d fixed = pole();
    const double dot = arc.cosine + disc.height * disc.height;
    const double sine = tripleProduct(fixed, arc.from, arc.to);
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

  double radius_;
  double sector_ = 0.0;
  double cosine_ = 1.0; // of half of the fan, times anything
  double sine_ = 0.0;
};

} // namespace palp
