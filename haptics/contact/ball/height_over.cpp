#include "haptics/contact/ball/height_over.h"

#include "haptics/contact/ball/lens.h"
#include "haptics/numerics/leveled.h"
#include "haptics/numerics/roots.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kSmallest = 1e-3;   // [-] of Q: a smaller contact leaves nothing of the digits
constexpr double kSmall = 4e-3;      // [-] from which on all of the moment counts
constexpr double kFarthest = 0.9999; // [-] of the ball's radius
constexpr double kSteepest = 0.2;    // [-] of what a plane's moment loses
constexpr double kFastest = 2.0;     // [-] by which a height changes as the ball moves
constexpr double kClose = 1e-11;     // [m]

// Q beyond that of the patch at which, by its orders, no volume of it is left [m^2]
double leastMore(const Patch& patch, double ball) noexcept
{
  const double first = 0.5 * ball * patch.solidAngle;
  const double second = 0.25 * patch.solidAngle / ball + 0.5 * ball * patch.solidAngleSlope;
  const double square = first * first - 2.0 * second * patch.volume;
  return patch.volume > 0.0 && first > 0.0 && square > 0.0
    ? -2.0 * patch.volume / (first + std::sqrt(square))
    : -std::numeric_limits<double>::infinity();
}

} // namespace

HeightOver::HeightOver(
  const Patch& patch, const BallRule& rule, double nearest, const BallSize& given) noexcept
  : patch_(&patch)
  , rule_(&rule)
  , nearest_(nearest)
  , smoothing_(given.smoothing.value)
  , given_(given.squared.value)
  , ball_(std::sqrt(given_))
  , ballSlope_(0.5 * given.squared.slope / ball_ * patch.normal.normalized())
  , leastMore_(leastMore(patch, ball_))
  , part_(smoothStep((1.0 - nearest * nearest / given_ - kSmallest) / (kSmall - kSmallest)))
  , moment_(std::clamp(patch.moment, 0.0, 8.0 * std::numbers::pi / 15.0 * given_ * given_ * ball_))
{
}

double HeightOver::Excess::byHeight(double fallThere) const noexcept
{
  return std::max(growth * byQ + fallThere, kSteepest * fallThere);
}

HeightOver::Excess HeightOver::excessAt(double height, double curvature) const noexcept
{
  const auto [own, growth] = (*rule_)(height).squared;
  const double more = std::max(own - given_, leastMore_); // a smaller ball has nothing less
  const Lens body = lensOf(given_, height, curvature);
  const double volume = patch_->volume - body.volume;
  const double angle = patch_->solidAngle - body.solidAngle;
  const double second = 0.5 * ball_ * angle;
  const double third =
    0.25 * angle / ball_ + 0.5 * ball_ * (patch_->solidAngleSlope - body.solidAngleSlope);
  const double square = height * height;
  const double larger = std::max(0.0, given_ + more - square) / (given_ - square);
  return { .value =
             moment_ - body.moment + more * (volume + more * (0.5 * second + more * third / 6.0)),
    .byQ = volume + more * (second + 0.5 * more * third),
    .fall = -body.heightSlope * larger * larger,
    .growth = more > leastMore_ ? growth : 0.0,
    .more = more };
}

Height HeightOver::operator()(
  double start, double curvature, const Eigen::Vector3d& curvatureSlope) const noexcept
{
  const Eigen::Vector3d normal = patch_->normal.normalized();
  if (part_ == 0.0)
  {
    return { nearest_, normal };
  }
  const Leveled bent = leveled(curvature, ball_);
  const RootBracket bracket{ std::max(
                               nearest_ - smoothing_, -kFarthest * ball_), // the mesh has less
    std::min(nearest_ + smoothing_, kFarthest * ball_) };                  // it has more
  Excess excess{};
  const auto over = [&](double place)
  {
    excess = excessAt(place, bent.value);
    return std::array{ excess.value, excess.byHeight(excess.fall) };
  };
  const double height =
    boundedNewton(std::clamp(start, bracket.low, bracket.high), bracket, kClose, over);
  const double more = excess.more;
  const Lens own = lensOf(given_ + more, height, bent.value);
  const Eigen::Vector3d change = patch_->normal + patch_->fading +
    more * (patch_->area + patch_->volumeFading + 0.5 * more * patch_->rim) +
    own.curvatureSlope * (bent.slope * curvatureSlope + bent.bySize * ballSlope_);
  // where the ball all but misses the body, or all but fills with it, no slope follows from a
  // moment
  const Eigen::Vector3d slope =
    change / std::max(excess.byHeight(-own.heightSlope), change.norm() / kFastest);
  return { nearest_ + part_ * (height - nearest_), normal + part_ * (slope - normal) };
}

} // namespace palp
