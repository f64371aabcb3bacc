#include "haptics/force/force_law.h"

#include "haptics/error.h"
#include "haptics/force/ellipse.h"
#include "haptics/force/inclination.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kMaxDepth = 1000.0_mm;  // deeper is answered as this, so that nothing overflows
constexpr double kMinThickness = 0.1_mm; // thinner bodies are answered as this
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Eqs. (2)-(4): F = 8 G sqrt(R) delta^(3/2) / (3 (1 - nu)), r = sqrt(R delta)
Response responseOf(const SphereTip& tip, const Material& m, double depth) noexcept
{
  const double stiffness =
    4.0 * m.shearModulus() / (1.0 - m.poissonRatio) * std::sqrt(tip.radius * depth);
  return { .force = 2.0 / 3.0 * stiffness * depth,
    .contactRadius = std::min(std::sqrt(tip.radius * depth), tip.radius),
    .stiffness = stiffness };
}

// Eq. (5): F = 4 G delta^2 / (pi (1 - nu) cot(alpha)), r = (2 / pi) delta tan(alpha)
Response responseOf(const ConeTip& tip, const Material& m, double depth) noexcept
{
  const double stiffness = 8.0 * m.shearModulus() * std::tan(tip.halfAngle) /
    (std::numbers::pi * (1.0 - m.poissonRatio)) * depth;
  return { .force = 0.5 * stiffness * depth,
    .contactRadius =
      std::min(2.0 / std::numbers::pi * depth * std::tan(tip.halfAngle), tip.baseRadius),
    .stiffness = stiffness };
}

// a place without values that are not finite, and without what is switched off
ContactGeometry sanitized(const ContactGeometry& local, const LawSettings& settings) noexcept
{
  ContactGeometry clean;
  clean.depth = std::min(local.depth, kMaxDepth);
  if (settings.mode != LawMode::Corrected)
  {
    return clean;
  }
  if (settings.inclination && std::isfinite(local.tilt))
  {
    clean.tilt = local.tilt;
  }
  if (settings.thickness && local.thickness > 0.0)
  {
    clean.thickness = std::max(local.thickness, kMinThickness);
  }
  if (settings.curvature && std::isfinite(local.surfaceCurvature))
  {
    clean.surfaceCurvature = local.surfaceCurvature;
  }
  if (settings.curvature && std::isfinite(local.curvatureSpread))
  {
    clean.curvatureSpread = std::abs(local.curvatureSpread);
  }
  return clean;
}

// fine down to the diameter of the tool
ContactRows makeRows(const ForceLaw& law)
{
  const auto elastic = [&](double depth)
  {
    const Response at = law({ .depth = depth });
    return ElasticForce{ at.force, at.stiffness };
  };
  return { elastic, std::min(2.0 * baseRadius(law.tip()), 0.5 * kMaxDepth) };
}

// 1 where there is too little to divide by
double ratio(double part, double whole) noexcept
{
  const double value = part / whole;
  return std::isfinite(value) ? value : 1.0;
}

// half-angle of what is a cone further up; a right angle for other tips [rad]
double flankOf(const Tip& tip) noexcept
{
  const auto* blunt = std::get_if<BluntConeTip>(&tip);
  const auto* truncated = std::get_if<TruncatedConeTip>(&tip);
  return blunt ? blunt->halfAngle : truncated ? truncated->halfAngle : 0.5 * std::numbers::pi;
}

} // namespace

struct ForceLaw::Corrections
{
  LayerContact layer;
  std::optional<LayerContact> coated;
  EllipseFactor ellipse;
  std::optional<ContactRows> rows; // of a law with memory
};

ForceLaw::ForceLaw(const Tip& tip, const Material& material, LawSettings settings)
  : tip_(checkedTip(tip))
  , material_(makeMaterial(material.youngModulus, material.poissonRatio))
  , settings_(std::move(settings))
  , halfSpace_(tip_)
{
  if (settings_.mode == LawMode::Corrected)
  {
    const auto corrections = std::make_shared<Corrections>(
      Corrections{ .layer = LayerContact(tip_, material_.poissonRatio, settings_.base),
        .coated = std::nullopt,
        .ellipse = EllipseFactor(),
        .rows = std::nullopt });
    if (!settings_.coatings.empty())
    {
      corrections->coated =
        corrections->layer.coated(settings_.coatings, material_, settings_.base);
      if (const double flat = flatRadius(tip_);
          flat > 0.0 && pullsUnderPunch(settings_.coatings, material_, settings_.base, flat))
      {
        throw Error(ErrorCode::BadValue,
          "coatings: under a flat end one as stiff as this bends away from the tool, which no law "
          "here knows; give a round tip or a softer coating");
      }
    }
    corrections_ = corrections;
    if (!settings_.relaxation.empty() || settings_.friction > 0.0)
    {
      corrections->rows = makeRows(*this);
    }
  }
}

