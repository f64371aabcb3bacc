#include "calibration/fem/indenter.h"

#include "haptics/units.h"

#include <algorithm>
#include <cmath>

// what can be read from a pressed body

namespace palp::fem
{
namespace
{

constexpr double kHanging = 1e-3; // gap to depth, or pull to force, under the tool [-]

} // namespace

double Indenter::radiusOf(int node) const
{
  const int horizontal = body_.dimension - 1;
  return (body_.positions.col(node).head(horizontal) +
    displacement_.segment(body_.dofOf(node), horizontal))
    .norm();
}

// the edge lies between the last node that touches and the next: outside a contact of radius a the
// gap opens as (r - a)^(3/2), and two gaps tell a
double Indenter::contactRadius() const
{
  double last = 0.0;
  for (std::size_t i = 0; i < touching_.size(); ++i)
  {
    last = touching_[i] != 0 ? std::max(last, radiusOf(body_.surface[i])) : last;
  }
  const auto outside = std::find_if(
    body_.profile.begin(), body_.profile.end(), [&](int node) { return radiusOf(node) > last; });
  if (last == 0.0 || body_.profile.end() - outside < 2)
  {
    return last;
  }
  const auto opening = [this](int node)
  { return std::pow(std::max(0.0, toolAt(node).height - heightOf(node)), 2.0 / 3.0); };
  const double near = opening(outside[0]);
  const double far = opening(outside[1]);
  if (!toolAt(outside[1]).below || far <= near)
  {
    return last;
  }
  const double r = radiusOf(outside[0]);
  return std::clamp(r - (radiusOf(outside[1]) - r) * near / (far - near), last, r);
}

// small-strain theory knows the undeformed surface only, which never folds
std::string Indenter::surfaceFault() const
{
  const int d = body_.dimension;
  const auto at = [](double radius)
  { return " at " + units::inMillimeters(radius) + " from the axis"; };
  const auto& line = body_.profile;
  for (std::size_t i = 1; energy_ != StrainEnergy::Linear && i < line.size(); ++i)
  {
    if (!(radiusOf(line[i]) > radiusOf(line[i - 1])))
    {
      return "the surface folds over" + at(radiusOf(line[i]));
    }
  }

  const auto restRadius = [&](int node) { return body_.positions.col(node).head(d - 1).norm(); };
  double edge = 0.0;
  for (std::size_t i = 0; i < touching_.size(); ++i)
  {
    edge = touching_[i] != 0 ? std::max(edge, restRadius(body_.surface[i])) : edge;
  }
  double press = 0.0;
  for (std::size_t i = 0; i < touching_.size(); ++i)
  {
    const int node = body_.surface[i];
    press -= touching_[i] != 0 ? equilibrium_.forces()[d * node + d - 1] : 0.0;
    const bool enclosed = restRadius(node) < edge - (d == 2 ? 0.0 : body_.elementSize);
    const double gap = toolAt(node).height - heightOf(node);
    if (enclosed && touching_[i] == 0 && gap > kHanging * depth_)
    {
      return "the surface hangs " + units::inMillimeters(gap) + " below the tool" +
        at(radiusOf(node));
    }
    // the first node alone, on the axis, bears nothing under an even pressure
    if (d == 2 && i > 1 && press < -kHanging * force_)
    {
      return "the tool would have to pull the surface" + at(radiusOf(node));
    }
  }
  return {};
}

IndentationStep Indenter::state() const
{
  const int d = body_.dimension;
  IndentationStep out{
    .depth = depth_, .contactRadius = contactRadius(), .inverted = equilibrium_.invertedElements()
  };
  for (std::size_t i = 0; i < touching_.size(); ++i)
  {
    const int node = body_.surface[i];
    const ToolPoint tool = toolAt(node);
    out.force -= touching_[i] != 0 ? equilibrium_.forces()[d * node + d - 1] : 0.0;
    out.penetration = std::max(out.penetration, tool.below ? heightOf(node) - tool.height : 0.0);
  }
  for (const int node : body_.base)
  {
    out.baseReaction += equilibrium_.forces()[d * node + d - 1];
  }
  for (const int node : body_.profile)
  {
    const Eigen::VectorXd at = body_.positions.col(node).head(d - 1);
    const Eigen::VectorXd moved = at + displacement_.segment(body_.dofOf(node), d - 1);
    out.profile.push_back({ at.norm(), moved.norm() - at.norm(), displacement_[d * node + d - 1] });
  }
  return out;
}

} // namespace palp::fem
