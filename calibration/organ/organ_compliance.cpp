#include "calibration/organ/organ_compliance.h"

#include "calibration/organ/mapped_contact.h"
#include "calibration/organ/smooth_pressure.h"
#include "calibration/organ/surface_parts.h"
#include "calibration/organ/tangent_plane.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace palp
{
namespace
{

constexpr std::array kRings{ 0.0, 0.5, 1.0, 1.5 }; // radii
constexpr int kLoadRings = 24;
constexpr int kAround = 16; // places on a ring

Eigen::Vector2d onCircle(double radius, int i)
{
  const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kAround;
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

// what the surface is loaded by where the field of the half-space is taken off: of a flat one
// nothing but where it ends
Eigen::VectorXd loadBeyond(
  const OrganModel& model, const TangentPlane& plane, const SmoothPressure& pressure)
{
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3L * model.nodes());
  OrganModel::Weights weights{};
  constexpr double growth = 0.1;
  constexpr double filled = 0.0; // a load is in its own cube, however little of that is filled
  forParts(plane.surface(), plane.place(), 0.5 * model.side(), growth,
    [&](const Eigen::Vector3d& middle, const Eigen::Vector3d& area)
    {
      const Eigen::Vector3d normal = plane.inside(area);
      const Eigen::Vector3d local = plane.inside(middle - plane.place());
      if (!model.weightsAt(middle, area.normalized(), weights, filled))
      {
        return;
      }
      Eigen::Vector3d force = -pressure.stress(local) * normal;
      if (plane.facesAlike(area) && std::abs(local.z()) < plane.reach())
      {
        force.z() -= pressure.at(local.head<2>().norm()) * normal.z();
      }
      for (std::size_t k = 0; k < weights.nodes.size(); ++k)
      {
        load.segment<3>(3L * weights.nodes[k]) += weights.values[k] * plane.outside(force);
      }
    });
  return load;
}

// a part of the pressure, as places of equal force
struct Pressed
{
  std::vector<Eigen::Vector2d> off; // the body
  double part = 0.0;                // of the force that is on it
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero(); // mean of x x'
};

Pressed pressedBy(const SmoothPressure& pressure, const TangentPlane& plane)
{
  Pressed pressed;
  int on = 0;
  for (int ring = 0; ring < kLoadRings; ++ring)
  {
    for (int i = 0; i < kAround; ++i)
    {
      const Eigen::Vector2d place = onCircle(pressure.radiusOf((ring + 0.5) / kLoadRings), i);
      if (!plane.onSurface(place))
      {
        pressed.off.push_back(place);
        continue;
      }
      ++on;
      pressed.middle += place;
      pressed.square += place * place.transpose();
    }
  }
  pressed.middle /= on;
  pressed.square /= on;
  pressed.part = static_cast<double>(on) / (kLoadRings * kAround);
  return pressed;
}

// displacements beyond those of a half-space, and where
struct Readings
{
  std::vector<Eigen::Vector2d> places;
  std::vector<double> values;
};

Readings read(const OrganModel& model, const TangentPlane& plane, const SmoothPressure& pressure,
  const Pressed& pressed, const Eigen::Ref<const Eigen::VectorXd>& moved)
{
  Readings readings;
  const double modulus = 2.0 * pressure.shear / (1.0 - pressure.poisson); // E*
  OrganModel::Weights weights{};
  for (const double ring : kRings)
  {
    for (int i = 0; i < kAround; ++i)
    {
      const Eigen::Vector2d in = onCircle(ring * pressure.radius, i);
      const auto on = plane.onSurface(in);
      if (!on || !model.weightsAt(*on, plane.outward(), weights))
      {
        continue;
      }
      double down = pressure.displacement(plane.inside(*on - plane.place())).z() -
        pressure.displacement({ in.x(), in.y(), 0.0 }).z();
      for (std::size_t k = 0; k < weights.nodes.size(); ++k)
      {
        down -= weights.values[k] * plane.outward().dot(moved.segment<3>(3L * weights.nodes[k]));
      }
      for (const Eigen::Vector2d& off : pressed.off)
      {
        down += 1.0 / (kLoadRings * kAround * std::numbers::pi * modulus * (off - in).norm());
      }
      readings.places.push_back(in);
      readings.values.push_back(down / pressed.part);
    }
  }
  return readings;
}

// none where too little is on the body
std::optional<OrganCompliance> fitted(
  const Readings& readings, const Pressed& pressed, const TangentPlane& plane, double radius)
{
  if (readings.places.size() < kRings.size() * kAround / 3)
  {
    return std::nullopt;
  }
  // G0 + b.(x + y) + (x'Ax + y'Ay) / 2, of the mean over the pressure
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(readings.places.size()), 6);
  const Eigen::Matrix2d square = pressed.square / (radius * radius);
  for (std::size_t i = 0; i < readings.places.size(); ++i)
  {
    const Eigen::Vector2d y = readings.places[i] / radius;
    const Eigen::Vector2d first = y + pressed.middle / radius;
    terms.row(static_cast<Eigen::Index>(i)) << 1.0, first.x(), first.y(),
      0.5 * (square(0, 0) + y.x() * y.x()), 0.5 * (square(1, 1) + y.y() * y.y()),
      square(0, 1) + y.x() * y.y();
  }
  const Eigen::VectorXd found = terms.colPivHouseholderQr().solve(Eigen::Map<const Eigen::VectorXd>(
    readings.values.data(), static_cast<Eigen::Index>(readings.values.size())));
  return OrganCompliance{ .constant = found[0],
    .slope = plane.vector({ found[1] / radius, found[2] / radius }),
    .bend = (found[3] + found[4]) / (radius * radius) };
}

SmoothPressure pressureOf(const OrganModel& model, double ratio)
{
  return { pressedRadius(model.side()), ratio * model.shearModulus(), model.poissonRatio() };
}

// whether the field of the pressure, whose source is above the place, is steep within the body: it
// hangs over the place, or a wall of it rises beside
bool isNearSource(const Surface& surface, const SurfacePoint& place, double radius)
{
  constexpr double kNear = 0.9; // of the height of the source
  const auto above = [&](double radii) -> Eigen::Vector3d
  { return place.position + radii * radius * place.normal; };
  return rayEntry(surface.tree(), above(1e-3), place.normal).triangle >= 0 ||
    distanceTo(surface.tree(), above(1.0), radius) < kNear * radius;
}

// what the cubes give to loads at places; those near the source are left out
struct Loaded
{
  std::vector<TangentPlane> planes{};
  std::vector<SmoothPressure> pressures{}; // on a half-space of the modulus at each
  std::vector<std::size_t> of{};           // the places
  Eigen::MatrixXd moved{};                 // a column for each plane [m/N]
};

Loaded loadedAt(
  const OrganModel& model, const Surface& surface, std::span<const SurfacePoint> places)
{
  Loaded loaded;
  const double radius = pressedRadius(model.side());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const auto& [position, outward] = places[i];
    if (!isNearSource(surface, places[i], radius))
    {
      loaded.planes.emplace_back(surface, position, outward, radius);
      loaded.pressures.push_back(pressureOf(model, model.moduli().around(position, radius)));
      loaded.of.push_back(i);
    }
  }
  Eigen::MatrixXd loads(3L * model.nodes(), static_cast<Eigen::Index>(loaded.planes.size()));
  for (std::size_t i = 0; i < loaded.planes.size(); ++i)
  {
    const auto column = static_cast<Eigen::Index>(i);
    const TangentPlane& plane = loaded.planes[i];
    const SmoothPressure& pressure = loaded.pressures[i];
    const auto field = [&](const Eigen::Vector3d& place) -> Eigen::Vector3d
    { return plane.outside(pressure.displacement(plane.inside(place - plane.place()))); };
    loads.col(column) = loadBeyond(model, plane, pressure);
    model.moveSupports(loads.col(column),
      [&](const Eigen::Vector3d& place) -> Eigen::Vector3d { return -field(place); });
    model.varyLoad(loads.col(column), field, pressure.shear / model.shearModulus());
  }
  loaded.moved = model.solve(loads);
  return loaded;
}