const ContactRows* ForceLaw::rows() const noexcept
{
  return corrections_ != nullptr && corrections_->rows ? &*corrections_->rows : nullptr;
}

ForceLaw ForceLaw::corrected() const
{
  LawSettings all = settings_;
  all.mode = LawMode::Corrected;
  all.curvature = all.thickness = all.inclination = true;
  if (corrections_ == nullptr)
  {
    return { tip_, material_, all };
  }
  ForceLaw law = *this;
  law.settings_ = all;
  return law;
}

Response ForceLaw::operator()(const ContactGeometry& local) const noexcept
{
  // written so that NaN, too, means no contact
  if (!(local.depth > 0.0 && std::isfinite(local.depth)))
  {
    return {};
  }
  const ContactGeometry geometry = sanitized(local, settings_);
  if (settings_.mode == LawMode::Paper)
  {
    return paper(geometry.depth);
  }
  const LinearContact contact = linear(geometry);
  const LargeStrainGrid::Ratio ratio = largeStrain(geometry);
  const double modulus =
    material_.contactModulus() * ellipse(geometry) * tiltFactor(tip_, geometry.tilt);
  return { .force = modulus * contact.force * ratio.value,
    .contactRadius = contact.radius,
    .stiffness = modulus * (contact.stiffness * ratio.value + contact.force * ratio.slope) };
}

Response ForceLaw::paper(double depth) const noexcept
{
  if (const auto* sphere = std::get_if<SphereTip>(&tip_))
  {
    return responseOf(*sphere, material_, depth);
  }
  if (const auto* cone = std::get_if<ConeTip>(&tip_))
  {
    return responseOf(*cone, material_, depth);
  }
  const LinearContact contact = halfSpace_(depth);
  return { .force = material_.contactModulus() * contact.force,
    .contactRadius = contact.radius,
    .stiffness = material_.contactModulus() * contact.stiffness };
}

double ForceLaw::layerThickness(const ContactGeometry& local) const noexcept
{
  return corrections_->layer.layerThickness(local.thickness, local.surfaceCurvature);
}

LinearContact ForceLaw::linear(const ContactGeometry& local) const noexcept
{
  return corrections_ != nullptr && corrections_->coated
    ? (*corrections_->coated)(local.depth, layerThickness(local), local.surfaceCurvature)
    : uncoated(local);
}

LinearContact ForceLaw::uncoated(const ContactGeometry& local) const noexcept
{
  const bool plain = local.thickness == kInfinite && local.surfaceCurvature == 0.0;
  return plain || corrections_ == nullptr
    ? halfSpace_(local.depth)
    : corrections_->layer(local.depth, layerThickness(local), local.surfaceCurvature);
}

double ForceLaw::gapSpread(const ContactGeometry& local) const noexcept
{
  const bool round =
    std::holds_alternative<SphereTip>(tip_) || std::holds_alternative<ParaboloidTip>(tip_);
  const ContactGeometry geometry = sanitized(local, settings_);
  if (!round || geometry.curvatureSpread == 0.0 || corrections_ == nullptr)
  {
    return 0.0;
  }
  const double mean =
    1.0 / baseRadius(tip_) + corrections_->layer.allowedCurvature(geometry.surfaceCurvature);
  return geometry.curvatureSpread / mean;
}

double ForceLaw::ellipse(const ContactGeometry& local) const noexcept
{
  return corrections_ != nullptr ? corrections_->ellipse(gapSpread(local)) : 1.0;
}

