#include "haptics/force/maps/energy_weights.h"

#include "haptics/force/nodules/layer_image.h"
#include "haptics/numerics/quadrature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

constexpr double kGeometric = 0.65; // exponents of the means, fitted to finite elements
constexpr double kHarmonic = 0.35;

constexpr double kFinest = 0.02;   // of the base radius: the innermost cell
constexpr double kFarthest = 25.0; // of the widest contact, on a half-space
constexpr double kGrowth = 1.17;   // from one cell to the next
constexpr int kPoints = 2;         // of a cell, each way
constexpr double kNothing = 2e-5;  // weight of a ring below which it is left out
constexpr double kPoint = 3.0;     // innermost cells of a contact that they do not resolve

// borders of cells that grow outward, the last one at the end
std::vector<double> bordersTo(double finest, double end)
{
  std::vector<double> borders{ 0.0 };
  for (double at = finest; at < end / std::sqrt(kGrowth); at *= kGrowth)
  {
    borders.push_back(at);
  }
  borders.push_back(end);
  return borders;
}

using Border = std::span<const double, 2>;

// of a ring whose section is a cell, at each knot
Eigen::VectorXd weightsOf(
  const HomogeneousPress& press, Border r, Border z, std::vector<PressStrain>& strains)
{
  const double bulk = 1.0 / (3.0 * (1.0 - 2.0 * press.poissonRatio())); // E = 1
  const double twiceShear = 1.0 / (1.0 + press.poissonRatio());
  const Quadrature across = gaussLegendre(kPoints, r[0], r[1]);
  const Quadrature down = gaussLegendre(kPoints, z[0], z[1]);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strains.size()));
  for (std::size_t i = 0; i < across.nodes.size(); ++i)
  {
    for (std::size_t j = 0; j < down.nodes.size(); ++j)
    {
      press.strainAt(across.nodes[i], down.nodes[j], strains);
      const double volume =
        2.0 * std::numbers::pi * across.nodes[i] * across.weights[i] * down.weights[j];
      for (std::size_t k = 0; k < strains.size(); ++k)
      {
        const auto& [total, rate] = strains[k];
        sum[static_cast<Eigen::Index>(k)] += volume * press.knots()[k].stiffness *
          (bulk * total.trace() * rate.trace() + twiceShear * deviatoricProduct(total, rate));
      }
    }
  }
  return sum;
}

// as many as are about as far apart as rings are, within reason
int azimuthsOf(double r, double z)
{
  return r < 0.15 * z ? 4 : r < 0.5 * z ? 5 : 8;
}

// Spreads places evenly over rings whose section is a cell: no border between two tissues then
// counts for more than it should because it lies along those of the cells.
class Spread
{
public:
  void add(Border r, Border z, std::vector<Eigen::Vector3d>& to)
  {
    const int count = azimuthsOf(0.5 * (r[0] + r[1]), 0.5 * (z[0] + z[1]));
    ++rings_;
    for (int i = 0; i < count; ++i)
    {
      ++all_;
      const double angle = 2.0 * std::numbers::pi * (i + part(std::numbers::phi * rings_)) / count;
      // as much volume within as without
      const double across = std::sqrt(std::lerp(r[0] * r[0], r[1] * r[1], part(all_ * kEven)));
      to.emplace_back(across * std::cos(angle), across * std::sin(angle),
        std::lerp(z[0], z[1], part(all_ * kEven * kEven)));
    }
  }

private:
  // Roberts' even sequence of two dimensions, by the root of x^3 = x + 1
  static constexpr double kEven = 1.0 / 1.32471795724474602596;

  static double part(double x)
  {
    return x - std::floor(x);
  }

  double rings_ = 0.0;
  double all_ = 0.0;
};

