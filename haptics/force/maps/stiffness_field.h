#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/nodules/homogeneous_press.h"
#include "haptics/force/validity.h"
#include "haptics/numerics/cubic_spline.h"
#include "haptics/surface/sampling/point_cells.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace palp
{

/// What a tool feels at one place of a body whose stiffness varies, over what the law answers.
struct PlacedStiffness
{
  Eigen::Vector3d position;      ///< on the surface [m]
  Eigen::Vector3d normal;        ///< outward, of unit length
  std::vector<double> logEnergy; ///< of the energy over that of the law, at each knot of a press
  std::vector<double> spreads;   ///< see EnergyWeights::Means, at each knot [-]
};

/// Where a tool touches, on the undeformed surface.
struct StiffnessContact
{
  Eigen::Vector3d center;  ///< above the tool's deepest point [m]
  Eigen::Vector3d normal;  ///< outward, of unit length
  double depth;            ///< of that point [m]
  Eigen::Matrix3d turning; ///< of the normal, a column for each way in which the tool moves [1/m]

  /// A slope along the surface as the tool feels it: where the normal turns below a round tool, the
  /// place that it presses moves by less, or in a hollow by more, than the tool.
  /// @param slope   by the place, along the surface
  /// @param height  of a round tool's center over its deepest point [m]
  [[nodiscard]] Eigen::Vector3d byTool(const Eigen::Vector3d& slope, double height) const noexcept
  {
    constexpr double kFarther = 3.0; // times, in a hollow
    const Eigen::Vector3d felt =
      slope - std::max(0.0, height - depth) * turning.transpose() * slope;
    const double most = kFarther * slope.norm();
    return felt.squaredNorm() > most * most ? (most / felt.norm() * felt).eval() : felt;
  }
};

/// The stiffness of a body that varies from place to place, felt by one tool.
///
/// The energy of a press is that of the law times exp(L(place, depth)); force, lateral force and
/// stiffness are its derivatives, so that no closed path gains energy beyond what the law's own
/// does. L is known at places all over the surface and blended between them, twice continuously
/// differentiable along the surface and over the depth.
class StiffnessField
{
public:
  /// The tables at a contact.
  class Blend
  {
  public:
    /// @param plain  the law's answer at the depth
    /// @param depth  at which the tool is felt while it stays where it touches [m]
    /// @realtime     pure; no allocation, no lock, no exception
    [[nodiscard]] Response operator()(const Response& plain, double depth) const noexcept;

    /// Along the surface, on the tool: toward what is softer, and off its shape [N]; as the other.
    /// @param shape  what the shape of the body does by the law alone [N]
    [[nodiscard]] Eigen::Vector3d lateral(
      const Response& plain, const Eigen::Vector3d& shape, double depth) const noexcept;

  private:
    friend class StiffnessField;
    const StiffnessField* field_ = nullptr;
    StiffnessContact contact_{};
    double energy_ = 1.0; // of the law there over that of the reference, both over their force
    std::array<double, HomogeneousPress::kIntervals + 3> logs_{}; // coefficients of L
  };

  /// @param reference  a press of the law, whose axis the tables have
  /// @param places     spread evenly, no two nearer than the spacing, no gap wider
  /// @param spacing    [m]
  StiffnessField(
    const HomogeneousPress& reference, std::vector<PlacedStiffness> places, double spacing);

  /// @param law, geometry  as of the contact
  /// @realtime             pure; no allocation, no lock, no exception
  [[nodiscard]] Blend at(const StiffnessContact& contact, const ForceLaw& law,
    const ContactGeometry& geometry) const noexcept;

  /// Whether the stiffness varies more, for a press of that depth, than where the law holds.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Rule rule(const StiffnessContact& contact) const noexcept;

  /// Of all tables [bytes].
  [[nodiscard]] std::size_t memory() const noexcept
  {
    return places_.size() * sizeof(Place);
  }
  [[nodiscard]] std::size_t places() const noexcept
  {
    return places_.size();
  }

private:
  static constexpr int kSpreads = 8; // intervals of sqrt(depth)

  struct Place
  {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    std::array<float, kSpreads + 1> spreads;
    std::array<float, HomogeneousPress::kIntervals + 3> logs; // coefficients of a spline
  };

  // a place that counts at a contact
  struct Near
  {
    double weight;
    double slope;         // of the weight by half the square of the distance [1/m^2]
    Eigen::Vector3d away; // from it to the contact [m]
  };

  [[nodiscard]] Near near(const Place& place, const Eigen::Vector3d& center,
    const Eigen::Vector3d& normal) const noexcept;
  template <typename Each>
  void forEachNear(const StiffnessContact& contact, Each each) const noexcept;
  void sharpen(std::vector<PlacedStiffness>& places) const;

  double reach_;         // of a place [m]
  double height_;        // of the tool's reference point over its deepest one [m]
  SplineAxis axis_;      // of sqrt(depth)
  CubicSpline energies_; // of the law over force times depth [-]
  std::vector<Place> places_;
  PointCells cells_;
};

} // namespace palp
