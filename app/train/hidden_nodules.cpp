#include "app/train/hidden_nodules.h"

#include "app/train/search_area.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/force/nodules/detection.h"
#include "haptics/force/validity.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/sampling/area_darts.h"
#include "haptics/units.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kMostTrials = 3000; // for each nodule
constexpr double kEdge = 15.0_mm; // from sharp and open edges
constexpr double kBase = 5.0_mm;  // below a nodule to the far side
constexpr double kSlack = 0.2_mm; // that a curved surface may bring it nearer

class HidingPlace
{
public:
  HidingPlace(const Surface& surface, const ForceLaw& law, const TrainingLevel& level)
    : surface_(surface)
    , law_(law)
    , level_(level)
    , validity_(law, { .deepest = level.depth })
  {
  }

  // a nodule of the level there, if one may be
  [[nodiscard]] std::optional<PlacedNodule> at(
    const SurfacePoint& above, std::mt19937_64& engine) const
  {
    const auto within = [&](const TrainingLevel::Span& span)
    { return span.low + (span.high - span.low) * uniform(engine); };
    const Nodule nodule{
      .radius = within(level_.radius), .top = within(level_.cover), .ratio = within(level_.ratio)
    };
    const PlacedNodule placed{ .center = above.position - nodule.depth() * above.normal,
      .radius = nodule.radius,
      .ratio = nodule.ratio };
    const double depth =
      -findClosestPoint(surface_, placed.center, std::numeric_limits<double>::infinity()).distance;
    const bool isWell = std::abs(depth - nodule.depth()) <= kSlack && isPressable(above, nodule);
    return isWell ? std::optional(placed) : std::nullopt;
  }

private:
  // whether the level's press right above it is one that the law knows, and feels it
  [[nodiscard]] bool isPressable(const SurfacePoint& above, const Nodule& nodule) const
  {
    const ToolPose pose{ .apex = above.position - level_.depth * above.normal,
      .axis = -above.normal };
    const Contact contact = findContact(surface_, law_.tip(), pose, ContactRule::Exact);
    const ContactGeometry place = contactGeometryOf(contact);
    if (!contact.touching() || contact.edgeDistance < kEdge ||
      place.thickness < nodule.top + 2.0 * nodule.radius + kBase ||
      brokenRules(validity_(place, contact.edgeDistance)) != 0)
    {
      return false;
    }
    const NoduleContrast contrast(law_, place);
    return contrast(nodule) >= level_.contrast && contrast.rules(nodule)[0].holds();
  }

  const Surface& surface_;
  const ForceLaw& law_;
  const TrainingLevel& level_;
  Validity validity_;
};

} // namespace

std::vector<PlacedNodule> hideNodules(const Surface& surface, const ForceLaw& law,
  const Curriculum& curriculum, const TrainingPlan& plan)
{
  if (law.settings().mode != LawMode::Corrected || !law.settings().coatings.empty())
  {
    throw Error(
      ErrorCode::BadValue, "training: nodules take the law 'corrected' and no coating; give these");
  }
  const TrainingLevel& level = curriculum.level(plan.level);
  const AreaDarts darts = dartsFacing(surface, plan.side);
  const HidingPlace hiding(surface, law, level);
  const auto count = static_cast<std::size_t>(plan.nodules > 0 ? plan.nodules : level.nodules);
  // another level, other places: those of one are shown at its end
  std::seed_seq seeds{ plan.seed, static_cast<std::uint32_t>(&level - curriculum.levels.data()) };
  std::mt19937_64 engine(seeds);
  std::vector<PlacedNodule> hidden;
  std::vector<Eigen::Vector3d> above;
  for (std::size_t i = 0; i < count * kMostTrials && hidden.size() < count; ++i)
  {
    const SurfacePoint place = darts.next(engine);
    const auto isNear = [&](const Eigen::Vector3d& other)
    { return (other - place.position).norm() < 2.0 * (curriculum.hitWithin + level.radius.high); };
    if (std::ranges::any_of(above, isNear))
    {
      continue;
    }
    if (const auto nodule = hiding.at(place, engine))
    {
      hidden.push_back(*nodule);
      above.push_back(place.position);
    }
  }
  if (hidden.size() < count)
  {
    throw Error(ErrorCode::BadValue,
      "training: only " + std::to_string(hidden.size()) + " of " + counted(count, "nodule") +
        " of the level '" + level.name +
        "' find room below the side that is searched; give fewer, another level or another body");
  }
  return hidden;
}

} // namespace palp