// all energy of a contact that is a point is in the innermost cell
std::vector<double> complete(
  const HomogeneousPress& press, double finest, std::vector<Eigen::VectorXd>& columns)
{
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(columns.front().size());
  for (const Eigen::VectorXd& column : columns)
  {
    sums += column;
  }
  for (Eigen::Index k = 0; k < sums.size(); ++k)
  {
    if (press.knots()[static_cast<std::size_t>(k)].radius < kPoint * finest)
    {
      double& innermost = columns.front()[k];
      const double whole = std::max(0.0, 1.0 - (sums[k] - innermost));
      innermost = std::isfinite(whole) ? whole : 1.0;
      sums[k] = 1.0;
    }
  }
  return { sums.begin(), sums.end() };
}

} // namespace

EnergyWeights::EnergyWeights(const HomogeneousPress& press)
{
  const double finest = kFinest * baseRadius(press.law().tip());
  const double farthest = kFarthest * press.knots().back().radius;
  const double thickness = press.thickness(); // may be infinite
  const std::vector<double> across =
    bordersTo(finest, std::min(farthest, LayerImage::kReach * thickness));
  const std::vector<double> down = bordersTo(finest, std::min(farthest, thickness));
  std::vector<PressStrain> strains(press.knots().size());
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t i = 0; i + 1 < across.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < down.size(); ++j)
    {
      columns.push_back(weightsOf(press, Border(&across[i], 2), Border(&down[j], 2), strains));
    }
  }
  sums_ = complete(press, finest, columns);

  Spread spread;
  std::size_t kept = 0;
  for (std::size_t i = 0; i + 1 < across.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < down.size(); ++j)
    {
      const Eigen::VectorXd& column = columns[i * (down.size() - 1) + j];
      if (column.maxCoeff() > kNothing)
      {
        spread.add(Border(&across[i], 2), Border(&down[j], 2), places_);
        ends_.push_back(places_.size());
        columns[kept++] = column;
      }
    }
  }
  weights_.resize(columns.front().size(), static_cast<Eigen::Index>(kept));
  for (std::size_t c = 0; c < kept; ++c)
  {
    weights_.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  weights_.array().colwise() /= weights_.rowwise().sum().array().eval();
}

EnergyWeights::Means EnergyWeights::means(
  const std::function<double(const Eigen::Vector3d&)>& ratio) const
{
  Eigen::MatrixX3d parts = Eigen::MatrixX3d::Zero(weights_.cols(), 3); // known, logs, inverses
  double least = std::numeric_limits<double>::infinity();              // of the logs
  double most = -least;
  double before = 1.0;
  double log = 0.0; // of that: neighbors are often of one tissue, and a logarithm takes long
  std::size_t begin = 0;
  for (std::size_t c = 0; c < ends_.size(); ++c)
  {
    Eigen::RowVector3d part = Eigen::RowVector3d::Zero();
    for (std::size_t i = begin; i < ends_[c]; ++i)
    {
      if (const double at = ratio(places_[i]); std::isfinite(at))
      {
        log = at == before ? log : std::log(at);
        before = at;
        part += Eigen::RowVector3d(1.0, log, 1.0 / at);
        least = std::min(least, log);
        most = std::max(most, log);
      }
    }
    parts.row(static_cast<Eigen::Index>(c)) = part / static_cast<double>(ends_[c] - begin);
    begin = ends_[c];
  }
  if (least > most) // nothing is known
  {
    least = most = 0.0;
  }
  const Eigen::MatrixX3d sums = weights_ * parts;
  Means means{ .logs = {}, .spreads = {}, .known = sums.col(0).minCoeff() };
  for (Eigen::Index k = 0; k < sums.rows(); ++k)
  {
    // some weights are a little negative, which very soft tissue makes much of
    const double geometric = std::clamp(sums(k, 1) / sums(k, 0), least, most);
    const double inverse = std::max(std::exp(-most), sums(k, 2) / sums(k, 0));
    const double harmonic = std::clamp(-std::log(inverse), least, geometric);
    means.logs.push_back(kGeometric * geometric + kHarmonic * harmonic);
    means.spreads.push_back(std::expm1(geometric - harmonic));
  }
  return means;
}

} // namespace palp
