#include "haptics/force/nodules/nodule_increment.h"

#include "haptics/numerics/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

// where the fit of higher orders ends
constexpr double kBoundedFrom = 0.85;
constexpr double kBound = 0.9;

// Points in half a ball. Deeper than half a radius, strain varies little over it.
struct Points
{
  int shells;
  int latitudes;
  int longitudes;
};

Points pointsIn(const Nodule& nodule, double lateral) noexcept
{
  Points points = 2.0 * nodule.top < nodule.radius ? Points{ 6, 8, 8 } : Points{ 4, 6, 6 };
  if (lateral == 0.0)
  {
    points.longitudes = 1;
  }
  return points;
}

// Products of the strain and its rate over the ball, that of volume and that of shape.
struct Products
{
  double volume = 0.0;
  double shape = 0.0;
};

std::vector<Products> productsOver(
  const HomogeneousPress& press, const Nodule& nodule, double lateral)
{
  const Points points = pointsIn(nodule, lateral);
  const Quadrature shells = gaussLegendre(points.shells, 0.0, nodule.radius);
  const Quadrature latitudes = gaussLegendre(points.latitudes, -1.0, 1.0);
  std::vector<PressStrain> strains(press.knots().size());
  std::vector<Products> products(strains.size());
  for (std::size_t s = 0; s < shells.nodes.size(); ++s)
  {
    for (std::size_t l = 0; l < latitudes.nodes.size(); ++l)
    {
      const double up = latitudes.nodes[l];
      const double out = shells.nodes[s] * std::sqrt(1.0 - up * up);
      for (int k = 0; k < points.longitudes; ++k)
      {
        const double azimuth = (k + 0.5) * std::numbers::pi / points.longitudes;
        // by the law of cosines
        const double r = std::sqrt(
          std::max(0.0, lateral * lateral + out * out + 2.0 * lateral * out * std::cos(azimuth)));
        press.strainAt(r, nodule.depth() + shells.nodes[s] * up, strains);
        const double weight = shells.weights[s] * shells.nodes[s] * shells.nodes[s] *
          latitudes.weights[l] * 2.0 * std::numbers::pi / points.longitudes;
        for (std::size_t i = 0; i < strains.size(); ++i)
        {
          const auto& [total, rate] = strains[i];
          products[i].volume += weight * total.trace() * rate.trace();
          products[i].shape += weight * deviatoricProduct(total, rate);
        }
      }
    }
  }
  return products;
}

// Eshelby's factor of a change of shape, with the images of the free surface and of the tool, both
// fitted to finite elements
double shapeFactor(const Nodule& nodule, double contactRadius, double nu)
{
  const double q3 = std::pow(nodule.radius / nodule.depth(), 3.0);
  const double wide = contactRadius * contactRadius;
  const double tool = wide / (wide + nodule.depth() * nodule.depth());
  const double images = std::max(0.15, 1.0 + q3 * (0.79 - 1.56 * tool) - 0.45 * q3 * q3);
  return images * 2.0 * (4.0 - 5.0 * nu) / (15.0 * (1.0 - nu));
}

} // namespace

increment::Series increment::bounded(double x, double from, double to) noexcept
{
  const double over = std::abs(x) - from;
  if (over <= 0.0)
  {
    return { x, 1.0, 0.0 };
  }
  const double width = to - from;
  const double t = std::tanh(over / width);
  const double slope = 1.0 - t * t;
  return { std::copysign(from + width * t, x), slope, std::copysign(2.0 * t * slope / width, -x) };
}

double increment::ofNodule(double x) noexcept
{
  return ofFirstOrder(bounded(x, kBoundedFrom, kBound).value).value;
}

std::vector<double> firstOrderIncrements(
  const HomogeneousPress& press, const Nodule& nodule, double lateral)
{
  const double nu = press.poissonRatio();
  const double more = nodule.ratio - 1.0;
  const double bulk = 1.0 / (3.0 * (1.0 - 2.0 * nu)); // E = 1
  const double twiceShear = 1.0 / (1.0 + nu);
  const double volumeFactor = (1.0 + nu) / (3.0 * (1.0 - nu));
  const std::vector<Products> products = productsOver(press, nodule, lateral);
  std::vector<double> increments;
  for (std::size_t i = 0; i < products.size(); ++i)
  {
    const HomogeneousPress::Knot& knot = press.knots()[i];
    const double shape = shapeFactor(nodule, knot.radius, nu);
    increments.push_back(more * knot.stiffness *
      (bulk * products[i].volume / (1.0 + volumeFactor * more) +
        twiceShear * products[i].shape / (1.0 + shape * more)));
  }
  return increments;
}

} // namespace palp
