#include "app/commands/organ/organ_place.h"

#include "app/input/law_options.h"
#include "app/press/recording.h"
#include "calibration/organ/organ_compliance.h"
#include "calibration/organ/organ_places.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/servo/tissue_at.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"

#include <algorithm>

namespace palp
{
namespace
{

// of a file, around a place: those that reach there, and those that sharpen them, or beside an edge
// tell them how near they are
std::shared_ptr<const ComplianceField> fieldAround(const OrganModel& model,
  std::span<const Support> supports, const Surface& surface, const SurfacePoint& point)
{
  constexpr double kBesideEdge = 3.0; // cells
  const bool isBesideEdge =
    surface.shape().edgeDistance(point.position) < kBesideEdge * model.side();
  const double around = isBesideEdge ? 8.0 : 5.0; // spacings
  OrganTable table;
  table.cell = model.side();
  table.spacing = spacingOf(surface, table.cell);
  std::vector<SurfacePoint> places = organPlaces(surface, table.spacing);
  std::erase_if(places,
    [&](const SurfacePoint& place)
    {
      return (place.position - point.position).norm() > around * table.spacing ||
        place.normal.dot(point.normal) <= 0.0;
    });
  table.count = places.size();
  (void)addPlaces(table, model, surface,
    { .places = places, .supports = supports, .tell = [](const OrganTable&) {} });
  return std::make_shared<const ComplianceField>(table.places, table.spacing, model.poissonRatio());
}

} // namespace

OrganPlace::OrganPlace(const OrganModel& model, std::span<const Support> supports,
  const Scene& scene, const SurfacePoint& point)
  : point_(point)
  , cell_(model.side())
  , isHeld_(std::ranges::any_of(
      supports, [&](const Support& support) { return support.holds(point.position); }))
  , thickness_(rayExit(scene.surface->tree(), point.position, -point.normal).distance)
  , isTooThin_(isTooThin(
      point, *scene.surface, model.side(), supports, narrowGaps(*scene.surface, model.side())))
  , edge_(scene.surface->shape().edgeDistance(point.position))
  , scene_(scene)
{
  const Surface& surface = *scene.surface;
  if (!complianceAt(model, surface, point.position, point.normal))
  {
    throw Error(ErrorCode::BadValue,
      "too little of the surface is around the place " + units::inMillimeters(point.position.x()) +
        ", " + units::inMillimeters(point.position.y()) + ", " +
        units::inMillimeters(point.position.z()) +
        (model.leftOut() > 0.0 ? ", it is on a piece that is left out," : ",") +
        " or the body hangs over it or rises beside it; give smaller cells, or another place");
  }
  scene_.series = seriesBodyOf(fieldAround(model, supports, surface, point), scene.law);
}

// A place nearer to an edge than two cells is known by its neighbors only.
const char* OrganPlace::remarkOf(const ToolPose& pose, const SeriesResponse& answer) const
{
  const double travel = (point_.position - pose.apex).dot(point_.normal);
  constexpr double kTwo = 2.0; // cells
  const SeriesContact contact{ point_.position, point_.normal, answer.felt.contactRadius,
    answer.felt.force, thickness_, edge_ };
  const BodyCompliance body = scene_.series->field->at(point_.position, point_.normal).body;
  return isHeld_                                                           ? "on a support"
    : travel > 0.5 * thickness_                                            ? "too deep"
    : isTooThin_                                                           ? "cells too large"
    : edge_ < kTwo * cell_                                                 ? "edge"
    : answer.isBeyond || contact.width(scene_.series->law, body) > kWidest ? "contact too wide"
                                                                           : "";
}

OrganPlace::Answer OrganPlace::at(const ToolPose& pose) const
{
  const Contact contact = findContact(scene_, pose);
  const SeriesResponse answer = TissueAt(scene_, contact).answer(contact.depth);
  const std::string remark = remarkOf(pose, answer);
  return { .body = scene_.series->at(seriesPlaceOf(contact)).here,
    .force = answer.felt.force,
    .local = answer.local,
    .remark =
      remark.empty() ? brokenNames(rulesAt(scene_, Validity(scene_.law), contact)) : remark };
}

} // namespace palp
