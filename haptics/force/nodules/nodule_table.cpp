#include "haptics/force/nodules/nodule_table.h"

#include "haptics/error.h"
#include "haptics/force/nodules/nodule_increment.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// lateral^2 / (lateral^2 + reach^2), which takes all distances and is smooth at 0
constexpr SplineAxis kLateral{ 0.0, 1.0, 48 };

double reachSquareOf(const HomogeneousPress& press, const Nodule& nodule)
{
  if (nodule.depth() + nodule.radius > press.thickness())
  {
    throw Error(ErrorCode::BadValue,
      "a nodule reaches below the base of the body; move it up, or make it smaller");
  }
  const double widest = press.knots().back().radius;
  return nodule.depth() * nodule.depth() + widest * widest;
}

// one row for each distance, of the depths
std::vector<double> energiesOf(const HomogeneousPress& press, const Nodule& nodule,
  const HomogeneousPress& reference, double reachSquare)
{
  const std::size_t knots = press.knots().size();
  std::vector<double> rows;
  for (int i = 0; i < kLateral.intervals; ++i)
  {
    const double t = i * kLateral.step();
    std::vector<double> increments =
      firstOrderIncrements(press, nodule, std::sqrt(reachSquare * t / (1.0 - t)));
    std::ranges::transform(increments, increments.begin(), increment::ofNodule);
    // a contact that is a point has no increment; a flat has the same at all small depths
    const std::vector<double> energies = press.weightedEnergies(increments);
    rows.push_back(
      flatRadius(press.law().tip()) > 0.0 ? energies[1] / reference.knots()[1].energy : 0.0);
    for (std::size_t k = 1; k < knots; ++k)
    {
      rows.push_back(energies[k] / reference.knots()[k].energy);
    }
  }
  rows.resize(rows.size() + knots, 0.0); // infinitely far
  return rows;
}

} // namespace

NoduleTable::NoduleTable(
  const HomogeneousPress& press, const Nodule& nodule, const HomogeneousPress& reference)
  : reachSquare_(reachSquareOf(press, nodule))
  , energies_(kLateral, press.axis(), energiesOf(press, nodule, reference, reachSquare_))
{
}

NoduleTable::Aside NoduleTable::at(double lateralSquare) const noexcept
{
  const double part = 1.0 / (lateralSquare + reachSquare_);
  return { splineBasis(kLateral, lateralSquare * part), reachSquare_ * part * part };
}

NoduleTable::Entry NoduleTable::operator()(
  const Aside& aside, const SplineBasis& root) const noexcept
{
  const BicubicSpline::Value at = energies_(aside.basis, root);
  return { at.value, at.x * aside.bySquare, at.y, at.yy };
}

} // namespace palp
