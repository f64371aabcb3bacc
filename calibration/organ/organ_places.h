#pragma once

#include "calibration/organ/organ_model.h"
#include "calibration/tables/organ_table.h"
#include "haptics/surface/surface_point.h"

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

namespace palp
{

/// What a table of a body is made of, and who is told of it.
struct OrganWork
{
  std::span<const SurfacePoint> places; ///< all of them
  std::span<const Support> supports;
  std::function<void(const OrganTable&)> tell; ///< after some more places
  std::stop_token stop{};
};

/// Distance of places that is small against the cells, of a few thousand of them [m].
[[nodiscard]] double spacingOf(const Surface& surface, double cell);

/// One over the distance of a place to a sharp edge, for a field that is as beside it [1/m]; 0
/// from five cells on.
[[nodiscard]] double nearnessToEdge(
  const Surface& surface, const Eigen::Vector3d& place, double cell);

/// Where two sides of a surface face each other across so little that cells glue them together [m]:
/// a lobe above a fissure of 2 mm was ten times too stiff by cells of 4 mm.
[[nodiscard]] std::vector<Eigen::Vector3d> narrowGaps(const Surface& surface, double cell);

/// Whether a body is thinner below a place than its cells tell, or such a gap below it or near:
/// bonded plates of two cells are too soft by 2 %, a free one of three too stiff by 6 %.
/// @param gaps  of the surface
[[nodiscard]] bool isTooThin(const SurfacePoint& place, const Surface& surface, double cell,
  std::span<const Support> supports, std::span<const Eigen::Vector3d> gaps);

/// Places all over a surface, each with the normal of what a tool meets there: of a flat face also
/// next to its edges. The same surface gives the same.
/// @throws Error  as placeGrid
[[nodiscard]] std::vector<SurfacePoint> organPlaces(const Surface& surface, double spacing);

/// Adds the places of a table that are still missing, on every processor.
///
/// @param table  knows the first places, or none
/// @return       whether all are there; else it was stopped
[[nodiscard]] bool addPlaces(
  OrganTable& table, const OrganModel& model, const Surface& surface, const OrganWork& work);

} // namespace palp
