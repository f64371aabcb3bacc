#include "calibration/indenter.h"

#include <algorithm>
#include <cmath>

// what can be read from a pressed body

namespace palp::fem
{

double Indenter::radiusOf(int node) const
{
  const int horizontal = body_.dimension - 1;
  return (body_.positions.col(node).head(horizontal) +
    displacement_.segment(body_.dimension * node, horizontal))
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

Indented Indenter::state() const
{
  const int d = body_.dimension;
  Indented out{
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
    const Eigen::VectorXd moved = at + displacement_.segment(d * node, d - 1);
    out.profile.push_back({ at.norm(), moved.norm() - at.norm(), displacement_[d * node + d - 1] });
  }
  return out;
}

} // namespace palp::fem
