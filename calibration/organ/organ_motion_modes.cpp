#include "calibration/organ/organ_motion_modes.h"

#include "calibration/organ/in_threads.h"
#include "calibration/organ/organ_compliance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kMostMoved = 600;
constexpr Eigen::Index kMostModes = 24;
constexpr std::size_t kMotionsTogether = 32; // loads that are solved at once by a thread

// none nearer to another of its side than a distance
std::vector<PlacedCompliance> thinned(const std::vector<PlacedCompliance>& places, double distance)
{
  std::vector<PlacedCompliance> kept;
  for (const PlacedCompliance& place : places)
  {
    const auto isNear = [&](const PlacedCompliance& other)
    {
      return other.normal.dot(place.normal) > 0.0 &&
        (other.position - place.position).norm() < distance;
    };
    std::ranges::none_of(kept, isNear) ? kept.push_back(place) : void();
  }
  return kept;
}

// where the model tells of no motion, as in a corner, that of the places beside it goes on
std::vector<PlacedCompliance> placesOf(const OrganTable& table, const OrganModel& model)
{
  constexpr double kWider = 1.05;
  std::vector<PlacedCompliance> told = table.places;
  std::erase_if(told,
    [&model](const PlacedCompliance& place)
    {
      OrganModel::Weights weights{};
      return !model.weightsAt(place.position, place.normal, weights);
    });
  std::vector<PlacedCompliance> kept = told;
  for (double distance = table.spacing; kept.size() > kMostMoved; distance *= kWider)
  {
    kept = thinned(told, distance);
  }
  return kept;
}

// a column for each place; none that is held or unknown moves anything
Eigen::MatrixXd solved(const OrganModel& model, const Surface& surface,
  const std::vector<PlacedCompliance>& at, const std::stop_token& stop)
{
  std::vector<SurfacePoint> places;
  std::vector<SurfacePoint> loads;
  std::vector<Eigen::Index> columns;
  for (const PlacedCompliance& place : at)
  {
    places.push_back({ .position = place.position, .normal = place.normal });
    if (place.trust != ComplianceTrust::Unknown && place.trust != ComplianceTrust::Supported)
    {
      loads.push_back(places.back());
      columns.push_back(std::ssize(places) - 1);
    }
  }
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * std::ssize(places), std::ssize(places));
  const std::size_t threads = solverThreads();
  for (std::size_t first = 0; first < loads.size() && !stop.stop_requested();
       first += threads * kMotionsTogether)
  {
    const std::size_t left = loads.size() - first;
    inThreads(std::min(threads, (left + kMotionsTogether - 1) / kMotionsTogether),
      [&](std::size_t part)
      {
        const std::size_t from = first + part * kMotionsTogether;
        const std::size_t count = std::min(kMotionsTogether, loads.size() - from);
        const Eigen::MatrixXd found =
          motionsBy(model, surface, std::span(loads).subspan(from, count), places);
        for (std::size_t i = 0; i < count; ++i)
        {
          motions.col(columns[from + i]) = found.col(static_cast<Eigen::Index>(i));
        }
      });
  }
  return model.contactModulus() * motions;
}

} // namespace

bool addMotion(
  OrganTable& table, const OrganModel& model, const Surface& surface, const std::stop_token& stop)
{
  OrganMotionModes motion{ .radius = drawnRadius(model.side()) };
  const std::vector<PlacedCompliance> at = placesOf(table, model);
  for (const PlacedCompliance& place : at)
  {
    // where the body is held a load moves nothing
    motion.places.push_back({ .position = place.position,
      .normal = place.normal,
      .isLoaded = place.trust != ComplianceTrust::Unknown });
  }
  const Eigen::MatrixXd all = solved(model, surface, at, stop);
  if (stop.stop_requested())
  {
    return false;
  }
  Eigen::MatrixXd alike = all;
  for (Eigen::Index i = 0; i < alike.cols(); ++i)
  {
    alike.col(i) /= std::max(alike.col(i).norm(), 1e-300);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(alike.transpose() * alike);
  const Eigen::Index count = std::min(kMostModes, alike.cols());
  const Eigen::VectorXd lengths = solver.eigenvalues().tail(count).cwiseMax(1e-12).cwiseSqrt();
  const Eigen::MatrixXd modes =
    alike * solver.eigenvectors().rightCols(count) * lengths.cwiseInverse().asDiagonal();
  motion.modes = modes.cast<float>();
  motion.loads = (modes.transpose() * all).cast<float>();
  table.motion = std::move(motion);
  return true;
}

} // namespace palp
