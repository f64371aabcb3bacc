#include "haptics/contact/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace palp
{
namespace
{

// what the boundary of triangle and disc adds up to: straight pieces, and the turn of the arcs
class Boundary
{
public:
  Boundary(const Eigen::Vector3d& normal, double squaredRadius) noexcept
    : normal_(normal)
    , squaredRadius_(squaredRadius)
  {
  }

  // from u to v, both in the plane and seen from the middle of the disc
  void side(const Eigen::Vector3d& u, const Eigen::Vector3d& v) noexcept
  {
    const Eigen::Vector3d along = v - u;
    const double a = along.squaredNorm();
    const double b = u.dot(along);
    const double root = b * b - a * (u.squaredNorm() - squaredRadius_);
    if (!(root > 0.0))
    {
      arc(u, v);
      return;
    }
    const double enter = (-b - std::sqrt(root)) / a;
    const double leave = (-b + std::sqrt(root)) / a;
    if (enter >= 1.0 || leave <= 0.0)
    {
      arc(u, v);
      return;
    }
    crossed_ = true;
    Eigen::Vector3d from = u;
    Eigen::Vector3d to = v;
    if (enter > 0.0)
    {
      from = u + enter * along;
      arc(u, from);
    }
    if (leave < 1.0)
    {
      to = u + leave * along;
      arc(to, v);
    }
    line(from, to);
  }

  [[nodiscard]] DiscIntegral close(bool middleInside) const noexcept
  {
    // the turns were multiplied as complex numbers: one arctangent, known up to a full turn
    double turn = std::atan2(turn_.imag(), turn_.real());
    if (!middleInside)
    {
      turn = std::max(0.0, turn);
    }
    else if (!crossed_)
    {
      turn = 2.0 * std::numbers::pi; // the whole disc
    }
    else if (turn < -kRounding)
    {
      turn += 2.0 * std::numbers::pi;
    }
    return { .area = area_ + 0.5 * turn * squaredRadius_,
      .weight = weight_ + 0.25 * turn * squaredRadius_ * squaredRadius_ };
  }

private:
  static constexpr double kRounding = 1e-9; // [rad]

  void line(const Eigen::Vector3d& u, const Eigen::Vector3d& v) noexcept
  {
    const double area = 0.5 * normal_.dot(u.cross(v));
    area_ += area;
    weight_ += area * (squaredRadius_ - (u.squaredNorm() + v.squaredNorm() + u.dot(v)) / 6.0);
  }

  void arc(const Eigen::Vector3d& u, const Eigen::Vector3d& v) noexcept
  {
    const double x = u.dot(v);
    const double y = normal_.dot(u.cross(v));
    turn_ = { turn_.real() * x - turn_.imag() * y, turn_.real() * y + turn_.imag() * x };
    turn_ /= squaredRadius_;
  }

  Eigen::Vector3d normal_;
  double squaredRadius_;
  double area_ = 0.0;
  double weight_ = 0.0;
  std::complex<double> turn_ = 1.0;
  bool crossed_ = false;
};

} // namespace

DiscIntegral integrate(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept
{
  const std::array<Eigen::Vector3d, 3> p = { facet.corners[0] - center, facet.corners[1] - center,
    facet.corners[2] - center };
  const double height = facet.normal.dot(p[0]);
  const double disc = squaredRadius - height * height;
  if (!(disc > 0.0))
  {
    return {};
  }
  const std::array<double, 3> q = { p[0].squaredNorm(), p[1].squaredNorm(), p[2].squaredNorm() };
  if (std::max({ q[0], q[1], q[2] }) <= squaredRadius)
  {
    const double area = 0.5 * facet.normal.dot((p[1] - p[0]).cross(p[2] - p[0]));
    const double meanSquare = (q[0] + q[1] + q[2] + (p[0] + p[1] + p[2]).squaredNorm()) / 12.0;
    return { .area = area, .weight = area * (squaredRadius - meanSquare) };
  }

  const Eigen::Vector3d middle = height * facet.normal;
  const std::array<Eigen::Vector3d, 3> u = { p[0] - middle, p[1] - middle, p[2] - middle };
  Boundary boundary(facet.normal, disc);
  bool middleInside = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d& v = u[(k + 1) % 3];
    boundary.side(u[k], v);
    middleInside = middleInside && facet.normal.dot(u[k].cross(v)) > 0.0;
  }
  return boundary.close(middleInside);
}

Patch patchWithin(const Surface& surface, const Eigen::Vector3d& center, double radius, double side,
  double fade) noexcept
{
  Patch patch;
  const double squaredRadius = radius * radius;
  const BoxTree& tree = surface.tree();
  const auto near = [&](const BoxTree::Node& box)
  { return squaredDistance(box, center) < squaredRadius; };
  const auto add = [&](int i)
  {
    const Facet& facet = tree.facets()[static_cast<std::size_t>(i)];
    const double height = facet.normal.dot(center - facet.corners[0]);
    const double part = 1.0 + std::min(0.0, side * height) / fade;
    if (!(part > 0.0))
    {
      return;
    }
    const DiscIntegral inside = integrate(facet, center, squaredRadius);
    patch.area += part * inside.area;
    patch.weight += part * inside.weight;
    patch.normal += part * inside.weight * facet.normal;
    patch.height += part * inside.area * height;
  };
  tree.search(near, add);
  return patch;
}

} // namespace palp
