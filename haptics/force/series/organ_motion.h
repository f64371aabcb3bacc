#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

/// How the surface of a body moves as a whole, known at some places: under a unit of force over E*
/// at place i by modes times the column i of loads [1/m].
struct OrganMotionModes
{
  /// One place, with the outward unit normal.
  struct Place
  {
    Eigen::Vector3d position; ///< [m]
    Eigen::Vector3d normal;
    bool isLoaded; ///< else its column of loads means nothing
  };

  double radius = 0.0; ///< of the pressure of a load [m]
  std::vector<Place> places{};
  Eigen::MatrixXf loads{}; ///< a row for each mode, a column for each place
  Eigen::MatrixXf modes{}; ///< x, y, z of place after place, a column for each mode
};

/// A tool on a body that gives way as a whole.
struct OrganLoad
{
  Eigen::Vector3d center; ///< of the contact, at rest [m]
  Eigen::Vector3d normal; ///< outward, of unit length
  double force = 0.0;     ///< over E* [m^2]
  double given = 0.0;     ///< depth of the tool less that of the contact by itself [m]
};

/// Moves the surface of a body as a whole, under one tool or several together. For pictures: the
/// force is that of a ComplianceField.
class OrganMotion
{
public:
  static constexpr std::size_t kNear = 8; ///< places that a motion is interpolated from

  using Lanes = float __attribute__((vector_size(16))); ///< x, y, z, nothing

  /// Of one of the places.
  struct Moved
  {
    Lanes move; ///< [m]
    Lanes turn; ///< about an axis, by its length [rad]
  };

  /// Places and what counts each of them.
  struct Weights
  {
    std::array<std::uint16_t, kNear> places;
    std::array<float, kNear> values;
  };

  /// @param modes  of one place or more, fewer than 65,536
  explicit OrganMotion(const OrganMotionModes& modes);

  /// A load whose force is such that the surface moves by what the body gives way, and by what the
  /// half-space does far from a contact; by a quarter more or less at most.
  [[nodiscard]] OrganLoad fitted(OrganLoad load) const;

  /// Of all places.
  /// @param moved  replaced; keeps its memory
  void move(std::span<const OrganLoad> loads, std::vector<Moved>& moved) const;

  /// The nearest places, by which a plane through the motions is laid.
  [[nodiscard]] Weights weightsAt(const Eigen::Vector3d& point) const;

  /// The same of one point.
  [[nodiscard]] Moved movedAt(const Eigen::Vector3d& point, std::span<const OrganLoad> loads) const;

  [[nodiscard]] static Moved blend(const Weights& weights, std::span<const Moved> moved) noexcept
  {
    Moved sum{};
    for (std::size_t i = 0; i < kNear; ++i)
    {
      const Moved& place = moved[weights.places[i]];
      sum.move += weights.values[i] * place.move;
      sum.turn += weights.values[i] * place.turn;
    }
    return sum;
  }

private:
  // weights of values, and of their gradient, near a point
  struct Fit
  {
    Weights at;
    std::array<Eigen::Vector3d, kNear> gradient; // [1/m]
  };
  [[nodiscard]] Fit fitAt(const Eigen::Vector3d& point, const Eigen::Vector3d* side) const;
  [[nodiscard]] Eigen::VectorXf amplitudes(std::span<const OrganLoad> loads) const;

  double radius_;
  std::vector<OrganMotionModes::Place> places_;
  Eigen::MatrixXf loads_;
  Eigen::MatrixXf moved_; // as Moved of place after place, a column for each mode
};

/// x, y and z.
[[nodiscard]] inline Eigen::Vector3d vectorOf(const OrganMotion::Lanes& lanes) noexcept
{
  return { static_cast<double>(lanes[0]), static_cast<double>(lanes[1]),
    static_cast<double>(lanes[2]) };
}

} // namespace palp
