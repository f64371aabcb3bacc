#include "haptics/contact/embed_stiffness.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/error.h"
#include "haptics/force/maps/energy_weights.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/sampling/place_grid.h"
#include "haptics/threads/followed_work.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace palp
{
namespace
{

constexpr double kShallowest = 1e-3;   // that tables reach, so that a press of 0 has one [m]
constexpr double kDeepest = 1.5;       // of the base radius; beyond the law's own limit of 1
constexpr double kSpacing = 0.25;      // of the base radius
constexpr double kMostTables = 6000.0; // of a body
constexpr double kPerPlace = 0.7;      // of a place, of the square of the spacing
constexpr double kLeastKnown = 0.1;    // part of the energy; at a corner of a block a quarter is
constexpr int kPerSpacing = 2;         // of the places around a single one, whose slope is even so
constexpr double kPerThickness = 1.7;  // places of one kind in a doubling of the thickness
constexpr double kPerCurvature = 4.0;  // and of the curvature, over that of the tool

// What lies below places that are nearly alike.
struct WeightsBelow
{
  HomogeneousPress press;
  EnergyWeights weights;
};

struct Looked
{
  SurfacePoint point;
  ContactGeometry geometry;
  std::size_t kind = 0;
};

// each by one of the threads; the first error of any is thrown. Who follows this one hears of it.
void inParallel(std::size_t count, const std::function<void(std::size_t)>& work)
{
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex lock;
  const auto all = [&]
  {
    for (std::size_t i = next++; i < count; i = next++)
    {
      try
      {
        tellDone(static_cast<double>(i) / static_cast<double>(count));
        work(i);
      }
      catch (...)
      {
        const std::scoped_lock only(lock);
        failure = failure ? failure : std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
  {
    others.emplace_back(all);
  }
  all();
  others.clear();
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

// sorts places by what lies below, and names one of each kind
std::vector<ContactGeometry> kindsOf(std::vector<Looked>& places, double baseRadius)
{
  std::map<std::pair<long, long>, std::size_t> known;
  std::vector<ContactGeometry> kinds;
  for (Looked& place : places)
  {
    const double thickness = place.geometry.thickness;
    const double thick = std::isfinite(thickness) ? kPerThickness * std::log2(thickness) : 1e6;
    const double bent = kPerCurvature * place.geometry.surfaceCurvature * baseRadius;
    const auto [found, isNew] =
      known.try_emplace({ std::lround(thick), std::lround(bent) }, kinds.size());
    if (isNew)
    {
      kinds.push_back(place.geometry);
    }
    place.kind = found->second;
  }
  return kinds;
}

[[noreturn]] void refuseUnknown(const Eigen::Vector3d& at)
{
  throw Error(ErrorCode::BadValue,
    "stiffness: nothing is known of it below " + units::inMillimeters(at.x()) + ", " +
      units::inMillimeters(at.y()) + ", " + units::inMillimeters(at.z()) +
      " of the surface; give a map in the frame of the body that covers it, and a tissue for "
      "each of its labels");
}

double checkedModulus(double value)
{
  if (value <= 0.0)
  {
    throw Error(ErrorCode::BadValue,
      "stiffness: there are values of 0 or less in the body; give moduli above 0");
  }
  return std::isnan(value) ? value : makeMaterial(value, 0.0).youngModulus; // else out of range
}

// what is felt of means at each knot
std::vector<double> logEnergies(const HomogeneousPress& press, const EnergyWeights::Means& means)
{
  std::vector<double> factors;
  std::ranges::transform(
    means.logs, std::back_inserter(factors), [](double log) { return std::exp(log); });
  std::vector<double> logs = press.weightedEnergies(factors);
  auto [least, most] = std::pair(factors.front(), factors.front());
  for (std::size_t k = 1; k < logs.size(); ++k)
  {
    // a mean of factors, of which a polynomial between steep ones may make anything
    least = std::min(least, factors[k]);
    most = std::max(most, factors[k]);
    logs[k] = std::log(std::clamp(logs[k] / press.knots()[k].energy, least, most));
  }
  logs.front() = means.logs.front();
  return logs;
}

// at a point that lies below a place as it would on a flat body
PlacedStiffness placedAt(
  const Looked& place, const WeightsBelow& below, const ModulusAt& modulus, double young)
{
  const Eigen::Vector3d& position = place.point.position;
  const Eigen::Vector3d& normal = place.point.normal;
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  const double curvature = place.geometry.surfaceCurvature;
  const EnergyWeights::Means means = below.weights.means(
    [&](const Eigen::Vector3d& at)
    {
      const Eigen::Vector3d curved = belowCurved(at, curvature);
      return checkedModulus(
               modulus(position + curved.x() * u + curved.y() * v - curved.z() * normal)) /
        young;
    });
  if (!(means.known >= kLeastKnown))
  {
    refuseUnknown(position);
  }
  return { position, normal, logEnergies(below.press, means), means.spreads };
}

} // namespace

Eigen::Vector3d belowCurved(const Eigen::Vector3d& flat, double curvature) noexcept
{
  const double across = flat.head<2>().norm();
  const double sagged = std::clamp(0.5 * curvature * across * across, -across, across);
  return { flat.x(), flat.y(), flat.z() + sagged };
}

std::shared_ptr<const StiffnessField> embedStiffness(
  const Surface& surface, const ForceLaw& law, const ModulusAt& modulus)
{
  if (!modulus)
  {
    return nullptr;
  }
  const double base = baseRadius(law.tip());
  const double spacing = std::max(kSpacing * base,
    std::sqrt(kPerPlace * surfaceArea(surface.points(), surface.triangles()) / kMostTables));
  std::vector<Looked> looked;
  for (const SurfacePoint& point : placeGrid(surface, spacing))
  {
    looked.push_back({ point, geometryAt(surface, law.tip(), point) });
    if (!law.settings().thickness)
    {
      looked.back().geometry.thickness = std::numeric_limits<double>::infinity();
    }
  }
  const std::vector<ContactGeometry> kinds = kindsOf(looked, base);
  std::vector<std::unique_ptr<const WeightsBelow>> below(kinds.size());
  inParallel(kinds.size(),
    [&](std::size_t i)
    {
      HomogeneousPress press(law, kinds[i], kDeepest * base);
      EnergyWeights weights(press);
      below[i] =
        std::make_unique<const WeightsBelow>(WeightsBelow{ std::move(press), std::move(weights) });
    });
  std::vector<PlacedStiffness> places(looked.size());
  inParallel(looked.size(),
    [&](std::size_t i) {
      places[i] = placedAt(looked[i], *below[looked[i].kind], modulus, law.material().youngModulus);
    });
  std::vector<std::size_t> counts(kinds.size());
  for (const Looked& place : looked)
  {
    ++counts[place.kind];
  }
  const auto usual = static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
  return std::make_shared<const StiffnessField>(below[usual]->press, std::move(places), spacing);
}

std::shared_ptr<const StiffnessField> stiffnessUnder(
  const ForceLaw& law, const ContactGeometry& place, double deepest, const ModulusAt& modulus)
{
  const HomogeneousPress press(law, place, std::max(deepest, kShallowest));
  const EnergyWeights weights(press);
  const auto meansAt = [&](const Eigen::Vector3d& position)
  {
    return weights.means([&](const Eigen::Vector3d& at)
      { return checkedModulus(modulus(position + at)) / law.material().youngModulus; });
  };
  const std::vector<double> spreads = meansAt(Eigen::Vector3d::Zero()).spreads;
  const double spacing = kSpacing * baseRadius(law.tip());
  constexpr int kFarthest = 4 * kPerSpacing;
  std::vector<PlacedStiffness> places; // those beside it tell the slope of the energy
  for (int i = -kFarthest; i <= kFarthest; ++i)
  {
    for (int j = -kFarthest; j <= kFarthest; ++j)
    {
      const Eigen::Vector3d position = spacing / kPerSpacing * Eigen::Vector3d(i, j, 0.0);
      if (i * i + j * j <= kFarthest * kFarthest)
      {
        places.push_back(
          { position, -Eigen::Vector3d::UnitZ(), logEnergies(press, meansAt(position)), spreads });
      }
    }
  }
  return std::make_shared<const StiffnessField>(press, std::move(places), spacing);
}

} // namespace palp