// Where the modulus changes beside the place, what the body gives way is no smooth field beyond
// that of a half-space: of that its mean over the pressure is told.
void takeOff(OrganCompliance& compliance, const MappedContact::Told& told, double radius)
{
  compliance.constant -= told.constant;
  compliance.slope -= told.slope;
  compliance.bend -= told.bend;
  compliance.isAtBorder = told.isAtBorder;
  if (told.isAtBorder)
  {
    constexpr double kSquare = 1.0 / 3.0; // half of the pressure's mean r^2, over that of c
    compliance.constant += kSquare * radius * radius * compliance.bend;
    compliance.bend = 0.0;
    compliance.slope.setZero();
  }
}

} // namespace

std::vector<std::optional<OrganCompliance>> compliancesAt(const OrganModel& model,
  const Surface& surface, const MappedContact* mapped, std::span<const SurfacePoint> places)
{
  const Loaded loaded = loadedAt(model, surface, places);
  std::vector<std::optional<OrganCompliance>> found(places.size());
  for (std::size_t i = 0; i < loaded.planes.size(); ++i)
  {
    const SmoothPressure& pressure = loaded.pressures[i];
    const Pressed pressed = pressedBy(pressure, loaded.planes[i]);
    const Readings readings = read(
      model, loaded.planes[i], pressure, pressed, loaded.moved.col(static_cast<Eigen::Index>(i)));
    std::optional<OrganCompliance>& one = found[loaded.of[i]];
    one = fitted(readings, pressed, loaded.planes[i], pressure.radius);
    if (one && mapped != nullptr)
    {
      const double ratio = pressure.shear / model.shearModulus();
      takeOff(*one, (*mapped)(loaded.planes[i], ratio), pressure.radius);
    }
  }
  return found;
}

