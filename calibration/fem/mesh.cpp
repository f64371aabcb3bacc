#include "calibration/fem/mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace palp::fem
{
namespace
{

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Gradient = Eigen::Matrix<double, 9, Eigen::Dynamic>;

// vec(F) holds F(i, j) at i + 3 j; the axes are r, theta, z
constexpr int kRR = 0;
constexpr int kZR = 2;
constexpr int kTT = 4;
constexpr int kRZ = 6;
constexpr int kZZ = 8;

constexpr std::array<std::array<int, 2>, 8> kLocal{ { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 },
  { 0, -1 }, { 1, 0 }, { 0, 1 }, { -1, 0 } } };

struct Shape
{
  Eigen::Matrix<double, 8, 1> value;
  Eigen::Matrix<double, 8, 2> slope; // to (xi, eta)
};

// serendipity functions of the eight-node quadrilateral
Shape shape(double x, double y)
{
  Shape s;
  for (int a = 0; a < 8; ++a)
  {
    const double i = kLocal[static_cast<std::size_t>(a)][0];
    const double j = kLocal[static_cast<std::size_t>(a)][1];
    const double p = 1.0 + i * x;
    const double q = 1.0 + j * y;
    if (a < 4)
    {
      s.value[a] = 0.25 * p * q * (i * x + j * y - 1.0);
      s.slope(a, 0) = 0.25 * i * q * (2.0 * i * x + j * y);
      s.slope(a, 1) = 0.25 * j * p * (i * x + 2.0 * j * y);
    }
    else if (j != 0.0)
    {
      s.value[a] = 0.5 * (1.0 - x * x) * q;
      s.slope(a, 0) = -x * q;
      s.slope(a, 1) = 0.5 * (1.0 - x * x) * j;
    }
    else
    {
      s.value[a] = 0.5 * p * (1.0 - y * y);
      s.slope(a, 0) = 0.5 * i * (1.0 - y * y);
      s.slope(a, 1) = -y * p;
    }
  }
  return s;
}

IntegrationPoint ringPoint(const Eigen::Matrix<double, 2, 8>& corners, double x, double y)
{
  const Shape s = shape(x, y);
  const Matrix2d jacobian = corners * s.slope;
  const Eigen::Matrix<double, 8, 2> slope = s.slope * jacobian.inverse();
  const double radius = (corners * s.value)[0];
  IntegrationPoint point;
  point.weight = 2.0 * std::numbers::pi * radius * jacobian.determinant();
  point.gradient = Gradient::Zero(9, 16);
  for (Eigen::Index a = 0; a < 8; ++a)
  {
    point.gradient(kRR, 2 * a) = slope(a, 0);
    point.gradient(kRZ, 2 * a) = slope(a, 1);
    point.gradient(kTT, 2 * a) = s.value[a] / radius;
    point.gradient(kZR, 2 * a + 1) = slope(a, 0);
    point.gradient(kZZ, 2 * a + 1) = slope(a, 1);
  }
  return point;
}

using Mapping = std::function<Vector2d(double, double)>; // (u, v) to (r, z)

// nodes at the corners and the middles of the sides of a grid, none in the middle of a cell
Eigen::MatrixXi addNodes(Body& body, const std::vector<double>& us, const std::vector<double>& vs,
  const Mapping& mapping, Base base)
{
  const int columns = 2 * static_cast<int>(us.size()) - 1;
  const int rows = 2 * static_cast<int>(vs.size()) - 1;
  const auto halfway = [](const std::vector<double>& steps, int i)
  {
    const auto k = static_cast<std::size_t>(i / 2);
    return i % 2 == 0 ? steps[k] : 0.5 * (steps[k] + steps[k + 1]);
  };
  Eigen::MatrixXi number = Eigen::MatrixXi::Constant(columns, rows, -1);
  body.positions.resize(2, number.size());
  int count = 0;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      if (i % 2 == 1 && j % 2 == 1)
      {
        continue;
      }
      number(i, j) = count;
      body.positions.col(count) = mapping(halfway(us, i), halfway(vs, j));
      if (j == 0)
      {
        body.base.push_back(count);
        body.heldDofs.push_back(2 * count + 1);
      }
      if (i == 0 || (j == 0 && base != Base::Slip))
      {
        body.heldDofs.push_back(2 * count);
      }
      if (j == rows - 1)
      {
        body.surface.push_back(count);
      }
      ++count;
    }
  }
  body.positions.conservativeResize(2, count);
  return number;
}

struct GaussPoint
{
  double at;
  double weight;
};

// between -1 and 1
std::vector<GaussPoint> gaussPoints(Integration integration)
{
  if (integration == Integration::Reduced)
  {
    return { { -1.0 / std::numbers::sqrt3, 1.0 }, { 1.0 / std::numbers::sqrt3, 1.0 } };
  }
  return { { -std::sqrt(0.6), 5.0 / 9.0 }, { 0.0, 8.0 / 9.0 }, { std::sqrt(0.6), 5.0 / 9.0 } };
}

