#include "calibration/study/outcome.h"

namespace palp::fem
{

double extentRadius(const std::vector<IndentationStep::Point>& profile, double threshold)
{
  for (std::size_t i = 0; i < profile.size(); ++i)
  {
    const double sunk = -profile[i].uz;
    if (sunk > threshold * (1.0 + 1e-9))
    {
      continue;
    }
    if (i == 0)
    {
      return 0.0;
    }
    const double before = -profile[i - 1].uz;
    const double inner = profile[i - 1].radius + profile[i - 1].ur;
    const double outer = profile[i].radius + profile[i].ur;
    return inner + (before - threshold) / (before - sunk) * (outer - inner);
  }
  return profile.empty() ? 0.0 : profile.back().radius + profile.back().ur;
}

double sinkOf(const IndentationStep& pressed, double radius)
{
  const auto& profile = pressed.profile;
  for (std::size_t i = 1; i < profile.size(); ++i)
  {
    const double outer = profile[i].radius + profile[i].ur;
    if (radius <= outer)
    {
      const double inner = profile[i - 1].radius + profile[i - 1].ur;
      const double t = (radius - inner) / (outer - inner);
      return -(1.0 - t) * profile[i - 1].uz - t * profile[i].uz;
    }
  }
  return -profile.back().uz;
}

} // namespace palp::fem
