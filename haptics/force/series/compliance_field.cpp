#include "haptics/force/series/compliance_field.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kReach = 2.3; // spacings
// spacings to an edge, as near as one is taken to be: of 2 mm by cells of 4 mm, within which a
// contact is as wide as it is far, and 1/D of its center too much
constexpr double kNearest = 0.6;
constexpr float kClose = 1.5F;  // spacings to an edge, within which W/D changes from place to place
constexpr double kOver = 0.25;  // spacings over the faces, from which on a spot is in a hollow
constexpr float kFacing = 0.7F; // cosine of normals from which on a place counts in full
constexpr float kAskew = 0.1F;  // likewise, to which it is beyond an edge and does not count

// of columns
template <typename Points>
[[gnu::always_inline]] inline auto lengthsOf(const Points& points) noexcept
{
  auto lengths = points.square().colwise().sum().eval();
  for (float& length : lengths) // in a single instruction
  {
    length = std::sqrt(length);
  }
  return lengths;
}

// each column's part along one
template <typename Rows>
[[gnu::always_inline]] inline auto along(const Eigen::Vector3f& one, const Rows& others) noexcept
{
  return (one[0] * others.row(0) + one[1] * others.row(1) + one[2] * others.row(2)).eval();
}

// smoothStep() of each lane, in single precision
template <typename Row>
[[gnu::always_inline]] inline auto smoothStepOf(const Row& row) noexcept
{
  const auto within = row.max(0.0F).min(1.0F).eval();
  return (within * within * (3.0F - 2.0F * within)).eval();
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
    const Eigen::Vector3d away = -place.slope.normalized();
    const Eigen::Vector3d gradient = (isBeside ? 0.0 : 2.0) * place.slope;
    places_.push_back({ .position = place.position.cast<float>(),
      .normal = place.normal.cast<float>(),
      .gradient = gradient.cast<float>(),
      .edge = away.cast<float>(),
      .curves = { Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero() },
      .rest = static_cast<float>(place.constant - 2.0 * slope * distance),
      .slope = static_cast<float>(isBeside ? 0.0 : slope),
      .bend = static_cast<float>(place.bend),
      .wedge = static_cast<float>(2.0 * slope * distance * distance),
      .beside = static_cast<float>(distance),
      .doubtful = place.trust == ComplianceTrust::Known ? 0.0F : 1.0F,
      .isBetween = place.edge < 0.0 });
  }
  sortIntoCells();
  for (Place& place : places_)
  {
    if (place.isBetween)
    {
      place.curves = curvesAt(place);
    }
  }
  sharpen();
}

float ComplianceField::constantOf(const Place& place) noexcept
{
  return place.beside > 0.0F ? place.rest + place.wedge / place.beside : place.rest;
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
      const Around<1> spot({ Spot{ one.position.cast<double>(), one.normal.cast<double>() } });
      const Blend<1> told = blendAt<1>(spot, near(one.position.cast<double>()));
      const auto constant = static_cast<float>(localsOf<1>(told)[0].body.constant);
      const float beside = told[kPart];
      const bool isClose = told[kBeside] < kClose * static_cast<float>(cell_) * beside;
      next[i].rest += isClose ? one.rest - told[kRest] : constantOf(one) - constant;
      next[i].slope *= ratioOf((1.0F - beside) * one.slope, told[kSlope]);
      next[i].bend += one.bend - told[kBend];
      next[i].wedge *= ratioOf(beside * one.wedge, told[kWedge]);
      next[i].beside *= ratioOf(beside * one.beside, told[kBeside]);
    }
    places_ = std::move(next);
  }
}

template <int kSpots>
ComplianceField::Around<kSpots>::Around(const std::array<Spot, kSpots>& spots) noexcept
  : origin(spots[0].center.template cast<float>())
{
  for (int k = 0; k < kSpots; ++k)
  {
    const Spot& spot = spots[static_cast<std::size_t>(k)];
    centers.col(k) = (spot.center - origin.template cast<double>()).array().template cast<float>();
    normals.col(k) = spot.normal.array().template cast<float>();
    heights[k] = static_cast<float>(spot.height);
  }
}

