#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/nodules/nodule_rules.h"
#include "haptics/force/nodules/nodules.h"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace palp
{

/// A nodule in a body, in the frame of its surface.
struct PlacedNodule
{
  Eigen::Vector3d center; ///< [m]
  double radius;          ///< b [m]
  double ratio;           ///< its Young's modulus over that of the tissue [-]
};

/// Where a nodule lies below the nearest place of the surface.
struct EmbeddedNodule
{
  PlacedNodule nodule;
  double depth;          ///< of its center, its distance from the surface [m]
  ContactGeometry place; ///< of the surface there

  /// The nodule as it lies below that place.
  [[nodiscard]] Nodule below() const noexcept
  {
    return { .radius = nodule.radius, .top = depth - nodule.radius, .ratio = nodule.ratio };
  }
};

/// Where a tool touches, on the undeformed surface.
struct NoduleContact
{
  Eigen::Vector3d center; ///< above the tool's deepest point [m]
  Eigen::Vector3d normal; ///< outward, of unit length
  double depth;           ///< of that point [m]
};

/// Nodules in a body of any shape, felt by one tool.
///
/// Their energy is a function of two distances that the shape of the body does not blur: the depth
/// of the tool, and how far its reference point (the center of a ball, else the apex) is from the
/// nodule's center. On a flat surface that is the nodule at its depth and lateral distance; on a
/// curved one its depth is still that below the nearest place, which noduleRules rates. So the
/// force is the gradient of an energy wherever the normal is that of the depth.
class NoduleField
{
public:
  /// The nodules under one contact.
  class Local
  {
  public:
    /// What they do to the tool along the normal.
    /// @param depth  at which the tool is felt while it stays where it touches [m]
    /// @realtime     pure; no allocation, no lock, no exception
    [[nodiscard]] NoduleResponse operator()(double depth) const noexcept
    {
      return field_->energy_.response(depth, place_);
    }

    /// Besides that, on the tool [N]; as the other.
    [[nodiscard]] Eigen::Vector3d lateral(double depth) const noexcept;

  private:
    friend class NoduleField;
    Local(const NoduleField& field, const NoduleContact& at) noexcept;

    const NoduleField* field_;
    NoduleContact contact_;
    Nodules::Place place_;
  };

  /// @param nodules  one or more
  /// @throws Error   BadValue: as HomogeneousPress, Nodules
  NoduleField(const ForceLaw& law, std::vector<EmbeddedNodule> nodules);

  [[nodiscard]] std::span<const EmbeddedNodule> nodules() const noexcept
  {
    return nodules_;
  }

  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Local at(const NoduleContact& contact) const noexcept
  {
    return { *this, contact };
  }

  /// How much each nodule alone adds to the force without any, or takes, over that force [-].
  /// @param plain  the law's answer without nodules there
  [[nodiscard]] std::vector<double> contrasts(const NoduleContact& at, const Response& plain) const;

  /// How far the surface gives way by more than a threshold, where it does so to an extent without
  /// nodules [m]: stiff tissue spreads what is pressed, and holds the surface right above it.
  /// @param plain   the law's answer without nodules there
  /// @param extent  R_d without them [m]
  /// @source        fitted to linear finite elements, 9 presses of a ball over 4 nodules, 0.9 mm
  [[nodiscard]] double extentRadius(
    const NoduleContact& at, const Response& plain, double extent) const;

  /// @param plain  the law's answer without nodules there
  [[nodiscard]] NoduleRules rules(const NoduleContact& at, const Response& plain) const;

private:
  using Squares = std::array<double, Nodules::kMost>;

  /// From the tool's reference point to the place of a nodule that it would have on a flat surface.
  [[nodiscard]] Eigen::Vector3d aside(
    const EmbeddedNodule& nodule, const NoduleContact& at) const noexcept;
  [[nodiscard]] Squares squaresAt(const NoduleContact& at) const noexcept;

  std::vector<EmbeddedNodule> nodules_;
  double height_; // of the tool's reference point over its deepest one [m]
  ConstitutiveModel constitution_;
  Nodules energy_;
};

} // namespace palp
