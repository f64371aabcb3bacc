#include "haptics/force/nodules/homogeneous_press.h"

#include "haptics/error.h"
#include "haptics/force/linear/contact_depth.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/force/nodules/punch_strain.h"
#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/quadrature.h"
#include "haptics/numerics/roots.h"
#include "haptics/numerics/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr double kMostPoisson = 0.4995; // so that the bulk modulus is finite
constexpr double kPoint = 1e-6;         // of the base radius: a contact that counts as a point
constexpr int kSubsteps = 16;           // of an interval, for the radii in between
constexpr double kFading = 2.2;         // r / thickness from where a layer's strain fades to 0

// Contact of a tool, with the depth at which a half-space has the same radius of contact.
class Contacts
{
public:
  Contacts(const ForceLaw& law, const LayerContact& layer, double thickness, double curvature)
    : tip_(law.tip())
    , layer_(layer)
    , thickness_(thickness)
    , curvature_(curvature)
    , base_((1.0 - kAtBase) * baseRadius(tip_))
  {
    // the depth at which the whole base touches; never, where that is deeper than any press
    const RootBracket found = bisect(
      [this](double depth) { return at(depth).radius < base_; }, { 0.0, kNeverDeep }, kHalvings);
    baseDepth_ = found.high;
  }

  [[nodiscard]] LinearContact at(double depth) const noexcept
  {
    return depth > 0.0 ? layer_(depth, thickness_, curvature_) : LinearContact{};
  }

  [[nodiscard]] double halfSpaceDepth(double depth, double radius) const noexcept
  {
    const double a = std::min(radius, base_);
    return contactDepth(tip_, a) + layer_.allowedCurvature(curvature_) * a * a +
      std::max(0.0, depth - baseDepth_);
  }

private:
  static constexpr double kAtBase = 1e-7;   // [-]
  static constexpr double kNeverDeep = 1.0; // [m]
  static constexpr int kHalvings = 50;

  Tip tip_;
  const LayerContact& layer_;
  double thickness_; // [m]
  double curvature_; // [1/m]
  double base_;      // radius that counts as that of the base [m]
  double baseDepth_; // [m]
};

// Lagrange's polynomials through 0, 1/2 and 1
std::array<double, 3> parabolas(double t) noexcept
{
  return { (2.0 * t - 1.0) * (t - 1.0), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0) };
}

// what the law answers at a depth of a place
Response responseAt(const ForceLaw& law, ContactGeometry place, double depth) noexcept
{
  place.depth = depth;
  return law(place);
}

} // namespace

HomogeneousPress::HomogeneousPress(
  const ForceLaw& law, const ContactGeometry& place, double deepest)
  : law_(law)
  , poisson_(std::min(law.material().poissonRatio, kMostPoisson))
  , axis_{ 0.0, std::sqrt(deepest) / kInUse, kIntervals }
  , knots_(kIntervals + 1)
{
  if (law.settings().mode != LawMode::Corrected || !law.settings().coatings.empty())
  {
    throw Error(ErrorCode::BadValue,
      "nodules and maps of stiffness: only the corrected law, and tissue without coatings, knows "
      "them; choose that law, or leave them out");
  }
  findContacts(place);
  findForces(place);
  if (std::isfinite(thickness_))
  {
    image_ = std::make_shared<const LayerImage>(poisson_, law.settings().base);
  }
}

