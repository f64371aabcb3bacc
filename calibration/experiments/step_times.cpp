#include "calibration/baselines/stepper.h"
#include "haptics/error.h"
#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <chrono>

// many steps of a stepper

namespace palp::fem
{

StepTimes timeSteps(Stepper& stepper, std::span<const Eigen::Vector3d> apexes, double dt)
{
  if (apexes.empty())
  {
    throw Error(ErrorCode::BadValue, "steps: the path of the tool is empty");
  }
  StepTimes times;
  times.milliseconds.reserve(apexes.size());
  for (const Eigen::Vector3d& apex : apexes)
  {
    const auto begin = std::chrono::steady_clock::now();
    stepper.placeTool(apex);
    times.outcomes.push_back(stepper.step(dt));
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    times.milliseconds.push_back(time.count());
    times.iterations += times.outcomes.back().iterations;
  }
  const auto count = static_cast<double>(apexes.size());
  times.iterations /= count;
  const Statistics spread = statisticsOf(times.milliseconds);
  times.mean = spread.mean;
  times.deviation = spread.deviation;
  times.median = spread.median;
  return times;
}

std::vector<Eigen::Vector3d> pressPath(double depth, double speed, double hold, double dt)
{
  if (!(depth > 0.0 && speed > 0.0 && hold >= 0.0 && dt > 0.0))
  {
    throw Error(
      ErrorCode::BadValue, "press: depth, speed and time step must be more than 0, hold 0 or more");
  }
  std::vector<Eigen::Vector3d> apexes;
  const double end = depth / speed + hold;
  for (double t = dt; t < end + 0.5 * dt; t += dt)
  {
    apexes.emplace_back(0.0, 0.0, -std::min(depth, speed * t));
  }
  return apexes;
}

StepOutcome settle(Stepper& stepper, double dt, double change, int mostSteps)
{
  constexpr int kStill = 5; // steps in a row
  double before = 0.0;
  for (int k = 0, still = 0; k < mostSteps; ++k)
  {
    const StepOutcome now = stepper.step(dt);
    const double moved =
      std::max(std::abs(now.force - before), std::abs(now.force - now.baseReaction));
    still = moved <= change * std::abs(now.force) ? still + 1 : 0;
    if (still == kStill)
    {
      return now;
    }
    before = now.force;
  }
  throw Error(ErrorCode::NoSolution,
    "the force did not settle in " + std::to_string(mostSteps) +
      " steps; allow more steps, longer ones, or more iterations");
}

} // namespace palp::fem
