#pragma once

#include "haptics/force/series/compliance_field.h"
#include "haptics/force/series/series_law.h"
#include "haptics/force/validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace palp
{

/// Where a tool stands over a body, and how that changes as the tool moves.
struct SeriesPlace
{
  Eigen::Vector3d tool;    ///< its reference point [m]
  Eigen::Vector3d normal;  ///< mean of the body below, outward, of unit length
  double height;           ///< of the tool over the surface [m]
  Eigen::Matrix3d turning; ///< of the normal, a column for each way in which the tool moves [1/m]
  Eigen::Vector3d rising;  ///< of the height [-]
};

/// A body that gives way as a whole, felt by the tool of a law.
struct SeriesBody
{
  std::shared_ptr<const ComplianceField> field; ///< never null
  SeriesLaw law;

  /// Poisson's ratio from that of the file on which forces are off by several percent [-].
  static constexpr double kOtherPoisson = 0.05;

  /// How far the tissue's is from that of the file [-].
  [[nodiscard]] double otherPoisson(const ForceLaw& tissue) const noexcept
  {
    return std::abs(tissue.material().poissonRatio - field->poissonRatio());
  }

  /// The body below a tool, and below the same a step aside along each axis.
  struct Below
  {
    BodyCompliance here;
    std::array<BodyCompliance, 3> aside;
  };

  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Below at(const SeriesPlace& place) const noexcept;

  /// On the tool, toward where the body gives way more [N].
  ///
  /// @param load  of the body where the tool stands
  /// @realtime    pure; no allocation, no lock, no exception
  [[nodiscard]] Eigen::Vector3d lateral(
    const Below& body, const SeriesLaw::Loaded& load) const noexcept;
};

/// @return  null where there is no field
[[nodiscard]] std::shared_ptr<const SeriesBody> seriesBodyOf(
  std::shared_ptr<const ComplianceField> field, const ForceLaw& law);

/// A contact on a body, as far as it tells whether what is told of that is enough.
struct SeriesContact
{
  Eigen::Vector3d center;                                        ///< on the surface [m]
  Eigen::Vector3d normal;                                        ///< outward, of unit length
  double radius = 0.0;                                           ///< [m]
  double force = 0.0;                                            ///< [N]
  double thickness = std::numeric_limits<double>::infinity();    ///< of what is below [m]
  double edgeDistance = std::numeric_limits<double>::infinity(); ///< to a sharp one [m]

  /// Radius over the thickness, half of it over the distance to the edge, and one and a half times
  /// how far the pressure moves: from 0.5 on the first terms about the center are off by some
  /// percent and soon by ten.
  [[nodiscard]] double width(const SeriesLaw& law, const BodyCompliance& body) const noexcept
  {
    return std::max(
      { radius / thickness, radius / (2.0 * edgeDistance), 1.5 * law.aside(body, force) });
  }
};

inline constexpr double kWidest = 0.5; ///< of SeriesContact::width() that is right

/// What of a contact with such a body may not be believed: edges, thin places and supports that its
/// cells are too large for, or that are too near for its radius, and a body of another Poisson's
/// ratio.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule seriesRule(
  const SeriesBody& body, const ForceLaw& law, const SeriesContact& contact) noexcept;

} // namespace palp
