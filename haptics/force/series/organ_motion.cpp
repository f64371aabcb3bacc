#include "haptics/force/series/organ_motion.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

constexpr Eigen::Index kLanes = 8; // of one Moved

// how two sides of a body are told apart
constexpr double kSameSide = 0.5;  // cosine of normals from which on a place counts in full
constexpr double kOtherSide = 0.0; // likewise, to which it does not count

double nearness(double t)
{
  const double rest = std::max(0.0, 1.0 - t);
  return rest * rest * rest * rest * (4.0 * t + 1.0);
}

// some places, the nearest first
struct Nearest
{
  static constexpr std::size_t kMost = OrganMotion::kNear + 1;
  std::array<double, kMost> squared{}; // distances [m^2]
  std::array<std::uint16_t, kMost> place{};
  std::size_t count = 0;

  void add(double distance, std::uint16_t which) noexcept
  {
    if (count == kMost && !(distance < squared[kMost - 1]))
    {
      return;
    }
    std::size_t at = count < kMost ? count++ : kMost - 1;
    for (; at > 0 && squared[at - 1] > distance; --at)
    {
      squared[at] = squared[at - 1];
      place[at] = place[at - 1];
    }
    squared[at] = distance;
    place[at] = which;
  }
};

} // namespace

OrganMotion::OrganMotion(const OrganMotionModes& modes)
  : radius_(modes.radius)
  , places_(modes.places)
  , loads_(modes.loads)
  , moved_(Eigen::MatrixXf::Zero(kLanes * std::ssize(modes.places), modes.modes.cols()))
{
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    const auto row = kLanes * static_cast<Eigen::Index>(i);
    moved_.middleRows(row, 3) = modes.modes.middleRows(3 * static_cast<Eigen::Index>(i), 3);
    // the surface turns as it is sloped
    const Eigen::Vector3d normal = places_[i].normal;
    const Eigen::Vector3d first = normal.unitOrthogonal();
    const Eigen::Vector3d second = normal.cross(first);
    const Fit fit = fitAt(places_[i].position, nullptr);
    for (Eigen::Index mode = 0; mode < modes.modes.cols(); ++mode)
    {
      Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
      for (std::size_t k = 0; k < kNear; ++k)
      {
        gradient +=
          modes.modes.block<3, 1>(3 * Eigen::Index{ fit.at.places[k] }, mode).cast<double>() *
          fit.gradient[k].transpose();
      }
      const Eigen::Vector3d turn = normal.dot(gradient * second) * first -
        normal.dot(gradient * first) * second +
        0.5 * (second.dot(gradient * first) - first.dot(gradient * second)) * normal;
      moved_.block<3, 1>(row + 4, mode) = turn.cast<float>();
    }
  }
}

// a plane through the values of the nearest places, by least squares
OrganMotion::Fit OrganMotion::fitAt(const Eigen::Vector3d& point, const Eigen::Vector3d* side) const
{
  Nearest near;
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    if (side == nullptr || (places_[i].isLoaded && places_[i].normal.dot(*side) > kOtherSide))
    {
      near.add((places_[i].position - point).squaredNorm(), static_cast<std::uint16_t>(i));
    }
  }
  const std::size_t count = std::min(kNear, near.count);
  Fit fit{};
  if (count == 0)
  {
    return fit;
  }
  // the next one does not count yet, so that nothing jumps where it comes in
  const double reach = std::sqrt(near.squared[near.count - 1]) * (1.0 + 1e-9);
  std::array<Eigen::Vector4d, kNear> rows{};
  Eigen::Matrix4d all = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < count; ++i)
  {
    const OrganMotionModes::Place& place = places_[near.place[i]];
    const double beside = side == nullptr
      ? 1.0
      : std::min(1.0, (place.normal.dot(*side) - kOtherSide) / (kSameSide - kOtherSide));
    const double weight = beside * nearness(std::sqrt(near.squared[i]) / reach) + 1e-12;
    Eigen::Vector4d row;
    row << 1.0, (place.position - point) / reach;
    all += weight * row * row.transpose();
    rows[i] = weight * row;
    fit.at.places[i] = near.place[i];
  }
  constexpr double kFlat = 1e-4; // a slope that the places do not tell is none
  all.diagonal().tail<3>().array() += kFlat * all(0, 0);
  const Eigen::Matrix4d inverse = all.inverse();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector4d weights = inverse * rows[i];
    fit.at.values[i] = static_cast<float>(weights[0]);
    fit.gradient[i] = weights.tail<3>() / reach;
  }
  return fit;
}

OrganMotion::Weights OrganMotion::weightsAt(const Eigen::Vector3d& point) const
{
  return fitAt(point, nullptr).at;
}

Eigen::VectorXf OrganMotion::amplitudes(std::span<const OrganLoad> loads) const
{
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(loads_.rows());
  for (const OrganLoad& load : loads)
  {
    const Weights weights = fitAt(load.center, &load.normal).at;
    for (std::size_t i = 0; i < kNear; ++i)
    {
      sum += static_cast<float>(load.force) * weights.values[i] *
        loads_.col(Eigen::Index{ weights.places[i] });
    }
  }
  return sum;
}

void OrganMotion::move(std::span<const OrganLoad> loads, std::vector<Moved>& moved) const
{
  moved.resize(places_.size());
  Eigen::Map<Eigen::VectorXf>(reinterpret_cast<float*>(moved.data()), moved_.rows()).noalias() =
    moved_ * amplitudes(loads);
}

OrganMotion::Moved OrganMotion::movedAt(
  const Eigen::Vector3d& point, std::span<const OrganLoad> loads) const
{
  const Eigen::VectorXf parts = amplitudes(loads);
  const Weights weights = weightsAt(point);
  Eigen::Matrix<float, kLanes, 1> sum = Eigen::Matrix<float, kLanes, 1>::Zero();
  for (std::size_t i = 0; i < kNear; ++i)
  {
    sum += weights.values[i] *
      (moved_.middleRows<kLanes>(kLanes * Eigen::Index{ weights.places[i] }) * parts);
  }
  return { Lanes{ sum[0], sum[1], sum[2], 0.0F }, Lanes{ sum[4], sum[5], sum[6], 0.0F } };
}

OrganLoad OrganMotion::fitted(OrganLoad load) const
{
  constexpr double kMost = 0.25;
  constexpr double kFar = 8.0 / (3.0 * std::numbers::pi); // under the middle of the pressure
  const double known = load.given + kFar * load.force / radius_;
  const double drawn = -load.normal.dot(vectorOf(movedAt(load.center, { &load, 1 }).move));
  // where next to nothing moves, its part means nothing
  const double least = 0.5 * kFar * load.force / radius_;
  const double part = (known - drawn) * drawn / (drawn * drawn + least * least + 1e-30);
  load.force *= 1.0 + std::clamp(part, -kMost, kMost);
  return load;
}

} // namespace palp
