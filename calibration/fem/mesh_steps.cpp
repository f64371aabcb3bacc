#include "calibration/fem/mesh_steps.h"

#include <algorithm>
#include <cmath>

namespace palp::fem
{
namespace
{

constexpr double kRefinedGrowth = 1.2; // towards a refined place

// steps from 0 to length that grow from the first to the largest; an overshoot squeezes them
std::vector<double> cappedSteps(double length, double first, double largest)
{
  std::vector<double> steps{ 0.0 };
  for (double step = first; steps.back() < length * (1.0 - 1e-9); step *= kRefinedGrowth)
  {
    steps.push_back(steps.back() + std::min(step, largest));
  }
  for (double& step : steps)
  {
    step *= length / steps.back();
  }
  return steps;
}

} // namespace

std::vector<double> gradedSteps(double length, double fineLength, double fine, double growth)
{
  const int uniform = std::max(1, static_cast<int>(std::ceil(std::min(fineLength, length) / fine)));
  std::vector<double> steps{ 0.0 };
  for (int i = 1; i <= uniform; ++i)
  {
    steps.push_back(i * fine);
  }
  for (double step = growth * fine; steps.back() < length; step *= growth)
  {
    steps.push_back(steps.back() + step);
  }
  // the last step may overshoot: squeeze the growing part, or everything if nothing grows
  const auto from = steps.back() > uniform * fine ? static_cast<std::size_t>(uniform) : 0;
  const double scale = (length - steps[from]) / (steps.back() - steps[from]);
  for (std::size_t i = from + 1; i < steps.size(); ++i)
  {
    steps[i] = steps[from] + scale * (steps[i] - steps[from]);
  }
  return steps;
}

std::vector<double> refinedSteps(
  double radius, double fineRadius, double fine, const Refinement& refinement)
{
  std::vector<double> steps;
  if (refinement.radius > 0.0)
  {
    for (const double inwards : cappedSteps(refinement.radius, refinement.size, fine))
    {
      steps.insert(steps.begin(), refinement.radius - inwards);
    }
    steps.pop_back();
  }
  for (const double outwards : cappedSteps(fineRadius - refinement.radius, refinement.size, fine))
  {
    steps.push_back(refinement.radius + outwards);
  }
  const double last = steps.back() - steps[steps.size() - 2];
  for (const double beyond :
    gradedSteps(radius - fineRadius, 0.0, kOutwardGrowth * last, kOutwardGrowth))
  {
    if (beyond > 0.0)
    {
      steps.push_back(fineRadius + beyond);
    }
  }
  return steps;
}

std::vector<double> sheetBounds(double height, const Coatings& coatings)
{
  std::vector<double> bounds{ 0.0 };
  for (const Coating& coating : coatings.all())
  {
    bounds.push_back(bounds.back() + coating.thickness);
  }
  bounds.push_back(height);
  return bounds;
}

std::vector<double> sheetSteps(const std::vector<double>& bounds, double fine, double growth)
{
  std::vector<double> steps{ 0.0 };
  double first = fine;
  for (std::size_t i = 1; i < bounds.size(); ++i)
  {
    const double thickness = bounds[i] - bounds[i - 1];
    for (const double step : gradedSteps(thickness, 0.0, std::min(first, 0.5 * thickness), growth))
    {
      if (step > 0.0)
      {
        steps.push_back(bounds[i - 1] + step);
      }
    }
    steps.back() = bounds[i];
    first = std::max(fine, bounds[i] - steps[steps.size() - 2]);
  }
  return steps;
}

std::vector<double> stepsThrough(std::vector<double> steps, double there)
{
  const auto nearest = std::min_element(steps.begin() + 1, steps.end() - 1,
    [there](double a, double b) { return std::abs(a - there) < std::abs(b - there); });
  const double before = *nearest;
  const double end = steps.back();
  for (double& step : steps)
  {
    step =
      step <= before ? step * there / before : end - (end - step) * (end - there) / (end - before);
  }
  return steps;
}

} // namespace palp::fem
