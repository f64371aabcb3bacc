#include "haptics/force/series/compliance_field.h"

#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr double kReach = 2.3;    // spacings
constexpr float kNearest = 0.25F; // to an edge that a place tells of, by its own distance
constexpr float kRound = 0.15F;   // likewise, within which it comes to that
constexpr float kClose = 1.5F;  // spacings to an edge, within which W/D changes from place to place
constexpr float kFacing = 0.7F; // cosine of normals from which on a place counts in full
constexpr float kAskew = 0.3F;  // likewise, to which it is beyond an edge and does not count

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
  float value;
  Eigen::Vector3f turn;
};
Nearer nearerOf(const Eigen::Vector3f& edge, const Eigen::Vector3f& away) noexcept
{
  const float past = 1.0F + edge.dot(away) - kNearest;
  const float round = std::sqrt(past * past + kRound * kRound);
  const float nearer = 1.0F / (kNearest + 0.5F * (past + round));
  return { nearer, -0.5F * nearer * (1.0F + past / round) * edge };
}

// to where something is beside a wedge from there; where 1/D ends within the blend it changes by
// more than in a wedge, which is no way toward an edge
void bringNearer(ComplianceField::Local& local, const Eigen::Vector3d& away)
{
  BodyCompliance& body = local.body;
  const double squaredEdge = body.edge * body.edge;
  const double like = std::min(1.0, squaredEdge / local.edge.norm());
  const double most = (1.0 - static_cast<double>(kNearest)) / body.edge;
  const double reached = std::min(most, like * like * local.edge.dot(away) / squaredEdge);
  const double nearer = 1.0 / (1.0 - body.edge * reached);
  const double squared = nearer * nearer;
  body.constant += 2.0 * body.slope * nearer * reached;
  body.slope *= squared;
  body.edge *= nearer;
  local.constant *= squared;
  local.slope *= squared * nearer;
  local.edge *= squared;
}

// over an edge, to which faces lean from either side, less than 1
double oneFaceOf(const Eigen::Vector3d& outward)
{
  return std::max(0.0, 2.0 * outward.squaredNorm() - 1.0);
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

ComplianceField::ComplianceField(std::span<const PlacedCompliance> places, double spacing,
  double poisson, std::shared_ptr<const OrganMotion> motion, double young)
  : reach_(static_cast<float>(kReach * spacing))
  , perReach_(1.0F / reach_)
  , cell_(spacing)
  , poisson_(poisson)
  , young_(young)
  , motion_(std::move(motion))
{
  for (const PlacedCompliance& place : places)
  {
    const double slope = place.slope.norm();
    const bool isBeside = place.edge > 0.0;
    const double distance = isBeside ? 1.0 / place.edge : 0.0;
    const Eigen::Vector3d away = -place.edge * place.slope.normalized();
    const Eigen::Vector3d gradient = (isBeside ? 0.0 : 2.0) * place.slope;
    places_.push_back({ .position = place.position.cast<float>(),
      .normal = place.normal.cast<float>(),
      .gradient = gradient.cast<float>(),
      .edge = away.cast<float>(),
      .rest = static_cast<float>(place.constant - 2.0 * slope * distance),
      .slope = static_cast<float>(isBeside ? 0.0 : slope),
      .bend = static_cast<float>(place.bend),
      .wedge = static_cast<float>(2.0 * slope * distance * distance),
      .beside = static_cast<float>(distance),
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
  const auto forReached = [this](const auto& visit)
  {
    for (std::uint32_t i = 0; i < places_.size(); ++i)
    {
      forCellsWithin(places_[i].position.cast<double>(), [&](Range& cell) { visit(cell, i); });
    }
  };
  forReached([](Range& cell, std::uint32_t) { ++cell.last; });
  std::uint32_t count = 0;
  for (auto& [key, cell] : cells_)
  {
    const std::uint32_t first = std::exchange(count, count + cell.last);
    cell = { first, first };
  }
  near_.resize(count);
  forReached([this](Range& cell, std::uint32_t i) { near_[cell.last++] = i; });
}

template <typename Visit>
void ComplianceField::forCellsWithin(const Eigen::Vector3d& position, const Visit& visit)
{
  const int around = static_cast<int>(std::ceil(reach_ / cell_));
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
      visit(cells_[keyOf(cell)]);
    }
  }
}

// one of Wendland's, 1 at the place and 0 from the reach on
inline ComplianceField::Weight ComplianceField::weightOf(
  const Place& place, const Eigen::Vector3f& away, const Eigen::Vector3f& normal) const noexcept
{
  const float squared = away.squaredNorm();
  constexpr float kTurns = 1.0F / (kFacing - kAskew);
  const float beside = kTurns * (normal.dot(place.normal) - kAskew);
  if (squared >= reach_ * reach_ || beside <= 0.0F)
  {
    return { 0.0F, 0.0F };
  }
  const float t = std::sqrt(squared) * perReach_;
  const float rest = 1.0F - t;
  const float facing = beside >= 1.0F ? 1.0F : static_cast<float>(smoothStep(beside));
  const float cube = facing * rest * rest * rest;
  return { cube * rest * (4.0F * t + 1.0F), -20.0F * cube * perReach_ * perReach_ };
}

float ComplianceField::constantOf(const Place& place) noexcept
{
  return place.beside > 0.0F ? place.rest + place.wedge / place.beside : place.rest;
}

double ComplianceField::constantOf(const Eigen::Matrix<double, kTold, 1>& told) noexcept
{
  return told[kPart] > 0.0 ? told[kRest] + told[kWedge] * told[kPart] / told[kBeside] : told[kRest];
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
      const Place& one = wanted[i];
      const auto values = blendAt(one.position.cast<double>(), one.normal.cast<double>()).values;
      const auto beside = static_cast<float>(values[kPart]);
      const bool isClose = values[kBeside] < kClose * cell_ * values[kPart];
      next[i].rest += isClose ? one.rest - static_cast<float>(values[kRest])
                              : constantOf(one) - static_cast<float>(constantOf(values));
      next[i].slope *= ratioOf((1.0F - beside) * one.slope, values[kSlope]);
      next[i].bend += one.bend - static_cast<float>(values[kBend]);
      next[i].wedge *= ratioOf(beside * one.wedge, values[kWedge]);
      next[i].beside *= ratioOf(beside * one.beside, values[kBeside]);
    }
    places_ = std::move(next);
  }
}

