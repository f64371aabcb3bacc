#pragma once

#include "haptics/force/maps/energy_weights.h"

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace palp
{

/// What the contact law answers by itself of a stiffness that differs from place to place, so that
/// a body's compliance does not tell it again.
class MappedContact
{
public:
  /// Beyond a half-space of the modulus at the place, as BodyCompliance has it.
  struct Beyond
  {
    double constant = 0.0; ///< times E* of that half-space [1/m]
    double bend = 0.0;     ///< likewise [1/m^3]
  };

  /// @param radius   of the smooth pressure that the body is solved for [m]
  /// @param poisson  0 to below 0.5 [-]
  MappedContact(double radius, double poisson);

  /// @param ratio  modulus over that at the place: x and y along the surface, z below it [m]; not
  ///               finite where it is not known
  [[nodiscard]] Beyond operator()(const std::function<double(const Eigen::Vector3d&)>& ratio) const;

private:
  // depths at which a sphere's contact spans that of the pressure
  struct Contact
  {
    std::size_t knot;
    double radius; // [m]
  };

  std::optional<EnergyWeights> weights_;
  Contact narrow_{};
  Contact wide_{};
};

} // namespace palp
