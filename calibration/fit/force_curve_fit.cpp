#include "calibration/fit/force_curve_fit.h"

#include "haptics/error.h"
#include "haptics/numerics/minimum.h"
#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace palp::fit
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-10; // of what is searched
constexpr double kLawError = 1e-7;   // of the largest force, to which the laws are computed
constexpr int kContacts = 24;        // tried along the rows
constexpr int kExtras = 12;
constexpr int kMostSteps = 40;
constexpr int kInside = 9; // tried within a confidence region, for the ends of the scale

// evenly, both ends included
std::vector<double> spread(RootBracket over, int count)
{
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(count, over.low, over.high);
  return { at.begin(), at.end() };
}

// what is left once contact and extra value are chosen
struct Projection
{
  double scale;
  double offset;
  double sumOfSquares;
  double weight; // growth of the sum of squares with the scale's distance, squared
};

class Search
{
public:
  Search(const Measured& measured, const CurveModel& model)
    : measured_(measured)
    , model_(model)
    , shape_(measured.depths.size())
  {
    std::vector<double> depths(measured.depths.begin(), measured.depths.end());
    std::ranges::sort(depths);
    first_ = depths.front();
    span_ = depths.back() - first_;
    if (model.contact)
    {
      contacts_ = { *model.contact };
      return;
    }
    for (const double before : { 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02 })
    {
      contacts_.push_back(first_ - before * span_); // a curve may begin in contact
    }
    // two rows at least are in contact
    const double last = depths[depths.size() - 2];
    std::ranges::copy(
      spread({ first_, last - 1e-9 * span_ }, kContacts), std::back_inserter(contacts_));
  }

  CurveFit operator()()
  {
    CurveFit fit;
    fit.extra.value = model_.extra.low;
    if (model_.searchesExtra())
    {
      const auto lowest = [this](double extra) { return best(extra).value; };
      const std::vector<double> grid = spread(model_.extra, kExtras);
      fit.extra.value = minimizeAmong(lowest, grid, kTolerance * (grid.back() - grid.front())).at;
    }
    fit.contact.value = best(fit.extra.value).at;
    const Projection at = project(fit.contact.value, fit.extra.value);
    fit.forces = at.scale * shape_.array() + at.offset;
    fit.scale.value = at.scale;
    fit.offset = at.offset;
    if (!(at.scale > 0.0))
    {
      throw Error(ErrorCode::BadValue, "the force does not rise with the depth; give a press");
    }
    const auto freedom = static_cast<double>(shape_.size() - model_.parameters());
    const double t = studentQuantile(kConfidence, freedom);
    const double least = static_cast<double>(shape_.size()) *
      std::pow(kLawError * measured_.forces.lpNorm<Eigen::Infinity>(), 2);
    fit.sumOfSquares = std::max(at.sumOfSquares, least);
    most_ = fit.sumOfSquares * (1.0 + t * t / freedom);
    findIntervals(fit);
    return fit;
  }

private:
  Projection project(double contact, double extra)
  {
    for (Eigen::Index i = 0; i < shape_.size(); ++i)
    {
      const double depth = measured_.depths[i] - contact;
      shape_[i] = depth > 0.0 ? model_.shape(depth, extra) : 0.0;
    }
    const double mean = model_.offset ? 0.0 : shape_.mean();
    const double level = model_.offset ? *model_.offset : measured_.forces.mean();
    const double weight = (shape_.array() - mean).square().sum();
    const double both = ((shape_.array() - mean) * (measured_.forces.array() - level)).sum();
    const double scale = weight > 0.0 ? std::max(0.0, both / weight) : 0.0; // tissue never pulls
    const double offset = level - scale * mean;
    return { .scale = scale,
      .offset = offset,
      .sumOfSquares = (measured_.forces.array() - scale * shape_.array() - offset).square().sum(),
      .weight = weight };
  }

  // the contact of least squares
  Minimum best(double extra)
  {
    const auto squares = [&](double contact) { return project(contact, extra).sumOfSquares; };
    return minimizeAmong(squares, contacts_, kTolerance * span_);
  }

  // where the lowest sum of squares stays below its limit, around the value of a profile; infinite
  // where that is so up to the end of what is searched
  template <typename Profile>
  [[nodiscard]] RootBracket inside(const Profile& profile, double value, RootBracket whole) const
  {
    const auto end = [&](double limit, double unknown)
    {
      const auto excess = [&](double part) // of the way to the limit
      { return profile(value + part * (limit - value)) - most_; };
      RootBracket around{ 0.0, 1e-7 };
      double inner = std::min(excess(0.0), -1e-3 * most_);
      for (;; around = { around.high, std::min(1.0, 6.0 * around.high) })
      {
        if (const double outer = excess(around.high); outer > 0.0)
        {
          const double tolerance = 1e-4 * around.high;
          around = falsePosition(excess, around, inner, outer, tolerance, kMostSteps);
          return value + 0.5 * (around.low + around.high) * (limit - value);
        }
        else if (around.high >= 1.0)
        {
          return unknown;
        }
        else
        {
          inner = std::min(outer, -1e-9 * most_);
        }
      }
    };
    return { end(whole.low, -kInfinity), end(whole.high, kInfinity) };
  }