void HomogeneousPress::findContacts(const ContactGeometry& place)
{
  const LayerContact layer(law_.tip(), law_.material().poissonRatio, law_.settings().base);
  const double curvature = law_.settings().curvature ? place.surfaceCurvature : 0.0;
  thickness_ = law_.settings().thickness ? layer.layerThickness(place.thickness, curvature)
                                         : std::numeric_limits<double>::infinity();
  const Contacts contacts(law_, layer, thickness_, curvature);
  const double softness = 1.0 - poisson_ * poisson_; // E / E*
  const double least = std::max(flatRadius(law_.tip()), kPoint * baseRadius(law_.tip()));

  radii_.assign(1, least);
  sums_.assign(1, 0.0);
  knots_.front().radius = least;
  double depthBefore = 0.0;
  double radiusBefore = least;
  for (int i = 0; i < kIntervals; ++i)
  {
    Growth growth{};
    for (int k = 1; k <= kSubsteps; ++k)
    {
      const double fraction = static_cast<double>(k) / kSubsteps;
      const double root = (i + fraction) * axis_.step();
      const double depth = root * root;
      const double radius = std::max(least, contacts.at(depth).radius);
      const double reached = std::max(depthBefore, contacts.halfSpaceDepth(depth, radius));
      const auto parts = parabolas(fraction - 0.5 / kSubsteps);
      for (std::size_t j = 0; j < parts.size(); ++j)
      {
        growth[j] += parts[j] * 0.5 * (radius + radiusBefore) * (reached - depthBefore);
      }
      depthBefore = reached;
      radiusBefore = radius;
      if (2 * k == kSubsteps || k == kSubsteps)
      {
        radii_.push_back(radius);
      }
    }
    growths_.push_back(growth);
    sums_.push_back(sums_.back() + growth[0] + growth[1] + growth[2]);
    Knot& knot = knots_[static_cast<std::size_t>(i) + 1];
    const double root = (i + 1) * axis_.step();
    knot.depth = root * root;
    knot.radius = radiusBefore;
    knot.stiffness = contacts.at(knot.depth).stiffness / softness;
  }
  knots_.front().stiffness = 2.0 * flatRadius(law_.tip()) / softness;
}

void HomogeneousPress::findForces(const ContactGeometry& place)
{
  for (int i = 0; i < kIntervals; ++i)
  {
    const Quadrature points = gaussLegendre(kForces, i * axis_.step(), (i + 1) * axis_.step());
    for (std::size_t k = 0; k < kForces; ++k)
    {
      const double root = points.nodes[k];
      forces_.push_back(
        points.weights[k] * 2.0 * root * responseAt(law_, place, root * root).force);
    }
  }
  const std::vector<double> energies = weightedEnergies(std::vector(knots_.size(), 1.0));
  for (std::size_t i = 0; i < knots_.size(); ++i)
  {
    knots_[i].force = responseAt(law_, place, knots_[i].depth).force;
    knots_[i].energy = energies[i];
  }
}

std::vector<double> HomogeneousPress::weightedEnergies(std::span<const double> values) const
{
  std::vector<double> roots;
  for (std::size_t i = 0; i < knots_.size(); ++i)
  {
    roots.push_back(static_cast<double>(i) * axis_.step());
  }
  const std::vector<double> slopes = polynomialSlopes(roots, values);
  const Quadrature points = gaussLegendre(kForces, 0.0, 1.0);
  std::vector<double> sums(1, 0.0);
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
  {
    double sum = sums.back();
    for (std::size_t k = 0; k < kForces; ++k)
    {
      sum += forces_[i * kForces + k] *
        hermite(points.nodes[k], axis_.step(), values[i], values[i + 1], slopes[i], slopes[i + 1])
          .value;
    }
    sums.push_back(sum);
  }
  return sums;
}

void HomogeneousPress::strainAt(double r, double z, std::span<PressStrain> each) const noexcept
{
  // for E = 1, a half-space answers a punch by 2 a / (1 - nu^2)
  const double perPunch = 0.5 * (1.0 - poisson_ * poisson_);
  Strain added{};
  double fade = 1.0;
  if (image_ != nullptr)
  {
    const double across = r / thickness_;
    added = (1.0 / (thickness_ * thickness_)) * (*image_)(across, z / thickness_);
    fade = 1.0 - smoothStep((across - kFading) / (LayerImage::kReach - kFading));
  }
  const auto punch = [&](std::size_t node) { return punchStrain(radii_[node], r, z, poisson_); };
  Strain last = punch(0);
  Strain sum{};
  each[0].rate = each[0].total = fade * (perPunch * last + added);
  for (std::size_t i = 0; i < growths_.size(); ++i)
  {
    const Strain next = punch(2 * i + 2);
    const Growth& growth = growths_[i];
    sum = sum + growth[0] * last + growth[1] * punch(2 * i + 1) + growth[2] * next;
    each[i + 1].total = fade * (perPunch / sums_[i + 1] * sum + added);
    each[i + 1].rate = fade * (perPunch * next + added);
    last = next;
  }
}

} // namespace palp