// the element around the middle (i, j) of a cell
Element ring(const Body& body, const Eigen::MatrixXi& number, int i, int j, Integration integration)
{
  Element element{ .meanDilatation = false };
  Eigen::Matrix<double, 2, 8> corners;
  for (int a = 0; a < 8; ++a)
  {
    const auto& local = kLocal[static_cast<std::size_t>(a)];
    const int node = number(i + local[0], j + local[1]);
    corners.col(a) = body.positions.col(node);
    element.dofs.insert(element.dofs.end(), { 2 * node, 2 * node + 1 });
  }
  for (const GaussPoint& y : gaussPoints(integration))
  {
    for (const GaussPoint& x : gaussPoints(integration))
    {
      element.points.push_back(ringPoint(corners, x.at, y.at));
      element.points.back().weight *= x.weight * y.weight;
    }
  }
  return element;
}

// a body of revolution: u = 0 is the axis, the first v the base, the last the top
Body revolve(const std::vector<double>& us, const std::vector<double>& vs, const Mapping& mapping,
  Integration integration = Integration::Reduced, Base base = Base::Bonded)
{
  Body body{ .dimension = 2 };
  const Eigen::MatrixXi number = addNodes(body, us, vs, mapping, base);
  body.profile = body.surface;
  body.top = body.positions(1, body.surface.front());
  for (int j = 1; j < number.cols(); j += 2)
  {
    for (int i = 1; i < number.rows(); i += 2)
    {
      body.elements.push_back(ring(body, number, i, j, integration));
    }
  }
  return body;
}

// steps measured from the top, as coordinates that end at the top
std::vector<double> fromTheTop(double top, std::vector<double> depths)
{
  for (double& depth : depths)
  {
    depth = top - depth;
  }
  return { depths.rbegin(), depths.rend() };
}

// squares about the ball's center become circles: wholly at its border and within it, less and less
// to where they would come to the top, the base, or twice its radius
Mapping aroundBall(double height, const Inclusion& ball)
{
  if (!(ball.radius > 0.0))
  {
    return [](double u, double v) { return Vector2d(u, v); };
  }
  const double radius = ball.radius;
  const Vector2d center(0.0, height - ball.top - radius);
  const double room = std::min({ radius, ball.top, height - ball.top - 2.0 * radius });
  return [radius, center, room](double u, double v)
  {
    const Vector2d from = Vector2d(u, v) - center;
    const double square = from.lpNorm<Eigen::Infinity>();
    const double part = std::clamp(1.0 - (square - radius) / room, 0.0, 1.0);
    const double within = std::min(1.0, square / radius);
    return square > 0.0
      ? Vector2d(center + from * (1.0 + part * within * (square / from.norm() - 1.0)))
      : center;
  };
}

} // namespace

Body cylinderBody(double radius, double height, double fineRadius, double fine,
  const Coatings& coatings, Integration integration, Base base, const Refinement& refinement,
  const Inclusion& inclusion)
{
  const std::vector<double> sheets = sheetBounds(height, coatings);
  const std::vector<double> bounds = inclusion.radius > 0.0
    ? std::vector{ 0.0, inclusion.top, inclusion.top + 2.0 * inclusion.radius, height }
    : sheets;
  const bool refined = refinement.size > 0.0;
  const std::vector<double> outward = refined
    ? refinedSteps(radius, fineRadius, fine, refinement)
    : gradedSteps(radius, fineRadius, fine, kOutwardGrowth);
  Body body = revolve(inclusion.radius > 0.0 ? stepsThrough(outward, inclusion.radius) : outward,
    fromTheTop(height,
      refined ? sheetSteps(bounds, refinement.size, kOutwardGrowth)
              : sheetSteps(bounds, fine, kDownwardGrowth)),
    aroundBall(height, inclusion), integration, base);
  for (Element& element : body.elements)
  {
    // the first two nodes are at the bottom, the next two at the top
    const Vector2d middle =
      0.5 * (body.positions.col(element.dofs[0] / 2) + body.positions.col(element.dofs[4] / 2));
    const double depth = height - middle.y();
    if (Vector2d(middle.x(), depth - inclusion.top - inclusion.radius).norm() < inclusion.radius)
    {
      element.material = inclusion.material;
      continue;
    }
    const auto sheet = static_cast<std::size_t>(
      std::upper_bound(sheets.begin(), sheets.end(), depth) - sheets.begin() - 1);
    if (sheet < coatings.all().size())
    {
      element.material = coatings.all()[sheet].material;
    }
  }
  body.elementSize = fine;
  return body;
}

Body sphereBody(double radius, SphereSupport support, double fineRadius, double fine)
{
  // the square [0, 1] x [-1, 1] becomes the half disc, its bottom side the arc below 45 degrees
  const double size = fine * std::numbers::sqrt2 / radius;
  const double bottom = support == SphereSupport::LowerHalf ? 0.0 : -1.0;
  return revolve(gradedSteps(1.0, fineRadius * std::numbers::sqrt2 / radius, size, kOutwardGrowth),
    fromTheTop(1.0, gradedSteps(1.0 - bottom, 0.0, fine / radius, kDownwardGrowth)),
    [radius](double u, double v)
    {
      return Vector2d(
        radius * u * std::sqrt(1.0 - 0.5 * v * v), radius * v * std::sqrt(1.0 - 0.5 * u * u));
    });
}

} // namespace palp::fem
