#include "haptics/force/nodules/nodules.h"

#include "haptics/error.h"
#include "haptics/force/nodules/nodule_increment.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace palp
{
namespace
{

// several nodules together, of which one alone is never bounded
constexpr double kSumBoundedFrom = 0.9;
constexpr double kSumBound = 0.95;

// energy over depth^2, which is smooth in the root of the depth and regular at 0
std::vector<double> scaledEnergies(const HomogeneousPress& press)
{
  std::vector<double> scaled;
  for (const HomogeneousPress::Knot& knot : press.knots())
  {
    scaled.push_back(knot.energy / (knot.depth * knot.depth));
  }
  const double modulus = press.law().material().youngModulus;
  scaled.front() = 0.5 * modulus * press.knots().front().stiffness;
  return scaled;
}

void checkCount(std::size_t count)
{
  if (count > Nodules::kMost)
  {
    throw Error(ErrorCode::BadValue,
      "there are " + std::to_string(count) + " nodules; give at most " +
        std::to_string(Nodules::kMost));
  }
}

std::vector<NoduleTable> tablesOf(const HomogeneousPress& press, std::span<const Nodule> nodules)
{
  checkCount(nodules.size());
  std::vector<NoduleTable> tables;
  for (const Nodule& nodule : nodules)
  {
    tables.emplace_back(press, checkedNodule(nodule), press);
  }
  return tables;
}

} // namespace

Nodules::Nodules(const HomogeneousPress& press, std::span<const Nodule> nodules)
  : Nodules(press, tablesOf(press, nodules))
{
}

Nodules::Nodules(const HomogeneousPress& reference, std::vector<NoduleTable> tables)
  : axis_(reference.axis())
  , energies_(axis_, scaledEnergies(reference))
  , tables_(std::move(tables))
{
  checkCount(tables_.size());
}

Nodules::Place Nodules::at(std::span<const double> squares) const noexcept
{
  Place place;
  for (std::size_t i = 0; i < tables_.size(); ++i)
  {
    place[i] = tables_[i].at(squares[i]);
  }
  return place;
}

NoduleResponse Nodules::response(
  double depth, const Place& place, std::span<double> repulsion) const noexcept
{
  if (!(depth > 0.0 && std::isfinite(depth)))
  {
    return {};
  }
  const double q = std::sqrt(depth);
  // the end of the tables is approached and never reached, so that nothing breaks off there
  const increment::Series root =
    increment::bounded(q, HomogeneousPress::kInUse * axis_.last, axis_.last);

  // sum of the increments of first order, by the root of the depth
  const SplineBasis basis = splineBasis(axis_, root.value);
  increment::Series sum{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < tables_.size(); ++i)
  {
    const NoduleTable::Entry one = tables_[i](place[i], basis);
    const increment::Series first = increment::toFirstOrder(one.value);
    sum.value += first.value;
    sum.slope += first.slope * one.byRoot;
    sum.bend += first.bend * one.byRoot * one.byRoot + first.slope * one.byRootBend;
    if (!repulsion.empty())
    {
      repulsion[i] = first.slope * one.bySquare;
    }
  }
  const increment::Series bound = increment::bounded(sum.value, kSumBoundedFrom, kSumBound);
  const increment::Series whole = increment::ofFirstOrder(bound.value);
  const double bySum = whole.slope * bound.slope;
  const double bySumBend = whole.bend * bound.slope * bound.slope + whole.slope * bound.bend;
  const double slope = bySum * sum.slope;
  const double bend = bySumBend * sum.slope * sum.slope + bySum * sum.bend;

  // G = U / depth^2, and by the root of the depth, which is bounded in the tables
  const CubicSpline::Value plain = energies_(root.value);
  const double g = plain.value * whole.value;
  const double gTable = plain.slope * whole.value + plain.value * slope;
  const double gTableBend =
    plain.bend * whole.value + 2.0 * plain.slope * slope + plain.value * bend;
  const double gSlope = gTable * root.slope;
  const double gBend = gTableBend * root.slope * root.slope + gTable * root.bend;
  for (double& each : repulsion)
  {
    each *= -2.0 * depth * depth * plain.value * bySum;
  }
  return { .energy = depth * depth * g,
    .force = depth * (2.0 * g + 0.5 * q * gSlope),
    .stiffness = 2.0 * g + 1.75 * q * gSlope + 0.25 * depth * gBend };
}

void checkApart(std::span<const Nodule> nodules, std::span<const Eigen::Vector3d> places)
{
  for (std::size_t i = 0; i < nodules.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if ((places[i] - places[j]).norm() < nodules[i].radius + nodules[j].radius)
      {
        throw Error(ErrorCode::BadValue,
          "nodules " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
            " overlap; move one of them");
      }
    }
  }
}

} // namespace palp
