#pragma once

#include "calibration/organ/organ_model.h"
#include "calibration/organ/tangent_plane.h"
#include "haptics/force/maps/energy_weights.h"

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace palp
{

/// What the contact law tells by itself of a modulus that differs from place to place, so that a
/// body's compliance does not tell it again.
class MappedContact
{
public:
  /// Beyond a half-space of the modulus at a place, as OrganCompliance has it.
  struct Told
  {
    double constant = 0.0;                           ///< [m/N]
    Eigen::Vector3d slope = Eigen::Vector3d::Zero(); ///< [1/N]
    double bend = 0.0;                               ///< [1/(m N)]
    bool isAtBorder = false; ///< the modulus changes by half within two radii beside the place
  };

  /// @param radius  of the smooth pressure that the body is loaded by [m]
  MappedContact(const OrganModel& model, const Surface& surface, double radius);

  /// @param near  modulus at the place over that of the whole [-]
  [[nodiscard]] Told operator()(const TangentPlane& plane, double near) const;

private:
  // depths at which a sphere's contact spans that of the pressure
  struct Contact
  {
    std::size_t knot;
    double radius; // [m]
  };

  // as BodyCompliance, times E* at the place
  struct Beyond
  {
    double constant; // [1/m]
    double bend;     // [1/m^3]
  };

  [[nodiscard]] Beyond beyond(const std::function<double(const Eigen::Vector3d&)>& ratio) const;
  [[nodiscard]] bool isAtBorder(const TangentPlane& plane) const;

  const OrganModel& model_;
  const Surface& surface_;
  double radius_;
  std::optional<EnergyWeights> weights_;
  Contact narrow_{};
  Contact wide_{};
};

/// Of a body whose modulus differs from place to place; none of an even one.
/// @param radius  as MappedContact
[[nodiscard]] std::optional<MappedContact> mappedContactOf(
  const OrganModel& model, const Surface& surface, double radius);

} // namespace palp
