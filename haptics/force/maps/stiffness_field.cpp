#include "haptics/force/maps/stiffness_field.h"

#include "haptics/force/nodules/nodule_increment.h"
#include "haptics/numerics/smooth_step.h"
#include "haptics/tip/tip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

constexpr double kReach = 2.3;   // spacings
constexpr int kSharpenings = 12; // after which the blend goes through the places' values
constexpr double kBeside = 0.5;  // cosine of normals from which on a place counts in full
// up to which the force is within 5 % of finite elements, whatever the tool and the map
constexpr double kSpread = 0.05;

// energy over force times depth: 1/2 of a flat punch, 2/5 of a sphere, 1/3 of a cone
std::vector<double> energyParts(const HomogeneousPress& press)
{
  std::vector<double> parts;
  for (const HomogeneousPress::Knot& knot : press.knots())
  {
    parts.push_back(knot.depth > 0.0 ? knot.energy / (knot.force * knot.depth) : 0.0);
  }
  parts.front() = 2.0 * parts[1] - parts[2];
  return parts;
}

// The same at one place: Gauss's integral over the root of the depth, in which a force is nearly a
// polynomial.
double energyPart(const ForceLaw& law, ContactGeometry place) noexcept
{
  constexpr std::array kNodes{ 0.1127016653792583, 0.5, 0.8872983346207417 };
  constexpr std::array kWeights{ 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
  const double depth = place.depth;
  const double whole = law(place).force;
  double sum = 0.0;
  for (std::size_t i = 0; i < kNodes.size(); ++i)
  {
    place.depth = depth * kNodes[i] * kNodes[i];
    sum += kWeights[i] * 2.0 * kNodes[i] * law(place).force;
  }
  return whole > 0.0 ? sum / whole : 0.5;
}

// the end of the tables is approached and never reached, so that nothing breaks off there
increment::Series rootOf(double depth, const SplineAxis& axis) noexcept
{
  return increment::bounded(std::sqrt(depth), HomogeneousPress::kInUse * axis.last, axis.last);
}

template <typename Coefficients>
CubicSpline::Value valueOf(const Coefficients& coefficients, const SplineBasis& basis) noexcept
{
  CubicSpline::Value sum{};
  for (std::size_t i = 0; i < SplineBasis::kPieces; ++i)
  {
    const auto c = static_cast<double>(coefficients[basis.low + i]);
    sum.value += c * basis.value[i];
    sum.slope += c * basis.slope[i];
    sum.bend += c * basis.bend[i];
  }
  return sum;
}

} // namespace

StiffnessField::StiffnessField(
  const HomogeneousPress& reference, std::vector<PlacedStiffness> places, double spacing)
  : reach_(kReach * spacing)
  , height_(std::holds_alternative<SphereTip>(reference.law().tip())
        ? baseRadius(reference.law().tip())
        : 0.0)
  , axis_(reference.axis())
  , energies_(axis_, energyParts(reference))
  , cells_(reach_)
{
  for (const PlacedStiffness& place : places)
  {
    cells_.add(places_.size(), place.position);
    places_.push_back({ .position = place.position.cast<float>(),
      .normal = place.normal.cast<float>(),
      .spreads = {},
      .logs = {} });
    for (std::size_t i = 0; i <= kSpreads; ++i)
    {
      constexpr std::size_t kKnots = HomogeneousPress::kIntervals / kSpreads;
      places_.back().spreads[i] = static_cast<float>(place.spreads[kKnots * i]);
    }
  }
  sharpen(places);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const std::vector<double> coefficients = splineCoefficients(places[i].logEnergy);
    std::ranges::transform(
      coefficients, places_[i].logs.begin(), [](double c) { return static_cast<float>(c); });
  }
}

// a weight of Wendland's, 1 at the place and 0 from the reach on
StiffnessField::Near StiffnessField::near(
  const Place& place, const Eigen::Vector3d& center, const Eigen::Vector3d& normal) const noexcept
{
  const Eigen::Vector3d away = center - place.position.cast<double>();
  const double t = away.norm() / reach_;
  if (t >= 1.0)
  {
    return { 0.0, 0.0, away };
  }
  const double beside = smoothStep(normal.dot(place.normal.cast<double>()) / kBeside);
  const double rest = 1.0 - t;
  const double cube = rest * rest * rest;
  return { beside * cube * rest * (4.0 * t + 1.0), -20.0 * beside * cube / (reach_ * reach_),
    away };
}

template <typename Each>
void StiffnessField::forEachNear(const StiffnessContact& contact, Each each) const noexcept
{
  cells_.near(contact.center,
    [&](std::size_t i)
    {
      if (const Near found = near(places_[i], contact.center, contact.normal); found.weight > 0.0)
      {
        each(places_[i], found);
      }
    });
}

