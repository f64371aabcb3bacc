#pragma once

#include <Eigen/Core>

namespace palp
{

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
  void add(const Arc& arc, const Disc& disc) noexcept;

  /// @return  up to whole spheres [rad^2]
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double value() const noexcept;

private:
  void addShort(const Arc& arc, const Disc& disc) noexcept;

  double radius_;
  double sector_ = 0.0;
  double cosine_ = 1.0; // of half of the fan, times anything
  double sine_ = 0.0;
};

} // namespace palp
