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
#include <compare>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr std::size_t kMostTrials = 3000; // for each nodule
constexpr std::size_t kFewTrials = 300;   // when it begins anew
constexpr int kMostStarts = 300;
constexpr double kEdge = 15.0_mm; // from sharp and open edges
constexpr double kBase = 5.0_mm;  // below a nodule to the far side
constexpr double kSlack = 0.2_mm; // that a curved surface may bring it nearer

// Why a nodule may not be at a place, and what to give so that it may.
struct Obstacle
{
  std::string why; // empty: it may
  std::string remedy{};

  auto operator<=>(const Obstacle&) const = default;
};

// of a press that breaks some rule of the law
Obstacle obstacleOf(std::span<const Rule> rules, const Rule& first, const std::string& depth)
{
  const auto isBroken = [&](std::string_view name)
  {
    return std::ranges::any_of(
      rules, [&](const Rule& rule) { return rule.name == name && !rule.holds(); });
  };
  std::string remedy = "another tool, level or body";
  if (isBroken("depth") || isBroken("large_strain"))
  {
    remedy = std::string(isBroken("large_strain") ? "a sphere or a cone as tool" : "a tool") +
      (isBroken("depth") ? ", with a radius above " + depth + ", or another level"
                         : ", or the material 'linear'");
  }
  return { "a press of " + depth + " is beyond the limits of the law (" + first.name + ": " +
      first.why + ")",
    remedy };
}

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

  struct Found
  {
    PlacedNodule nodule;
    Obstacle obstacle;
  };

  // a nodule of the level there
  [[nodiscard]] Found at(const SurfacePoint& above, std::mt19937_64& engine) const
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
    return { placed,
      std::abs(depth - nodule.depth()) > kSlack
        ? Obstacle{ "the body is too thin or bent", "another level or body" }
        : obstacleAt(above, nodule) };
  }

private:
  // what keeps the level's press right above it from being one that the law knows, and feels it
  [[nodiscard]] Obstacle obstacleAt(const SurfacePoint& above, const Nodule& nodule) const
  {
    const ToolPose pose{ .apex = above.position - level_.depth * above.normal,
      .axis = -above.normal };
    const Contact contact = findContact(surface_, law_.tip(), pose, ContactRule::Exact);
    const ContactGeometry place = contactGeometryOf(contact);
    if (!contact.touching() || contact.edgeDistance < kEdge)
    {
      return { "an edge is nearer than " + units::inMillimeters(kEdge), "another side or body" };
    }
    if (place.thickness < nodule.top + 2.0 * nodule.radius + kBase)
    {
      return { "the body is too thin", "another level or body" };
    }
    const Rules rules = validity_(place, contact.edgeDistance);
    // how a body is held changes its force everywhere alike, and no contrast
    const auto broken = std::ranges::find_if(
      rules, [](const Rule& rule) { return !rule.holds() && rule.name != std::string("support"); });
    if (broken != rules.end())
    {
      return obstacleOf(rules, *broken, units::inMillimeters(level_.depth));
    }
    const NoduleContrast contrast(law_, place);
    if (!contrast.rules(nodule)[0].holds())
    {
      return { "the tool is too wide for nodules so near to it",
        "a narrower tool, or another level" };
    }
    return contrast(nodule) >= level_.contrast
      ? Obstacle{}
      : Obstacle{ "the tool would feel too little of it", "another tool or level" };
  }

  const Surface& surface_;
  const ForceLaw& law_;
  const TrainingLevel& level_;
  Validity validity_;
};

// Nodules of one plan. Those that come first may leave no room for the last: it begins anew then.
class Hiding
{
public:
  Hiding(const Surface& surface, const ForceLaw& law, const Curriculum& curriculum,
    const TrainingPlan& plan)
    : level_(curriculum.level(plan.level))
    , apart_(2.0 * (curriculum.hitWithin + level_.radius.high))
    , count_(static_cast<std::size_t>(plan.nodules > 0 ? plan.nodules : level_.nodules))
    , place_(surface, law, level_)
    , darts_(dartsFacing(surface, plan.side))
  {
    // another level, other places: those of one are shown at its end
    std::seed_seq seeds{ plan.seed,
      static_cast<std::uint32_t>(&level_ - curriculum.levels.data()) };
    engine_.seed(seeds);
  }

  [[nodiscard]] std::vector<PlacedNodule> all()
  {
    std::vector<PlacedNodule> hidden;
    std::size_t most = 0;
    for (int i = 0; i < kMostStarts; ++i)
    {
      hidden = once(count_ * (i == 0 ? kMostTrials : kFewTrials));
      most = std::max(most, hidden.size());
      if (hidden.size() == count_ || most == 0)
      {
        break;
      }
    }
    hidden.size() < count_ ? refuse(most) : void();
    return hidden;
  }

private:
  std::vector<PlacedNodule> once(std::size_t trials)
  {
    std::vector<PlacedNodule> hidden;
    std::vector<Eigen::Vector3d> above;
    for (std::size_t i = 0; i < trials && hidden.size() < count_; ++i)
    {
      const SurfacePoint place = darts_.next(engine_);
      const auto isNear = [&](const Eigen::Vector3d& other)
      { return (other - place.position).norm() < apart_; };
      if (std::ranges::any_of(above, isNear))
      {
        ++obstacles_[{
          "another nodule is nearer than " + units::inMillimeters(apart_), "another body" }];
        continue;
      }
      auto [nodule, obstacle] = place_.at(place, engine_);
      if (!obstacle.why.empty())
      {
        ++obstacles_[obstacle];
        continue;
      }
      hidden.push_back(nodule);
      above.push_back(place.position);
    }
    return hidden;
  }

  [[noreturn]] void refuse(std::size_t most) const
  {
    const Obstacle& worst = std::ranges::max_element(obstacles_, {},
      [](const auto& obstacle) {
        return obstacle.second;
      })->first;
    throw Error(ErrorCode::BadValue,
      "training: only " + std::to_string(most) + " of " + counted(count_, "nodule") +
        " of the level '" + level_.name +
        "' find room below the side that is searched, as at most places " + worst.why + "; give " +
        (most > 0 ? "fewer, another seed, or " : "") + worst.remedy);
  }

  const TrainingLevel& level_;
  double apart_; // what lies above two of them, so that no mark finds both [m]
  std::size_t count_;
  HidingPlace place_;
  AreaDarts darts_;
  std::mt19937_64 engine_;
  std::map<Obstacle, int> obstacles_; // met so far
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
  return Hiding(surface, law, curriculum, plan).all();
}

} // namespace palp