  [[nodiscard]] RootBracket contactsSearched() const
  {
    return { contacts_.front(), contacts_.back() };
  }

  // the contacts that the curve allows at one extra value
  RootBracket contactsInside(double extra, double value)
  {
    return model_.contact
      ? RootBracket{ value, value }
      : inside([&](double contact) { return project(contact, extra).sumOfSquares; }, value,
          contactsSearched());
  }

  // the end of the scale's interval below (side -1) or above (1) among all contacts
  double scaleEnd(double extra, double side)
  {
    const Minimum lowest = best(extra);
    const RootBracket region = contactsInside(extra, lowest.at);
    const auto beyond = [&](double contact)
    {
      const Projection at = project(contact, extra);
      const double room = std::max(0.0, most_ - at.sumOfSquares);
      return -side * at.scale - (at.weight > 0.0 ? std::sqrt(room / at.weight) : 0.0);
    };
    const RootBracket known{ std::max(region.low, contacts_.front()),
      std::min(region.high, contacts_.back()) };
    if (!(known.high > known.low))
    {
      return -side * beyond(lowest.at);
    }
    const Minimum end =
      minimizeAmong(beyond, spread(known, kInside), 1e-6 * (known.high - known.low));
    // still falling at the last contact that was tried: nothing is known
    const auto isCut = [&](double reached, double limit)
    {
      const double near = limit + 0.01 * (lowest.at - limit);
      return std::isinf(reached) && (end.at < near) == (limit < near) &&
        std::abs(end.value - beyond(limit + 0.1 * (lowest.at - limit))) >
        1e-6 * std::abs(end.value);
    };
    return isCut(region.low, known.low) || isCut(region.high, known.high) ? side * kInfinity
                                                                          : -side * end.value;
  }

  // the same among all extra values
  double scaleEnd(const CurveFit& fit, double side)
  {
    if (!model_.searchesExtra())
    {
      return scaleEnd(fit.extra.value, side);
    }
    const RootBracket known{ std::max(fit.extra.low, model_.extra.low),
      std::min(fit.extra.high, model_.extra.high) };
    const auto beyond = [&](double extra) { return -side * scaleEnd(extra, side); };
    return -side *
      minimizeAmong(beyond, spread(known, kInside), 1e-4 * (known.high - known.low)).value;
  }

  void findIntervals(CurveFit& fit)
  {
    if (model_.searchesExtra())
    {
      fit.extra = extraInterval(fit.extra.value);
    }
    else
    {
      fit.extra.low = fit.extra.high = fit.extra.value;
    }
    const double lowest = scaleEnd(fit, -1.0);
    fit.scale.low = lowest > 0.0 ? lowest : -kInfinity; // none is below 0, whatever the curve
    fit.scale.high = scaleEnd(fit, 1.0);
    const auto [low, high] = contactInterval(fit);
    fit.contact = { fit.contact.value, low, high };
  }

  // from the first to the last value that the curve allows, whether or not all between are
  Estimate extraInterval(double value)
  {
    const auto profile = [this](double extra) { return best(extra).value; };
    RootBracket allowed{ value, value };
    for (const double extra : spread(model_.extra, kExtras))
    {
      const bool isOutside = extra < allowed.low || extra > allowed.high;
      if (isOutside && profile(extra) <= most_)
      {
        allowed = { std::min(allowed.low, extra), std::max(allowed.high, extra) };
      }
    }
    return { value, inside(profile, allowed.low, model_.extra).low,
      inside(profile, allowed.high, model_.extra).high };
  }

  RootBracket contactInterval(const CurveFit& fit)
  {
    if (model_.contact || !model_.searchesExtra())
    {
      return contactsInside(fit.extra.value, fit.contact.value);
    }
    const std::vector<double> grid = spread(
      { std::max(fit.extra.low, model_.extra.low), std::min(fit.extra.high, model_.extra.high) },
      kInside);
    const auto profile = [&](double contact)
    {
      const auto squares = [&](double extra) { return project(contact, extra).sumOfSquares; };
      return minimizeAmong(squares, grid, 1e-6 * (grid.back() - grid.front())).value;
    };
    return inside(profile, fit.contact.value, contactsSearched());
  }

  const Measured& measured_;
  const CurveModel& model_;
  Eigen::VectorXd shape_; // of the latest projection
  double first_ = 0.0;    // [m]
  double span_ = 0.0;     // of the depths [m]
  std::vector<double> contacts_;
  double most_ = 0.0; // sum of squares at the ends of the intervals
};

} // namespace

CurveFit fitForceCurve(const Measured& measured, const CurveModel& model)
{
  if (measured.depths.size() <= model.parameters())
  {
    throw Error(ErrorCode::BadValue,
      std::to_string(measured.depths.size()) + " rows for " + std::to_string(model.parameters()) +
        " unknowns; give more rows");
  }
  return Search(measured, model)();
}

} // namespace palp::fit
