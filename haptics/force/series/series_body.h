#pragma once

#include "haptics/force/series/compliance_field.h"
#include "haptics/force/series/series_law.h"
#include "haptics/force/validity.h"

#include <memory>

namespace palp
{

/// A body that gives way as a whole, felt by the tool of a law.
struct SeriesBody
{
  std::shared_ptr<const ComplianceField> field; ///< never null
  SeriesLaw law;
  double height = 0.0; ///< of the tool's reference point over its deepest one [m]
  double softer = 1.0; ///< modulus of the law over that which the field is told by [-]

  /// At a contact of a depth.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] ComplianceField::Local at(
    const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double depth) const noexcept
  {
    ComplianceField::Local local = field->at(center, normal, law.roundness() - depth);
    local *= softer;
    return local;
  }
};

/// @return  null where there is no field
[[nodiscard]] std::shared_ptr<const SeriesBody> seriesBodyOf(
  std::shared_ptr<const ComplianceField> field, const ForceLaw& law);

/// What of a contact with such a body may not be believed: edges, thin places and supports that its
/// cells are too large for, a body of another Poisson's ratio, a support that is too near.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule seriesRule(const SeriesBody& body, const ForceLaw& law,
  const Eigen::Vector3d& center, const Eigen::Vector3d& normal) noexcept;

} // namespace palp
