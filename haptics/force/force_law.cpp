#include "haptics/force/force_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// Eqs. (2)-(4): F = 8 G sqrt(R) delta^(3/2) / (3 (1 - nu)), r = sqrt(R delta)
Response respond(const SphereTip& tip, const Material& m, double depth) noexcept
{
  const double stiffness =
    4.0 * m.shearModulus() / (1.0 - m.poissonRatio) * std::sqrt(tip.radius * depth);
  return { .force = 2.0 / 3.0 * stiffness * depth,
    .contactRadius = std::min(std::sqrt(tip.radius * depth), tip.radius),
    .stiffness = stiffness };
}

// Eq. (5): F = 4 G delta^2 / (pi (1 - nu) cot(alpha)), r = (2 / pi) delta tan(alpha)
Response respond(const ConeTip& tip, const Material& m, double depth) noexcept
{
  const double stiffness = 8.0 * m.shearModulus() * std::tan(tip.halfAngle) /
    (std::numbers::pi * (1.0 - m.poissonRatio)) * depth;
  return { .force = 0.5 * stiffness * depth,
    .contactRadius =
      std::min(2.0 / std::numbers::pi * depth * std::tan(tip.halfAngle), tip.baseRadius),
    .stiffness = stiffness };
}

} // namespace

ForceLaw::ForceLaw(const Tip& tip, const Material& material, LawSettings settings)
  : tip_(checkedTip(tip))
  , material_(makeMaterial(material.youngModulus, material.poissonRatio))
  , settings_(std::move(settings))
  , halfSpace_(tip_)
{
}

Response ForceLaw::operator()(const Indentation& local) const noexcept
{
  // written so that NaN, too, means no contact
  if (!(local.depth > 0.0 && std::isfinite(local.depth)))
  {
    return {};
  }
  if (settings_.mode == LawMode::Paper)
  {
    if (const auto* sphere = std::get_if<SphereTip>(&tip_))
    {
      return respond(*sphere, material_, local.depth);
    }
    if (const auto* cone = std::get_if<ConeTip>(&tip_))
    {
      return respond(*cone, material_, local.depth);
    }
  }
  const double modulus = material_.contactModulus();
  const HalfSpaceContact contact = halfSpace_(local.depth);
  return { .force = modulus * contact.force,
    .contactRadius = contact.radius,
    .stiffness = 2.0 * modulus * contact.radius };
}

} // namespace palp