LargeStrainGrid::Ratio ForceLaw::largeStrain(const ContactGeometry& local) const noexcept
{
  if (settings_.mode != LawMode::Corrected || settings_.constitution == ConstitutiveModel::Linear ||
    settings_.largeStrain == nullptr || !settings_.coatings.empty() || !(local.depth > 0.0))
  {
    return {};
  }
  const ContactGeometry geometry = sanitized(local, settings_);
  const LargeStrain& table = *settings_.largeStrain;
  const double nu = material_.poissonRatio;
  if (const auto* sphere = std::get_if<SphereTip>(&tip_))
  {
    auto ratio =
      table.sphere(geometry.depth / sphere->radius, sphere->radius / geometry.thickness, nu);
    ratio.slope /= sphere->radius;
    return ratio;
  }
  if (const auto* cone = std::get_if<ConeTip>(&tip_);
      cone && table.cone.covers(cone->halfAngle, nu))
  {
    auto ratio = table.cone(geometry.depth / geometry.thickness, cone->halfAngle, nu);
    ratio.slope /= geometry.thickness;
    return ratio;
  }
  return largeStrainByRadius(geometry);
}

LargeStrainGrid::Ratio ForceLaw::largeStrainByRadius(const ContactGeometry& local) const noexcept
{
  constexpr double kStep = 1e-4;       // [-] of the depth
  constexpr double kShallowest = 1e-9; // [m] so that no quotient loses its value
  constexpr double kFlatPoisson = 0.3;
  constexpr double kSteepest = units::fromDegrees(44.9); // of the flanks that were compared
  constexpr double kSteepStrain = 0.8;                   // to which the others are as those
  const double depth = std::max(local.depth, kShallowest);
  const auto radiusAt = [&](double deep)
  {
    ContactGeometry there = local;
    there.depth = deep;
    return uncoated(there).radius;
  };
  const double nu = material_.poissonRatio;
  const auto at = [&](double deep)
  { return largeStrainOf(deep, radiusAt(deep), local.thickness, nu); };
  // elements under a flat punch follow its edge, more so the less the volume can change
  const bool isFlat = std::holds_alternative<PunchTip>(tip_) && nu > kFlatPoisson;
  const bool isSteep = flankOf(tip_) < kSteepest && depth > kSteepStrain * radiusAt(depth);
  const double value = at(depth);
  return { .value = value,
    .slope = (at((1.0 + kStep) * depth) - value) / (kStep * depth),
    .inside =
      !isFlat && !isSteep && isLargeStrainKnown(depth, radiusAt(depth), local.thickness, nu) };
}

void ForceLaw::checkBody(double thickness) const
{
  constexpr double rounding = 1.0 - 1e-6;
  const bool acts = settings_.mode == LawMode::Corrected && settings_.thickness;
  if (acts && !settings_.coatings.empty() && settings_.coatings.thickness() >= rounding * thickness)
  {
    throw Error(ErrorCode::BadValue,
      "coatings: of " + units::inMillimeters(settings_.coatings.thickness()) +
        " in all nothing is left below them of a body of " + units::inMillimeters(thickness) +
        ", whose thickness counts theirs; give thinner ones");
  }
}

Factors ForceLaw::factors(const ContactGeometry& local) const noexcept
{
  Factors result{ { { "shape", 1.0 }, { "curvature", 1.0 }, { "ellipse", 1.0 },
    { "thickness", 1.0 }, { "large_strain", 1.0 }, { "inclination", 1.0 }, { "coatings", 1.0 } } };
  if (settings_.mode == LawMode::Paper || !(local.depth > 0.0 && std::isfinite(local.depth)))
  {
    return result;
  }
  const ContactGeometry geometry = sanitized(local, settings_);
  ContactGeometry flat = geometry; // without what acts later
  flat.thickness = kInfinite;
  const double curved = uncoated(flat).force;
  flat.surfaceCurvature = 0.0;
  const double plain = uncoated(flat).force;
  const double layered = uncoated(geometry).force;
  result[0].value = ratio(material_.contactModulus() * plain, paper(geometry.depth).force);
  result[1].value = ratio(curved, plain);
  result[2].value = ellipse(geometry);
  result[3].value = ratio(layered, curved);
  result[4].value = largeStrain(geometry).value;
  result[5].value = tiltFactor(tip_, geometry.tilt);
  result[6].value = ratio(linear(geometry).force, layered);
  return result;
}

} // namespace palp