ComplianceField::Blend ComplianceField::blendAt(
  const Eigen::Vector3d& center, const Eigen::Vector3d& normal) const noexcept
{
  // times the weight and its gradient
  Eigen::Matrix<float, 4, kTold> sums = Eigen::Matrix<float, 4, kTold>::Zero();
  Eigen::Vector4f weights = Eigen::Vector4f::Zero(); // by themselves
  Eigen::Vector3f outward = Eigen::Vector3f::Zero(); // of the places
  float doubtful = 0.0F;
  const Eigen::Vector3f facing = normal.cast<float>();
  const auto found = cells_.find(keyOf(cellOf(center)));
  const Range range = found != cells_.end() ? found->second : Range{};
  for (std::uint32_t k = range.first; k < range.last; ++k)
  {
    const Place& place = places_[near_[k]];
    const Eigen::Vector3f away = (center - place.position.cast<double>()).cast<float>();
    const Weight weight = weightOf(place, away, facing);
    if (weight.value <= 0.0F)
    {
      continue;
    }
    Eigen::Matrix<float, kTold, 1> told = Eigen::Matrix<float, kTold, 1>::Zero();
    told[kBend] = place.bend;
    if (place.beside > 0.0F)
    {
      const auto [nearer, turn] = nearerOf(place.edge, away);
      told[kRest] = place.rest;
      told[kWedge] = place.wedge;
      told[kBeside] = place.beside / nearer;
      told[kPart] = 1.0F;
      sums.col(kBeside).tail<3>() -= told[kBeside] * weight.value * turn;
    }
    else
    {
      told[kRest] = place.rest + place.gradient.dot(away);
      told[kSlope] = place.slope;
      sums.col(kRest).tail<3>() += weight.value * place.gradient;
    }
    Eigen::Vector4f how;
    how << weight.value, weight.slope * away;
    sums.noalias() += how * told.transpose();
    weights += how;
    outward += weight.value * place.normal;
    doubtful += weight.value * place.doubtful;
  }
  const auto all = static_cast<double>(weights[0]);
  if (!(all > 0.0))
  {
    return {};
  }
  Blend blend{ .values = sums.row(0).transpose().cast<double>() / all,
    .gradients = sums.bottomRows<3>().cast<double>() / all,
    .outward = outward.cast<double>() / all,
    .doubtful = static_cast<double>(doubtful) / all };
  blend.gradients -= weights.tail<3>().cast<double>() * blend.values.transpose() / all;
  blend.gradients -= normal * (normal.transpose() * blend.gradients);
  return blend;
}

// of the wedge that places beside an edge tell together: W/D, its slope W/(2 D^2), and 1/D by its
// part of all slope
void ComplianceField::addEdge(Local& local, const Blend& blend) noexcept
{
  const double wedge = blend.values[kWedge];
  const double part = blend.values[kPart];
  const double nearness = part / blend.values[kBeside];
  const Eigen::Vector3d nearer = nearness *
    (blend.gradients.col(kPart) / part - blend.gradients.col(kBeside) / blend.values[kBeside]);
  const Eigen::Vector3d sharper = blend.gradients.col(kWedge);
  const double lean = 0.5 * wedge * nearness * nearness;
  const Eigen::Vector3d leaning = nearness * (0.5 * nearness * sharper + wedge * nearer);
  local.body.constant += wedge * nearness;
  local.constant += nearness * sharper + wedge * nearer;
  local.body.slope += lean;
  local.slope += leaning;
  const double share = lean > 0.0 ? lean / local.body.slope : 0.0;
  local.body.edge = share * nearness;
  local.edge = share * nearer;
  if (share > 0.0)
  {
    local.edge += nearness / local.body.slope * (leaning - share * local.slope);
  }
}

ComplianceField::Local ComplianceField::at(
  const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double height) const noexcept
{
  const Blend blend = blendAt(center, normal);
  const auto& values = blend.values;
  const auto& gradients = blend.gradients;
  Local local{ .body = { values[kRest], values[kSlope], values[kBend], 0.0 },
    .constant = gradients.col(kRest),
    .slope = gradients.col(kSlope),
    .bend = gradients.col(kBend),
    .doubtful = blend.doubtful };
  values[kPart] > 0.0 ? addEdge(local, blend) : void();
  const double oneFace = oneFaceOf(blend.outward);
  local.body.slope *= oneFace;
  local.slope *= oneFace;
  if (height > 0.0 && local.body.edge > 0.0)
  {
    bringNearer(local, height * (normal - blend.outward.normalized()));
  }
  return local;
}

} // namespace palp
