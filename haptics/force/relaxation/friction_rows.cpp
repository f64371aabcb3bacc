#include "haptics/force/relaxation/friction_rows.h"

namespace palp
{

Eigen::Vector3d FrictionRows::drag(const ContactRows& rows, std::span<const double> loads,
  const Tissue& tissue, const Eigen::Vector3d& normal, const Eigen::Vector3d& moved) noexcept
{
  const double ratio = tissue.softer * tangentialRatio(tissue.poissonRatio);
  const auto along = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d
  { return v - v.dot(normal) * normal; };
  const Eigen::Vector3d slide = along(moved);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t j = loads.size(); j < used_; ++j)
  {
    force_[j].setZero(); // open
  }
  for (std::size_t j = 0; j < loads.size(); ++j)
  {
    Eigen::Vector3d& force = force_[j];
    if (j >= used_)
    {
      force.setZero();
    }
    const double stiffness = ratio * rows.stiffness[j];
    // what a softer row keeps of its stretch, it loses of its force; never the other way round
    const double kept = j < used_ && stiffness < stiffness_[j] ? stiffness / stiffness_[j] : 1.0;
    stiffness_[j] = stiffness;
    force = kept * along(force) + stiffness * slide;
    const double most = tissue.coefficient * loads[j];
    const double size = force.norm();
    if (!(size <= most))
    {
      force =
        size > 0.0 && most > 0.0 ? Eigen::Vector3d(force * (most / size)) : Eigen::Vector3d::Zero();
    }
    sum += force;
  }
  used_ = loads.size();
  return sum;
}

double carriedBy(double drag, double load, const FrictionRows::Tissue& tissue, double shear,
  double radius) noexcept
{
  const double slipping = tissue.coefficient * load;
  if (!(slipping > 0.0 && radius > 0.0))
  {
    return 0.0;
  }
  const double most = 3.0 * slipping * (2.0 - tissue.poissonRatio) / (16.0 * shear * radius);
  const double sticks = 1.0 - std::min(1.0, drag / slipping);
  return most * (1.0 - std::cbrt(sticks * sticks));
}

} // namespace palp
