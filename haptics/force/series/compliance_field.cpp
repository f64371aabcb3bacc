#include "haptics/force/series/compliance_field.h"

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

// how far from an edge something is, over how far a place is; it ends before the edge where the
// place tells too little of that
template <typename Lanes>
Lanes fartherOf(const Lanes& past) noexcept
{
  return kNearest + 0.5F * (past + (past * past + kRound * kRound).sqrt());
}

// over an edge, to which faces lean from either side, less than 1
double oneFaceOf(const Eigen::Vector3d& outward)
{
  return std::max(0.0, 2.0 * outward.squaredNorm() - 1.0);
}

// of what is never negative, and spread over powers of ten beside an edge
float ratioOf(float wanted, float blend)
{
  constexpr float kMost = 2.0F;
  return blend > 0.0F ? std::clamp(wanted / blend, 1.0F / kMost, kMost) : 1.0F;
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

float ComplianceField::constantOf(const Place& place) noexcept
{
  return place.beside > 0.0F ? place.rest + place.wedge / place.beside : place.rest;
}

float ComplianceField::constantOf(const Blend<1>& told) noexcept
{
  return told[kPart] > 0.0F ? told[kRest] + told[kWedge] * told[kPart] / told[kBeside]
                            : told[kRest];
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
      const Blend<1> told =
        blendAt<1>({ Spot{ one.position.cast<double>(), one.normal.cast<double>() } });
      const float beside = told[kPart];
      const bool isClose = told[kBeside] < kClose * static_cast<float>(cell_) * beside;
      next[i].rest += isClose ? one.rest - told[kRest] : constantOf(one) - constantOf(told);
      next[i].slope *= ratioOf((1.0F - beside) * one.slope, told[kSlope]);
      next[i].bend += one.bend - told[kBend];
      next[i].wedge *= ratioOf(beside * one.wedge, told[kWedge]);
      next[i].beside *= ratioOf(beside * one.beside, told[kBeside]);
    }
    places_ = std::move(next);
  }
}

// by a weight of Wendland's, 1 at a place and 0 from its reach on
template <int kSpots>
ComplianceField::Blend<kSpots> ComplianceField::blendAt(
  const std::array<Spot, kSpots>& spots) const noexcept
{
  using Lanes = Eigen::Array<float, 1, kSpots>;
  using Points = Rows<3, kSpots>;
  const auto found = cells_.find(keyOf(cellOf(spots[0].center)));
  const Range range = found != cells_.end() ? found->second : Range{};
  const Eigen::Vector3d origin = spots[0].center;
  Points centers; // from there
  Points normals;
  for (int k = 0; k < kSpots; ++k)
  {
    const Spot& spot = spots[static_cast<std::size_t>(k)];
    centers.col(k) = (spot.center - origin).array().cast<float>();
    normals.col(k) = spot.normal.array().cast<float>();
  }
  Blend<kSpots> sums = Blend<kSpots>::Zero();
  Lanes all = Lanes::Zero();
  for (std::uint32_t k = range.first; k < range.last; ++k)
  {
    const Place& place = places_[near_[k]];
    const Eigen::Vector3f to = (origin - place.position.cast<double>()).cast<float>();
    if (to.squaredNorm() >= reach_ * reach_)
    {
      continue;
    }
    const auto along = [](const Eigen::Vector3f& one, const Points& other)
    { return Lanes(one[0] * other.row(0) + one[1] * other.row(1) + one[2] * other.row(2)); };
    const Points away = centers.colwise() + to.array();
    const Lanes rest = (1.0F - perReach_ * away.square().colwise().sum().sqrt()).max(0.0F);
    constexpr float kTurns = 1.0F / (kFacing - kAskew);
    const Lanes facing = (kTurns * (along(place.normal, normals) - kAskew)).max(0.0F).min(1.0F);
    const Lanes weight =
      facing * facing * (3.0F - 2.0F * facing) * rest.square().square() * (5.0F - 4.0F * rest);
    all += weight;
    sums.row(kPart) += weight * (place.beside > 0.0F ? 1.0F : 0.0F);
    sums.template bottomRows<3>().matrix() += place.normal * weight.matrix();
    if (place.beside > 0.0F)
    {
      sums.row(kRest) += weight * place.rest;
      sums.row(kWedge) += weight * place.wedge;
      sums.row(kBeside) +=
        weight * place.beside * fartherOf<Lanes>(along(place.edge, away) + (1.0F - kNearest));
    }
    else
    {
      sums.row(kRest) += weight * (place.rest + along(place.gradient, away));
      sums.row(kSlope) += weight * place.slope;
    }
    sums.row(kBend) += weight * place.bend;
    sums.row(kDoubtful) += weight * place.doubtful;
  }
  if (!(all.minCoeff() > 0.0F))
  {
    sums.setZero();
    sums.row(kDoubtful) = 1.0F;
    return sums;
  }
  return sums.rowwise() / all;
}

template <int kSpots>
std::array<ComplianceField::Local, kSpots> ComplianceField::tellAt(
  std::array<Spot, kSpots> spots) const noexcept
{
  Blend<kSpots> blend = blendAt<kSpots>(spots);
  if (spots[0].height > 0.0 && blend(kPart, 0) > 0.0F)
  {
    for (int k = 0; k < kSpots; ++k)
    {
      Spot& spot = spots[static_cast<std::size_t>(k)];
      const Eigen::Vector3f outward = blend.col(k).template tail<3>().matrix().normalized();
      const Eigen::Vector3d leaning = static_cast<double>(blend(kPart, k)) * spot.height *
        (spot.normal - outward.template cast<double>());
      // beyond an edge no further than places reach
      spot.center += leaning / std::sqrt(1.0 + leaning.squaredNorm() / (cell_ * cell_));
    }
    blend = blendAt<kSpots>(spots);
  }
  std::array<Local, kSpots> told;
  for (int k = 0; k < kSpots; ++k)
  {
    told[static_cast<std::size_t>(k)] = localOf(blend.col(k));
  }
  return told;
}

// beside edges, of the wedge that places there tell together: W/D, its slope W/(2 D^2), and 1/D by
// its part of all slope
ComplianceField::Local ComplianceField::localOf(const Blend<1>& told) noexcept
{
  const auto values = told.cast<double>().eval();
  Local local{ .body = { values[kRest], values[kSlope], values[kBend], 0.0 },
    .doubtful = values[kDoubtful] };
  BodyCompliance& body = local.body;
  if (values[kPart] > 0.0)
  {
    const double nearness = values[kPart] / values[kBeside];
    const double lean = 0.5 * values[kWedge] * nearness * nearness;
    body.constant += values[kWedge] * nearness;
    body.slope += lean;
    body.edge = lean > 0.0 ? lean / body.slope * nearness : 0.0;
  }
  body.slope *= oneFaceOf(values.tail<3>().matrix());
  return local;
}

ComplianceField::Local ComplianceField::at(
  const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double height) const noexcept
{
  return tellAt<1>({ Spot{ center, normal, height } })[0];
}

std::array<ComplianceField::Local, 4> ComplianceField::atFour(
  const std::array<Spot, 4>& spots) const noexcept
{
  return tellAt<4>(spots);
}

} // namespace palp
