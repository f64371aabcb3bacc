#include "haptics/force/relaxation/press_history.h"

#include "haptics/force/relaxation/relaxing_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

// steps between two points: the force is taken as linear in each, and what recovers, too
double stepsBetween(
  const PressPoint& from, const PressPoint& to, double shortest, const ContactRows& rows)
{
  constexpr double kDepths = 200.0;   // per depth that the rows are made for
  constexpr double kTimes = 50.0;     // per shortest time of the tissue
  constexpr double kMost = 100'000.0; // of a long rest
  const double deepest = rows.edges[ContactRows::kFine];
  const double moved =
    std::clamp(to.depth, -deepest, deepest) - std::clamp(from.depth, -deepest, deepest);
  return std::clamp(std::ceil(std::max(kDepths * std::abs(moved) / deepest,
                      kTimes * (to.time - from.time) / shortest)),
    1.0, kMost);
}

} // namespace

std::vector<double> forcesOver(
  const ContactRows& rows, const PronySeries& series, std::span<const PressPoint> history)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const PronyTerm& term : series.all())
  {
    shortest = std::min(shortest, term.time);
  }
  std::vector<double> forces;
  forces.reserve(history.size());
  RelaxingContact contact;
  PressPoint last = history.empty() ? PressPoint{} : history.front();
  for (const PressPoint& point : history)
  {
    const double steps = stepsBetween(last, point, shortest, rows);
    double force = 0.0;
    for (double step = 1.0; step <= steps; ++step)
    {
      const double depth =
        step < steps ? last.depth + step / steps * (point.depth - last.depth) : point.depth;
      contact.predict(series, (point.time - last.time) / steps);
      force = contact.at(rows, depth).force;
      contact.settle(rows, depth);
    }
    forces.push_back(force);
    last = point;
  }
  return forces;
}

} // namespace palp
