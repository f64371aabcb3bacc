#pragma once

#include "haptics/force/nodules/homogeneous_press.h"
#include "haptics/force/nodules/nodule.h"
#include "haptics/force/nodules/nodule_table.h"
#include "haptics/numerics/cubic_spline.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// What nodules add to the answer of the tissue; all of it derives from the energy.
struct NoduleResponse
{
  double energy = 0.0;    ///< U [J], that of the press without nodules not counted
  double force = 0.0;     ///< dU/ddepth [N]
  double stiffness = 0.0; ///< d2U/ddepth2 [N/m]
};

/// Nodules under one tool: their energy U(depth, lateral distances), from which normal force,
/// lateral force and stiffness derive, so that no closed path of the tool gains or loses any.
///
/// One nodule adds the integral of F0 x / (1 - 0.51 x) over the depth, F0 the force without it and
/// x its increment of first order; of several the increments of first order add up.
class Nodules
{
public:
  static constexpr std::size_t kMost = 32;

  /// The response, and what each nodule pushes the tool aside with: the lateral force on the tool
  /// is that of each, away from it, times the lateral distance.
  struct Answer
  {
    NoduleResponse response;
    std::array<double, kMost> repulsion{}; ///< -2 dU/d(lateral^2) [N/m]
  };

  /// The tables at one place, which may be asked at many depths.
  using Place = std::array<NoduleTable::Aside, kMost>; // of each nodule; the rest unset

  /// @param nodules  as they lie where they are pressed
  /// @throws Error   BadValue: as checkedNodule, deeper than the body, or more than kMost
  Nodules(const HomogeneousPress& press, std::span<const Nodule> nodules);

  /// @param reference  of all tables
  /// @throws Error     BadValue: more than kMost
  Nodules(const HomogeneousPress& reference, std::vector<NoduleTable> tables);

  [[nodiscard]] std::size_t size() const noexcept
  {
    return tables_.size();
  }

  /// @param squares  of the distances from the tool's axis to the nodules' [m^2], one each
  /// @realtime       pure; no allocation, no lock, no exception
  [[nodiscard]] Place at(std::span<const double> squares) const noexcept;

  /// @param depth  [m]; 0 or less, or not finite: no contact
  /// @param place  of these nodules
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Answer operator()(double depth, const Place& place) const noexcept
  {
    Answer answer;
    answer.response = response(depth, place, std::span(answer.repulsion).first(size()));
    return answer;
  }

  /// The response alone, in less time.
  /// @param repulsion  gets that of each nodule, as Answer tells it; empty: of none
  [[nodiscard]] NoduleResponse response(
    double depth, const Place& place, std::span<double> repulsion = {}) const noexcept;

  /// The same at once.
  [[nodiscard]] Answer operator()(double depth, std::span<const double> squares) const noexcept
  {
    return (*this)(depth, at(squares));
  }

private:
  SplineAxis axis_;      // of sqrt(depth)
  CubicSpline energies_; // of the press over depth^2 [N/m]
  std::vector<NoduleTable> tables_;
};

/// @param places  of their centers [m], one each
/// @throws Error  BadValue: two of them overlap; names both by their numbers, from 0
void checkApart(std::span<const Nodule> nodules, std::span<const Eigen::Vector3d> places);

} // namespace palp