template <int kSpots>
void ComplianceField::Around<kSpots>::move(const Rows<3, kSpots>& way) noexcept
{
  const Eigen::Vector3f before = origin;
  origin += way.col(0).matrix();
  centers += way.colwise() - (origin - before).array(); // exact, as they are near to each other
}

// by a weight of Wendland's, 1 at a place and 0 from its reach on
template <int kSpots, typename Visit>
[[gnu::always_inline]] inline ComplianceField::Lanes<kSpots> ComplianceField::forNear(
  const Around<kSpots>& spots, const Range& range, const Visit& visit) const noexcept
{
  const Eigen::Vector3f normal = spots.normals.col(0);
  constexpr float kTurned = 0.05F; // more than the spots' normals differ
  Lanes<kSpots> all = Lanes<kSpots>::Zero();
  for (std::uint32_t k = range.first; k < range.last; ++k)
  {
    const Place& place = places_[near_[k]];
    const Eigen::Vector3f to = spots.origin - place.position;
    const float cosine = place.normal.dot(normal);
    if (to.squaredNorm() >= reach_ * reach_ || cosine < kAskew - kTurned)
    {
      continue;
    }
    const Rows<3, kSpots> away = spots.centers.colwise() + to.array();
    const Lanes<kSpots> rest = (1.0F - perReach_ * lengthsOf(away)).max(0.0F);
    Lanes<kSpots> weight = rest.square().square() * (5.0F - 4.0F * rest);
    if (cosine < kFacing + kTurned)
    {
      constexpr float kTurns = 1.0F / (kFacing - kAskew);
      weight *= smoothStepOf(kTurns * (along(place.normal, spots.normals) - kAskew));
    }
    all += weight;
    visit(place, away, weight);
  }
  return all;
}

template <int kSpots>
ComplianceField::Blend<kSpots> ComplianceField::blendAt(
  const Around<kSpots>& spots, const Range& range) const noexcept
{
  Blend<kSpots> sums;
  sums.setConstant(0.0F);
  const Lanes<kSpots> all = forNear<kSpots>(
    spots, range,
    [&](const Place& place, const Rows<3, kSpots>& away, const Lanes<kSpots>& weight)
      __attribute__((always_inline)) {
        sums.template bottomRows<3>().matrix() += place.normal * weight.matrix();
        sums.row(kBend) += weight * place.bend;
        if constexpr (kSpots == 1) // four are not asked for it
        {
          sums.row(kDoubtful) += weight * place.doubtful;
        }
        if (place.beside > 0.0F)
        {
          sums.row(kPart) += weight;
          sums.row(kRest) += weight * place.rest;
          sums.row(kWedge) += weight * place.wedge;
          sums.row(kBeside) += weight * (place.beside + along(place.edge, away));
        }
        else
        {
          sums.row(kRest) += weight * (place.rest + along(place.gradient, away));
          sums.row(kSlope) += weight * place.slope;
          if (place.isBetween)
          {
            const Lanes<kSpots> first = along(place.curves[0], away);
            const Lanes<kSpots> second = along(place.curves[1], away);
            const Rows<3, kSpots> gradient =
              (place.curves[0] * first.matrix() + place.curves[1] * second.matrix())
                .array()
                .colwise() +
              place.gradient.array();
            sums.row(kRest) += weight * 0.5F * (first.square() + second.square());
            sums.row(kSlope) += weight * (0.5F * lengthsOf(gradient) - place.slope);
          }
        }
      });
  if (!(all.minCoeff() > 0.0F))
  {
    sums.setZero();
    sums.row(kDoubtful) = 1.0F;
    return sums;
  }
  return sums.rowwise() / all;
}