// what blending evens out is added beforehand
void StiffnessField::sharpen(std::vector<PlacedStiffness>& places) const
{
  struct Part
  {
    std::size_t of;
    double weight;
  };
  std::vector<std::vector<Part>> blends(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    double sum = 0.0;
    cells_.near(places[i].position,
      [&](std::size_t k)
      {
        const double weight = near(places_[k], places[i].position, places[i].normal).weight;
        sum += weight;
        blends[i].push_back({ k, weight });
      });
    for (Part& part : blends[i])
    {
      part.weight /= sum;
    }
  }
  std::vector<std::vector<double>> wanted;
  std::ranges::transform(places, std::back_inserter(wanted), &PlacedStiffness::logEnergy);
  for (int n = 0; n < kSharpenings; ++n)
  {
    std::vector<std::vector<double>> missing = wanted;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      for (const Part& part : blends[i])
      {
        for (std::size_t k = 0; k < missing[i].size(); ++k)
        {
          missing[i][k] -= part.weight * places[part.of].logEnergy[k];
        }
      }
    }
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      std::ranges::transform(
        places[i].logEnergy, missing[i], places[i].logEnergy.begin(), std::plus());
    }
  }
}

StiffnessField::Blend StiffnessField::at(const StiffnessContact& contact, const ForceLaw& law,
  const ContactGeometry& geometry) const noexcept
{
  Blend blend;
  blend.field_ = this;
  blend.contact_ = contact;
  blend.energy_ = energyPart(law, geometry) / energies_(rootOf(contact.depth, axis_).value).value;
  double sum = 0.0;
  forEachNear(contact,
    [&](const Place& place, const Near& found)
    {
      sum += found.weight;
      for (std::size_t k = 0; k < blend.logs_.size(); ++k)
      {
        blend.logs_[k] += found.weight * static_cast<double>(place.logs[k]);
      }
    });
  for (double& log : blend.logs_)
  {
    log = sum > 0.0 ? log / sum : 0.0;
  }
  return blend;
}

Response StiffnessField::Blend::operator()(const Response& plain, double depth) const noexcept
{
  if (!(depth > 0.0 && std::isfinite(depth)))
  {
    return plain;
  }
  const increment::Series root = rootOf(depth, field_->axis_);
  const CubicSpline::Value log = valueOf(logs_, splineBasis(field_->axis_, root.value));
  const double q = std::sqrt(depth);
  const double slope = log.slope * root.slope / (2.0 * q); // by the depth
  const double bend = (log.bend * root.slope * root.slope + log.slope * root.bend) / (4.0 * depth) -
    slope / (2.0 * depth);
  const double energy = energy_ * plain.force * depth * field_->energies_(root.value).value;
  const double factor = std::exp(log.value);
  return { .force = factor * (plain.force + energy * slope),
    .contactRadius = plain.contactRadius,
    .stiffness =
      factor * (plain.stiffness + 2.0 * plain.force * slope + energy * (slope * slope + bend)) };
}

Eigen::Vector3d StiffnessField::Blend::lateral(
  const Response& plain, const Eigen::Vector3d& shape, double depth) const noexcept
{
  if (!(depth > 0.0 && std::isfinite(depth)))
  {
    return shape;
  }
  const double root = rootOf(depth, field_->axis_).value;
  const SplineBasis basis = splineBasis(field_->axis_, root);
  double sum = 0.0;
  double logs = 0.0;
  Eigen::Vector3d sums = Eigen::Vector3d::Zero(); // gradients
  Eigen::Vector3d logSums = Eigen::Vector3d::Zero();
  field_->forEachNear(contact_,
    [&](const Place& place, const Near& found)
    {
      const double log = valueOf(place.logs, basis).value;
      const Eigen::Vector3d gradient = found.slope * found.away;
      sum += found.weight;
      logs += found.weight * log;
      sums += gradient;
      logSums += log * gradient;
    });
  if (!(sum > 0.0))
  {
    return shape;
  }
  const Eigen::Vector3d gradient = (logSums - logs / sum * sums) / sum;
  const Eigen::Vector3d along = gradient - gradient.dot(contact_.normal) * contact_.normal;
  const double energy = energy_ * plain.force * depth * field_->energies_(root).value;
  return std::exp(logs / sum) * (shape - energy * contact_.byTool(along, field_->height_));
}

Rule StiffnessField::rule(const StiffnessContact& contact) const noexcept
{
  const double at = kSpreads * rootOf(std::max(0.0, contact.depth), axis_).value / axis_.last;
  const std::size_t low = std::min(static_cast<std::size_t>(at), std::size_t{ kSpreads - 1 });
  const double part = at - static_cast<double>(low);
  double sum = 0.0;
  double spread = 0.0;
  forEachNear(contact,
    [&](const Place& place, const Near& found)
    {
      sum += found.weight;
      spread += found.weight *
        std::lerp(static_cast<double>(place.spreads[low]),
          static_cast<double>(place.spreads[low + 1]), part);
    });
  return { "stiffness_spread", "-", sum > 0.0 ? spread / sum : 0.0, kSpread,
    "the stiffness below the tool varies more than where the force is within 5 % of finite "
    "elements; three times as much makes it 9 % off" };
}

} // namespace palp
