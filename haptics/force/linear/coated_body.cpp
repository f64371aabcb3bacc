#include "haptics/force/linear/coated_body.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace palp
{
namespace
{

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1.0 + 1e-9;
constexpr double kNarrowest = 1.0 / CoatedBody::kMinBodyThickness;

// Two states at one height, as columns: displacement (along, down) and traction over 2 k and a
// common shear modulus (along, down). Every state there is a sum of the two.
struct States
{
  Matrix2d displacement;
  Matrix2d traction;
};

// the solutions that fade with the depth, at a depth of kz: (A + B (kz - kappa), A + B kz) exp(-kz)
States fading(double kz, double nu, double modulus)
{
  States states;
  states.displacement << 1.0, kz - (3.0 - 4.0 * nu), 1.0, kz;
  states.traction << -modulus, modulus * (2.0 - 2.0 * nu - kz), -modulus,
    modulus * (1.0 - 2.0 * nu - kz);
  return states;
}

// those that fade with the height above some plane, as if seen from below
States rising(double kz, double nu, double modulus)
{
  States states = fading(kz, nu, modulus);
  states.displacement.row(1) *= -1.0;
  states.traction.row(0) *= -1.0;
  return states;
}

// what a base allows
States held(Base base)
{
  States states{ Matrix2d::Zero(), Matrix2d::Identity() };
  if (base == Base::Slip)
  {
    states.displacement(0, 0) = 1.0;
    states.traction(0, 0) = 0.0;
  }
  return states;
}

// the states that a sheet has at its top, above those below; scaled by exp(-k h) on the way, so
// that nothing overflows
States onTop(const States& below, double kh, double nu, double modulus)
{
  const States down = fading(kh, nu, modulus);
  const States up = rising(0.0, nu, modulus);
  const double fade = std::exp(-kh);
  Matrix4d join;
  join << up.displacement, -below.displacement, up.traction, -below.traction;
  Eigen::Matrix<double, 4, 2> from;
  from << down.displacement, down.traction;
  const Matrix2d returned = -fade * join.partialPivLu().solve(from).topRows<2>();
  const States start = fading(0.0, nu, modulus);
  const States end = rising(kh, nu, modulus);
  return { start.displacement + fade * end.displacement * returned,
    start.traction + fade * end.traction * returned };
}

// Gauss points in k over the range in which the compliance is not yet that of a half-space: by
// octaves, as sheets of all thicknesses show, and dense enough for the
// cosines of the widest contact
Quadrature wavenumbers(double uppermost, double widest)
{
  constexpr double deepest = 20.0; // 1 - L falls as exp(-2 k h), to 1e-15 here
  constexpr int octaves = 16;
  constexpr int points = 12;
  constexpr double turn = 8.0; // of the cosines' argument over as many points
  Quadrature all;
  double high = deepest / uppermost;
  for (int i = 0; i <= octaves; ++i)
  {
    const double low = i == octaves ? 0.0 : 0.5 * high;
    const int parts = std::max(1, static_cast<int>(std::ceil((high - low) * widest / turn)));
    for (int part = 0; part < parts; ++part)
    {
      const double width = (high - low) / parts;
      const Quadrature rule = gaussLegendre(points, low + part * width, low + (part + 1) * width);
      all.nodes.insert(all.nodes.end(), rule.nodes.begin(), rule.nodes.end());
      all.weights.insert(all.weights.end(), rule.weights.begin(), rule.weights.end());
    }
    high = low;
  }
  return all;
}

void add(PunchSolution& sum, double weight, const PunchSolution& part) noexcept
{
  for (std::size_t k = 0; k < PunchSolution::kTerms; ++k)
  {
    sum.value[k] += weight * part.value[k];
    sum.slope[k] += weight * part.slope[k];
  }
}

void check(const Coatings& coatings, const Material& body, double widest)
{
  const auto all = coatings.all();
  if (all.front().thickness < CoatedBody::kMinThickness * widest)
  {
    throw Error(ErrorCode::BadValue,
      "coatings: " + units::inMillimeters(all.front().thickness) +
        " are too thin under this tool to be computed; give " +
        units::inMillimeters(CoatedBody::kMinThickness * widest) + " or more, or leave it out");
  }
  double softest = body.contactModulus(); // of what is below
  for (std::size_t i = all.size(); i-- > 0;)
  {
    const double modulus = all[i].material.contactModulus();
    if (!(modulus <= CoatedBody::kStiffest * kRounding * softest &&
          modulus * kRounding >= CoatedBody::kSoftest * softest))
    {
      throw Error(ErrorCode::BadValue,
        "coatings: one is more than 20 times as stiff, or 1000 times as soft, as what is below; "
        "give tissues that differ less");
    }
    softest = std::min(softest, modulus);
  }
}

} // namespace

double surfaceCompliance(double wavenumber, std::span<const Coating> coatings, const Material& body,
  double thickness, Base base)
{
  const Material& top = coatings.front().material;
  const auto stacked = [&](const States& below, double h, const Material& material)
  {
    return onTop(
      below, wavenumber * h, material.poissonRatio, material.shearModulus() / top.shearModulus());
  };
  States states = held(base);
  if (thickness == kInfinite)
  {
    states = fading(0.0, body.poissonRatio, body.shearModulus() / top.shearModulus());
  }
  else if (thickness > 0.0)
  {
    states = stacked(states, thickness, body);
  }
  for (std::size_t i = coatings.size(); i-- > 0;)
  {
    states = stacked(states, coatings[i].thickness, coatings[i].material);
  }
  // the sum without traction along the surface
  const Vector2d sum(states.traction(0, 1), -states.traction(0, 0));
  return -states.displacement.row(1).dot(sum) / states.traction.row(1).dot(sum) /
    (2.0 * (1.0 - top.poissonRatio));
}

// The pressure within a ring is what G(r) = int phi(sqrt(r^2 + t^2)) dt, from 0 to sqrt(a^2 - r^2),
// falls by on the way out.
bool pullsUnderPunch(const Coatings& coatings, const Material& body, Base base, double radius)
{
  constexpr int rings = 8;        // of the inner half, of one area
  constexpr double little = 0.01; // [-] of the mean pressure
  const double uppermost = coatings.all().front().thickness;
  PunchEquation equation(
    wavenumbers(uppermost, radius), 64 + static_cast<int>(2.0 * radius / uppermost));
  const std::vector<double>& k = equation.wavenumbers();
  Eigen::VectorXd deficits(static_cast<Eigen::Index>(k.size()));
  std::ranges::transform(k, deficits.begin(),
    [&](double at) { return 1.0 - surfaceCompliance(at, coatings.all(), body, kInfinite, base); });
  equation.setRadius(radius);
  const Eigen::VectorXd phi = equation.phi(equation.kernel(deficits));
  const std::vector<double>& x = equation.nodes();
  const auto at = [&](double place)
  {
    const auto above = std::clamp<std::ptrdiff_t>(
      std::ranges::lower_bound(x, place) - x.begin(), 1, std::ssize(x) - 1);
    const double low = x[static_cast<std::size_t>(above) - 1];
    const double part = (place - low) / (x[static_cast<std::size_t>(above)] - low);
    return std::lerp(phi[above - 1], phi[above], part);
  };
  const Quadrature rule = gaussLegendre(200, 0.0, 1.0);
  std::array<double, rings + 1> sums{}; // G at the rings' bounds
  for (int i = 0; i <= rings; ++i)
  {
    const double square = 0.5 * i / rings;
    const double end = std::sqrt(1.0 - square);
    for (std::size_t j = 0; j < rule.nodes.size(); ++j)
    {
      sums[static_cast<std::size_t>(i)] +=
        end * rule.weights[j] * at(std::sqrt(square + std::pow(end * rule.nodes[j], 2)));
    }
  }
  const double pull = -little * 0.5 / rings * sums[0];
  return std::ranges::adjacent_find(
           sums, [&](double inner, double outer) { return inner - outer < pull; }) != sums.end();
}

CoatedBody::CoatedBody(const Coatings& coatings, const Material& body, Base base, double widest)
  : coatings_(coatings.thickness())
  , widest_(widest)
  , uppermost_(coatings.all().front().thickness)
  , radiusStep_(std::asinh(widest / uppermost_) / (kRadii - 1))
  , thicknessStep_(std::asinh(kNarrowest) / (kThicknesses - 1))
  , rows_(static_cast<std::size_t>(kRadii) * kThicknesses)
{
  check(coatings, body, widest);
  const double relative = coatings.all().front().material.contactModulus() / body.contactModulus();
  // a narrow contact needs few nodes: each equation serves the radii of an octave
  for (int radius = 0; radius < kRadii;)
  {
    const double octave =
      std::min(widest, std::max(uppermost_, 2.0 * uppermost_ * std::sinh(radius * radiusStep_)));
    PunchEquation equation(
      wavenumbers(uppermost_, octave), 16 + static_cast<int>(octave / uppermost_));
    const Eigen::MatrixXd deficits = deficitsAt(equation.wavenumbers(), coatings, body, base);
    for (; radius < kRadii; ++radius)
    {
      const double a = uppermost_ * std::sinh(radius * radiusStep_);
      if (a > kRounding * octave)
      {
        break;
      }
      equation.setRadius(a);
      const Eigen::MatrixXd endless = equation.kernel(deficits.col(0));
      for (int i = 0; i < kThicknesses; ++i)
      {
        auto& value = rows_[indexOf(radius, i)].value;
        value = equation.solve(i == 0 ? endless : endless + equation.kernel(deficits.col(i)));
        std::transform(
          value.begin(), value.end(), value.begin(), [&](double term) { return relative * term; });
      }
    }
  }
  setSlopes(rows_, kThicknesses, radiusStep_);
}

// what a half-space of the uppermost has over the body without end, and that over thinner ones
Eigen::MatrixXd CoatedBody::deficitsAt(const std::vector<double>& wavenumbers,
  const Coatings& coatings, const Material& body, Base base) const
{
  constexpr double deepest = 20.0; // a base there is not felt
  const auto count = static_cast<Eigen::Index>(wavenumbers.size());
  Eigen::MatrixXd deficits = Eigen::MatrixXd::Zero(count, kThicknesses);
  for (Eigen::Index row = 0; row < count; ++row)
  {
    const double k = wavenumbers[static_cast<std::size_t>(row)];
    const double endless = surfaceCompliance(k, coatings.all(), body, kInfinite, base);
    deficits(row, 0) = 1.0 - endless;
    for (int i = 1; i < kThicknesses; ++i)
    {
      const double thickness = widest_ / std::sinh(i * thicknessStep_);
      if (k * thickness < deepest)
      {
        deficits(row, i) = endless - surfaceCompliance(k, coatings.all(), body, thickness, base);
      }
    }
  }
  return deficits;
}

PunchSolution CoatedBody::operator()(double radius, double thickness) const noexcept
{
  const double x = std::min(radius, widest_) / uppermost_;
  const double alongRadius = std::asinh(x) / radiusStep_;
  const int i = std::min(static_cast<int>(alongRadius), kRadii - 2);

  // the cubic through the four nearest thicknesses
  const double narrow = std::min(kNarrowest, widest_ / std::max(0.0, thickness - coatings_));
  const double along = std::asinh(narrow) / thicknessStep_;
  const int first = std::clamp(static_cast<int>(along) - 1, 0, kThicknesses - 4);
  PunchSolution low{ .value = {} };
  PunchSolution high{ .value = {} };
  for (int j = first; j < first + 4; ++j)
  {
    double weight = 1.0;
    for (int other = first; other < first + 4; ++other)
    {
      weight *= other == j ? 1.0 : (along - other) / (j - other);
    }
    add(low, weight, rows_[indexOf(i, j)]);
    add(high, weight, rows_[indexOf(i + 1, j)]);
  }

  PunchSolution solution = between(low, high, radiusStep_, alongRadius - i);
  const double rate = 1.0 / (uppermost_ * std::sqrt(1.0 + x * x)); // d asinh / da
  for (double& slope : solution.slope)
  {
    slope *= rate;
  }
  return solution;
}

} // namespace palp