Eigen::MatrixXd motionsBy(const OrganModel& model, const Surface& surface,
  std::span<const SurfacePoint> loads, std::span<const SurfacePoint> places)
{
  const Loaded loaded = loadedAt(model, surface, loads);
  Eigen::MatrixXd motions =
    Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * places.size()), std::ssize(loads));
  for (std::size_t i = 0; i < loaded.planes.size(); ++i)
  {
    const TangentPlane& plane = loaded.planes[i];
    const SmoothPressure& pressure = loaded.pressures[i];
    const SmoothPressure wide{ drawnRadius(model.side()), pressure.shear, pressure.poisson };
    const auto moved = loaded.moved.col(static_cast<Eigen::Index>(i));
    const double part = pressedBy(pressure, plane).part;
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      OrganModel::Weights weights{};
      if (!model.weightsAt(places[k].position, places[k].normal, weights))
      {
        continue;
      }
      const Eigen::Vector3d local = plane.inside(places[k].position - plane.place());
      // above the plane as on it: there it only has to come to nothing
      const Eigen::Vector3d below(local.x(), local.y(), std::max(0.0, local.z()));
      Eigen::Vector3d all = plane.outside(pressure.displacement(local));
      for (std::size_t n = 0; n < weights.nodes.size(); ++n)
      {
        all += weights.values[n] * moved.segment<3>(3L * weights.nodes[n]);
      }
      motions.block<3, 1>(
        static_cast<Eigen::Index>(3 * k), static_cast<Eigen::Index>(loaded.of[i])) =
        all / part + plane.outside(wide.displacement(below) - pressure.displacement(below));
    }
  }
  return motions;
}

std::optional<OrganCompliance> complianceAt(const OrganModel& model, const Surface& surface,
  const Eigen::Vector3d& place, const Eigen::Vector3d& outward)
{
  const SurfacePoint point{ .position = place, .normal = outward };
  const auto mapped = mappedContactOf(model, surface, pressedRadius(model.side()));
  return compliancesAt(model, surface, mapped ? &*mapped : nullptr, std::span(&point, 1)).front();
}

} // namespace palp
