#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/nodules/layer_image.h"
#include "haptics/force/nodules/strain.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace palp
{

/// The strain in tissue without nodules under a tool, and how it grows with the depth.
struct PressStrain
{
  Strain total; ///< over the force, for E = 1 Pa [1/N]
  Strain rate;  ///< d/ddepth over the stiffness, for E = 1 Pa [1/N]
};

/// A tool that is pressed into tissue without nodules: contact, force and strain at growing depths.
///
/// The strain is that of flat punches of all radii up to the contact's, as the method of
/// dimensionality reduction composes a tip of them, plus what the base of a layer adds.
class HomogeneousPress
{
public:
  /// The depths are the squares of these [sqrt(m)], since contact and strain grow with the root of
  /// the depth.
  static constexpr int kIntervals = 32;
  /// Of the axis: what lies beyond is there for a smooth end.
  static constexpr double kInUse = 0.9;

  struct Knot
  {
    double depth = 0.0;     ///< [m]
    double radius = 0.0;    ///< a of the contact [m]
    double stiffness = 0.0; ///< of the linear body, for E = 1 Pa [N/m]
    double force = 0.0;     ///< of the law [N]
    double energy = 0.0;    ///< of the law, the integral of its force [J]
  };

  /// @param law      corrected, without coatings
  /// @param place    where it is pressed; its depth does not count
  /// @param deepest  of the presses that are asked for [m], more than 0; the knots go on beyond
  /// @throws Error   BadValue: another law, or coatings
  HomogeneousPress(const ForceLaw& law, const ContactGeometry& place, double deepest);

  [[nodiscard]] const ForceLaw& law() const noexcept
  {
    return law_;
  }
  [[nodiscard]] double poissonRatio() const noexcept
  {
    return poisson_;
  }
  [[nodiscard]] double thickness() const noexcept
  {
    return thickness_;
  }
  [[nodiscard]] SplineAxis axis() const noexcept
  {
    return axis_;
  }
  [[nodiscard]] std::span<const Knot> knots() const noexcept
  {
    return knots_;
  }

  /// The strain at one place at all depths.
  /// @param r     from the tool's axis [m]
  /// @param z     below the surface [m], more than 0, at most the thickness
  /// @param each  one for each knot
  void strainAt(double r, double z, std::span<PressStrain> each) const noexcept;

  /// Integrals of force times a function of the depth, from 0 to each knot [J times its unit].
  /// @param values  of the function at the knots
  [[nodiscard]] std::vector<double> weightedEnergies(std::span<const double> values) const;

private:
  static constexpr std::size_t kNodes = 2 * kIntervals + 1; // knots and what lies half way
  static constexpr int kForces = 4;                         // per interval

  /// What fraction of punches of three radii a step of the depth adds [m^2].
  using Growth = std::array<double, 3>;

  void findContacts(const ContactGeometry& place);
  void findForces(const ContactGeometry& place);

  ForceLaw law_;
  double poisson_;                          // short of 0.5
  double thickness_ = 0.0;                  // of the layer that stands for the body [m]
  SplineAxis axis_;                         // of sqrt(depth)
  std::shared_ptr<const LayerImage> image_; // null on a half-space
  std::vector<Knot> knots_;
  std::vector<double> radii_;   // at nodes [m]
  std::vector<Growth> growths_; // of each interval
  std::vector<double> sums_;    // of all growth up to each knot [m^2]
  std::vector<double> forces_;  // at Gauss's points of each interval, with their weights [J]
};

} // namespace palp
