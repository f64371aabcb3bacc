#include "haptics/force/series/compliance_field.h"

#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace palp
{
namespace
{

constexpr double kReach = 2.3;    // spacings
constexpr double kNearest = 0.25; // to an edge that a place tells of, by its own distance
constexpr double kRound = 0.15;   // likewise, within which it comes to that
constexpr double kBeside = 0.7;   // cosine of normals from which on a place counts in full
constexpr double kAskew = 0.3;    // likewise, to which it is beyond an edge and does not count

std::uint64_t keyOf(const std::array<int, 3>& cell)
{
  constexpr std::uint64_t mask = (1U << 21U) - 1U;
  const auto part = [&](std::size_t i) { return static_cast<std::uint64_t>(cell[i]) & mask; };
  return part(0) << 42U | part(1) << 21U | part(2);
}

// how much nearer to an edge than a place something is, and the gradient of its logarithm; it ends
// before the edge where the place tells too little of that
struct Nearer
{
  double value;
  Eigen::Vector3d turn;
};
Nearer nearerOf(const Eigen::Vector3d& edge, const Eigen::Vector3d& away)
{
  const double past = 1.0 + edge.dot(away) - kNearest;
  const double round = std::hypot(past, kRound);
  const double nearer = 1.0 / (kNearest + 0.5 * (past + round));
  return { nearer, -0.5 * nearer * (1.0 + past / round) * edge };
}

// of what is never negative, and spread over powers of ten beside an edge
float ratioOf(float wanted, double blend)
{
  constexpr double kMost = 2.0;
  return blend > 0.0
    ? static_cast<float>(std::clamp(static_cast<double>(wanted) / blend, 1.0 / kMost, kMost))
    : 1.0F;
}

} // namespace

ComplianceField::ComplianceField(
  std::span<const PlacedCompliance> places, double spacing, double poisson)
  : reach_(kReach * spacing)
  , cell_(spacing)
  , poisson_(poisson)
{
  for (const PlacedCompliance& place : places)
  {
    const Eigen::Vector3d away = -place.edge * place.slope.normalized();
    places_.push_back({ .position = place.position.cast<float>(),
      .normal = place.normal.cast<float>(),
      .gradient = (2.0 * place.slope).cast<float>(),
      .edge = away.cast<float>(),
      .constant = static_cast<float>(place.constant),
      .slope = static_cast<float>(place.slope.norm()),
      .bend = static_cast<float>(place.bend),
      .beside = static_cast<float>(place.edge),
      .doubtful = place.trust == ComplianceTrust::Known ? 0.0F : 1.0F });
  }
  sortIntoCells();
  sharpen();
}

ComplianceField::Cell ComplianceField::cellOf(const Eigen::Vector3d& place) const noexcept
{
  return { static_cast<int>(std::floor(place.x() / cell_)),
    static_cast<int>(std::floor(place.y() / cell_)),
    static_cast<int>(std::floor(place.z() / cell_)) };
}

// each cell knows every place that reaches into it, so that a contact looks at one cell only
void ComplianceField::sortIntoCells()
{
  std::map<std::uint64_t, std::vector<std::uint32_t>> lists;
  const int around = static_cast<int>(std::ceil(reach_ / cell_));
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    const Eigen::Vector3d position = places_[i].position.cast<double>();
    const Cell middle = cellOf(position);
    const int side = 2 * around + 1;
    for (int k = 0; k < side * side * side; ++k)
    {
      const Cell cell{ middle[0] + k % side - around, middle[1] + k / side % side - around,
        middle[2] + k / (side * side) - around };
      const Eigen::Vector3d low = cell_ * Eigen::Vector3d(cell[0], cell[1], cell[2]);
      const Eigen::Vector3d nearest =
        position.cwiseMax(low).cwiseMin(low + Eigen::Vector3d::Constant(cell_));
      if ((nearest - position).norm() < reach_)
      {
        lists[keyOf(cell)].push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  for (const auto& [key, list] : lists)
  {
    Range& range = cells_[key];
    range.first = static_cast<std::uint32_t>(near_.size());
    near_.insert(near_.end(), list.begin(), list.end());
    range.last = static_cast<std::uint32_t>(near_.size());
  }
}

// one of Wendland's, 1 at the place and 0 from the reach on
ComplianceField::Weight ComplianceField::weightOf(
  const Place& place, const Eigen::Vector3d& away, const Eigen::Vector3d& normal) const noexcept
{
  const double squared = away.squaredNorm();
  const double beside = (normal.dot(place.normal.cast<double>()) - kAskew) / (kBeside - kAskew);
  if (squared >= reach_ * reach_ || beside <= 0.0)
  {
    return { 0.0, 0.0 };
  }
  const double t = std::sqrt(squared) / reach_;
  const double rest = 1.0 - t;
  const double cube = (beside >= 1.0 ? 1.0 : smoothStep(beside)) * rest * rest * rest;
  return { cube * rest * (4.0 * t + 1.0), -20.0 * cube / (reach_ * reach_) };
}

// what blending evens out is added beforehand, so that it goes through the places' values
void ComplianceField::sharpen()
{
  constexpr int kSharpenings = 12;
  const std::vector<Place> wanted = places_;
  for (int n = 0; n < kSharpenings; ++n)
  {
    std::vector<Place> next = places_;
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      const BodyCompliance blend =
        at(wanted[i].position.cast<double>(), wanted[i].normal.cast<double>()).body;
      next[i].constant += wanted[i].constant - static_cast<float>(blend.constant);
      next[i].slope *= ratioOf(wanted[i].slope, blend.slope);
      next[i].bend += wanted[i].bend - static_cast<float>(blend.bend);
      next[i].beside *= ratioOf(wanted[i].beside, blend.edge);
    }
    places_ = std::move(next);
  }
}

ComplianceField::Local ComplianceField::at(
  const Eigen::Vector3d& center, const Eigen::Vector3d& normal) const noexcept
{
  Local sum; // of what is weighted, and of gradients of that
  const auto found = cells_.find(keyOf(cellOf(center)));
  double weights = 0.0;
  Eigen::Vector3d turning = Eigen::Vector3d::Zero(); // gradient of their sum
  const Range range = found != cells_.end() ? found->second : Range{};
  for (std::uint32_t k = range.first; k < range.last; ++k)
  {
    const Place& place = places_[near_[k]];
    const Eigen::Vector3d away = center - place.position.cast<double>();
    const Weight weight = weightOf(place, away, normal);
    if (weight.value <= 0.0)
    {
      continue;
    }
    const Eigen::Vector3d along = place.gradient.cast<double>();
    const auto [nearer, turn] = nearerOf(place.edge.cast<double>(), away);
    const double change = nearer * along.dot(away);
    const double constant = static_cast<double>(place.constant) + change;
    const double slope = static_cast<double>(place.slope) * nearer * nearer;
    const auto bend = static_cast<double>(place.bend);
    const double beside = static_cast<double>(place.beside) * nearer;
    weights += weight.value;
    turning += weight.slope * away;
    sum.body.constant += weight.value * constant;
    sum.body.slope += weight.value * slope;
    sum.body.bend += weight.value * bend;
    sum.body.edge += weight.value * beside;
    sum.constant +=
      weight.slope * constant * away + weight.value * (nearer * along + change * turn);
    sum.slope += slope * (weight.slope * away + 2.0 * weight.value * turn);
    sum.bend += bend * weight.slope * away;
    sum.edge += beside * (weight.slope * away + weight.value * turn);
    sum.doubtful += weight.value * static_cast<double>(place.doubtful);
  }
  if (!(weights > 0.0))
  {
    Local none;
    none.doubtful = 1.0;
    return none;
  }
  const auto along = [&](const Eigen::Vector3d& gradient, double value) -> Eigen::Vector3d
  {
    const Eigen::Vector3d whole = (gradient - value * turning) / weights;
    return whole - whole.dot(normal) * normal;
  };
  Local local;
  local.body = { .constant = sum.body.constant / weights,
    .slope = sum.body.slope / weights,
    .bend = sum.body.bend / weights,
    .edge = sum.body.edge / weights };
  local.constant = along(sum.constant, local.body.constant);
  local.slope = along(sum.slope, local.body.slope);
  local.bend = along(sum.bend, local.body.bend);
  local.edge = along(sum.edge, local.body.edge);
  local.doubtful = sum.doubtful / weights;
  return local;
}

} // namespace palp
