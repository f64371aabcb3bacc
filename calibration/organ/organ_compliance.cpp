#include "calibration/organ/organ_compliance.h"

#include "haptics/surface/ray.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

constexpr double kSides = 2.0;                     // of cells to a radius of the load
constexpr std::array kRings{ 1.0, 1.2, 1.4, 1.6 }; // radii
constexpr int kAround = 16;                        // places on a ring
constexpr int kLoadRings = 6;

// a place on the surface, above or below one in the tangent plane
class TangentPlane
{
public:
  TangentPlane(const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward,
    double reach)
    : surface_(surface)
    , place_(place)
    , outward_(outward)
    , first_(outward.unitOrthogonal())
    , second_(outward.cross(first_))
    , reach_(reach)
  {
  }

  [[nodiscard]] Eigen::Vector3d vector(const Eigen::Vector2d& in) const
  {
    return in.x() * first_ + in.y() * second_;
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> onSurface(const Eigen::Vector2d& at) const
  {
    const Eigen::Vector3d from = place_ + vector(at) + reach_ * outward_;
    const RayHit hit = rayEntry(surface_.tree(), from, -outward_);
    if (hit.triangle < 0 || hit.distance > 2.0 * reach_ || !facesAlike(hit.triangle))
    {
      return std::nullopt;
    }
    return from - hit.distance * outward_;
  }

private:
  // else it is another side of the body, beyond an edge
  [[nodiscard]] bool facesAlike(int triangle) const
  {
    const auto& corners = surface_.triangles()[at(triangle)];
    return unitNormal(surface_.points(), corners).dot(outward_) > std::numbers::sqrt2 / 2.0;
  }

  const Surface& surface_;
  Eigen::Vector3d place_;
  Eigen::Vector3d outward_;
  Eigen::Vector3d first_;
  Eigen::Vector3d second_;
  double reach_;
};

Eigen::Vector2d onCircle(double radius, int i)
{
  const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kAround;
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

// unit force into the body, by places of equal force under Hertz's pressure
Eigen::VectorXd loadOn(
  const OrganModel& model, const TangentPlane& plane, double radius, const Eigen::Vector3d& outward)
{
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3L * model.nodes());
  int count = 0;
  OrganModel::Weights weights{};
  for (int ring = 0; ring < kLoadRings; ++ring)
  {
    const double part = (ring + 0.5) / kLoadRings;
    const double r = radius * std::sqrt(1.0 - std::pow(1.0 - part, 2.0 / 3.0));
    for (int i = 0; i < kAround; ++i)
    {
      const auto place = plane.onSurface(onCircle(r, i));
      if (place && model.weightsAt(*place, outward, weights))
      {
        ++count;
        for (std::size_t k = 0; k < weights.nodes.size(); ++k)
        {
          load.segment<3>(3L * weights.nodes[k]) -= weights.values[k] * outward;
        }
      }
    }
  }
  return count > 0 ? Eigen::VectorXd(load / count) : load;
}

} // namespace

double hertzDisplacement(double distance, double radius, double modulus) noexcept
{
  const double scale = 3.0 / (4.0 * modulus * radius * radius * radius);
  const double square = distance * distance;
  if (distance <= radius)
  {
    return scale * (radius * radius - 0.5 * square);
  }
  return scale / std::numbers::pi *
    ((2.0 * radius * radius - square) * std::asin(radius / distance) +
      radius * std::sqrt(square - radius * radius));
}

std::optional<OrganCompliance> complianceAt(const OrganModel& model, const Surface& surface,
  const Eigen::Vector3d& place, const Eigen::Vector3d& outward)
{
  const double radius = kSides * model.side();
  const TangentPlane plane(surface, place, outward, radius);
  const Eigen::VectorXd moved = model.solve(loadOn(model, plane, radius, outward));
  std::vector<Eigen::Vector2d> places;
  std::vector<double> values;
  OrganModel::Weights weights{};
  for (const double ring : kRings)
  {
    for (int i = 0; i < kAround; ++i)
    {
      const Eigen::Vector2d in = onCircle(ring * radius, i);
      const auto on = plane.onSurface(in);
      if (!on || !model.weightsAt(*on, outward, weights))
      {
        continue;
      }
      double down = 0.0;
      for (std::size_t k = 0; k < weights.nodes.size(); ++k)
      {
        down -= weights.values[k] * outward.dot(moved.segment<3>(3L * weights.nodes[k]));
      }
      places.push_back(in);
      values.push_back(down - hertzDisplacement(ring * radius, radius, model.contactModulus()));
    }
  }
  if (places.size() < kRings.size() * kAround / 2)
  {
    return std::nullopt;
  }
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(places.size()), 6);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double x = places[i].x() / radius;
    const double y = places[i].y() / radius;
    terms.row(static_cast<Eigen::Index>(i)) << 1.0, x, y, x * x, y * y, x * y;
  }
  const Eigen::VectorXd fitted = terms.colPivHouseholderQr().solve(
    Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  return OrganCompliance{ .constant = fitted[0],
    .slope = plane.vector({ fitted[1] / radius, fitted[2] / radius }) };
}

} // namespace palp
