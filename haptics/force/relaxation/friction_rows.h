#pragma once

#include "haptics/force/relaxation/contact_rows.h"

#include <Eigen/Core>
#include <span>

namespace palp
{

/// Tangential over normal stiffness of a contact that sticks: 8 G a / (2 - nu) over 2 E* a.
[[nodiscard]] constexpr double tangentialRatio(double poissonRatio) noexcept
{
  return 2.0 * (1.0 - poissonRatio) / (2.0 - poissonRatio);
}

/// Friction between tool and tissue, row by row: each sticks until it slips by itself, so the
/// contact slips from its border inward before all of it does.
///
/// A row keeps its force, not its stretch: what opens or becomes softer loses energy, and nothing
/// drifts. The normal problem knows nothing of it.
///
/// @source  Cattaneo 1938; Mindlin, Deresiewicz 1953; the rows: Popov, Hess 2015
class FrictionRows
{
public:
  struct Tissue
  {
    double coefficient;  ///< mu [-], 0 or more
    double poissonRatio; ///< nu [-]
    double softer = 1.0; ///< than the tissue, so that the tangential stiffness is what may be [-]
  };

  /// @param loads   force of each row along the normal [N]; of those that are not named: 0
  /// @param normal  unit length; the force is in the plane across it
  /// @param moved   the tool on the tissue since the last tick [m]
  /// @return        force of the tool on the tissue [N], no longer than mu times all loads
  /// @realtime      no allocation, no lock, no exception
  Eigen::Vector3d drag(const ContactRows& rows, std::span<const double> loads, const Tissue& tissue,
    const Eigen::Vector3d& normal, const Eigen::Vector3d& moved) noexcept;

private:
  std::array<Eigen::Vector3d, ContactRows::kCount> force_{}; // [N]
  std::array<double, ContactRows::kCount> stiffness_{};      // tangential, last tick [N/m]
  std::size_t used_ = 0;
};

/// How far a contact carries the tissue along before all of it slips, from the force that it drags
/// it with.
///
/// @param drag    force along the surface [N]
/// @param load    force along the normal [N]
/// @param shear   G [Pa]
/// @param radius  of the contact [m]
/// @return        [m]; 0 where nothing is in contact
/// @source        Cattaneo 1938: Q = mu F (1 - (1 - u / us)^1.5), us = 3 mu F (2 - nu) / 16 G a
[[nodiscard]] double carriedBy(double drag, double load, const FrictionRows::Tissue& tissue,
  double shear, double radius) noexcept;

} // namespace palp