template <int kSpots>
ComplianceField::Faces<kSpots> ComplianceField::facesAt(
  const Around<kSpots>& spots, const Range& range) const noexcept
{
  Faces<kSpots> sums{ Rows<3, kSpots>::Zero(), Lanes<kSpots>::Zero(), Lanes<kSpots>::Zero() };
  const Lanes<kSpots> all = forNear<kSpots>(
    spots, range,
    [&](const Place& place, const Rows<3, kSpots>& away, const Lanes<kSpots>& weight)
      __attribute__((always_inline)) {
        sums.outward.matrix() += place.normal * weight.matrix();
        sums.above += weight * along(place.normal, away);
        if (place.beside > 0.0F)
        {
          sums.part += weight;
        }
      });
  constexpr float kNone = 1e-30F; // of all weights: nothing is beside an edge there
  sums.above /= all.max(kNone);
  sums.part /= all.max(kNone);
  return sums;
}

// over an edge the normal leans from that of the face, whose foot is elsewhere; where two faces
// meet in a hollow, both are pressed, and the foot would leap from one to the other
template <int kSpots>
ComplianceField::Rows<3, kSpots> ComplianceField::toFace(
  const Around<kSpots>& spots, const Faces<kSpots>& faces) const noexcept
{
  const auto over = static_cast<float>(kOver * cell_);
  const Lanes<kSpots> flat = smoothStepOf(1.0F - faces.above / over);
  const Rows<3, kSpots> leaning =
    (spots.normals - faces.outward.rowwise() / lengthsOf(faces.outward)).rowwise() *
    (flat * faces.part * spots.heights);
  // beyond an edge no further than places reach
  const auto most = static_cast<float>(cell_);
  return leaning.rowwise() / (1.0F + (lengthsOf(leaning) / most).square()).sqrt();
}

template <int kSpots>
std::array<ComplianceField::Local, kSpots> ComplianceField::tellAt(
  const std::array<Spot, kSpots>& asked) const noexcept
{
  constexpr float kStill = 2e-8F; // [m] that moves a force by less than 1e-5 of itself
  Around<kSpots> spots(asked);
  Range range = near(asked[0].center);
  if (spots.heights[0] > 0.0F && range.isBesideEdge)
  {
    const Faces<kSpots> faces = facesAt(spots, range);
    if (faces.part.minCoeff() > 0.0F)
    {
      const Rows<3, kSpots> way = toFace(spots, faces);
      if (way.abs().maxCoeff() > kStill)
      {
        spots.move(way);
        range = near(spots.origin.template cast<double>());
      }
    }
  }
  return localsOf<kSpots>(blendAt(spots, range));
}

// beside edges, of the wedge that places there tell together: W/D, its slope W/(2 D^2), and 1/D by
// its part of all slope
template <int kSpots>
std::array<ComplianceField::Local, kSpots> ComplianceField::localsOf(
  const Blend<kSpots>& told) const noexcept
{
  using Values = Eigen::Array<double, 1, kSpots>;
  const auto values = told.template cast<double>().eval();
  // over an edge, to which faces lean from either side, less than 1
  const Values twoFaces =
    (2.0 - 2.0 * values.template bottomRows<3>().square().colwise().sum()).min(1.0);
  const Values oneFace = 1.0 - twoFaces.square();
  const Values part = values.row(kPart);
  const Values distance =
    (values.row(kBeside).max(0.0).square().square() + (kNearest * cell_ * part).square().square())
      .sqrt()
      .sqrt();
  const Values nearness = part / (part > 0.0).select(distance, 1.0);
  const Values wedge = values.row(kWedge) * nearness;
  const Values lean = 0.5 * wedge * nearness;
  const Values slope = values.row(kSlope) + lean;
  std::array<Local, kSpots> locals;
  for (int k = 0; k < kSpots; ++k)
  {
    locals[static_cast<std::size_t>(k)] = {
      { values(kRest, k) + wedge[k], slope[k] * oneFace[k], values(kBend, k),
        lean[k] > 0.0 ? lean[k] / slope[k] * nearness[k] : 0.0 },
      values(kDoubtful, k)
    };
  }
  return locals;
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
