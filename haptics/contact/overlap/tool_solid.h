#pragma once

#include "haptics/numerics/smooth_step.h"
#include "haptics/tip/profile.h"
#include "haptics/tip/tip.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

namespace palp
{

/// What of a tool is in contact, as a stack of pyramids cut off flat, all of as many sides, and its
/// shaft on top.
///
/// In the tool's own frame: the apex is the origin, and the shaft goes up along z. At each height
/// it has the area of the circle of contact on a half-space of elastic material that is pressed
/// that deep, which is smaller than the tool's own: of a cone 2 / pi as wide, of a punch as wide.
/// Planes bound it, so that what it has in common with triangles is a polygon.
///
/// @source  contact circles: Sneddon 1965, haptics/force/linear/contact_depth.h
class ToolSolid
{
public:
  static constexpr std::size_t kSides = 24;

  /// A field along the sides of the tool, so that none of it leaves through them: from the pole, or
  /// up along a shaft. Its divergence is what counts of a body there, constant + linear x the
  /// height over the apex. Nothing enters at the bottom; what leaves one layer enters the next.
  struct Field
  {
    double constant;
    double linear;         ///< [1/m]
    double twist = 0.0;    ///< of what goes from the pole, by 1 / cube of the rise over it [m^3]
    double entering = 0.0; ///< upward, at the bottom of the layer [m]
  };

  /// One pyramid, or the shaft.
  struct Layer
  {
    double low;       ///< [m]
    double high;      ///< [m]
    double radius;    ///< from the axis to the sides, at low [m]
    double slope;     ///< of that over the height; 0: the shaft [-]
    double pole;      ///< height where the sides meet [m]
    double perSquare; ///< 1 / root(1 + slope^2) [-]
    double below;     ///< volume up to low [m^3]
    Field volume{ .constant = 1.0, .linear = 0.0 };
    Field lift{ .constant = 0.0, .linear = 1.0 }; ///< by the height, [m] more

    [[nodiscard]] bool isShaft() const noexcept
    {
      return !(slope > 0.0);
    }
    /// From the axis to the sides [m].
    [[nodiscard]] double radiusAt(double height) const noexcept
    {
      return radius + slope * (height - low);
    }
    /// Of a field, at a height [m].
    [[nodiscard]] double upward(const Field& field, double height) const noexcept
    {
      const double rise = height - pole;
      const double twist = field.twist != 0.0 ? field.twist / (rise * rise) : 0.0;
      return isShaft()
        ? field.entering + (field.constant + 0.5 * field.linear * (height + low)) * (height - low)
        : rise * (atPole(field) + 0.25 * field.linear * rise) + twist;
    }
    /// Of a field without its twist, by the way from the pole: there; over it that grows by a
    /// quarter of the linear part [-].
    [[nodiscard]] double atPole(const Field& field) const noexcept
    {
      return (field.constant + field.linear * pole) / 3.0;
    }
  };

  /// Four base radii of the shaft count, and three more than what of the tool is in the body.
  /// @param tip     checked, without a round nose
  /// @param inside  from the apex up to where the tool leaves the body [m]; not above 0: outside
  explicit ToolSolid(const Tip& tip, double inside = 0.0) noexcept;

  /// From the apex up; the last is the shaft.
  [[nodiscard]] std::span<const Layer> layers() const noexcept
  {
    return { layers_.data(), count_ };
  }
  /// Height of the end of the shaft [m].
  [[nodiscard]] double top() const noexcept
  {
    return layers_[count_ - 1].high;
  }
  /// Where nothing more is counted, whatever of the body is there: all that went into the shaft
  /// goes on in it.
  [[nodiscard]] Layer beyond() const noexcept;
  /// Of the shaft, to its corners [m].
  [[nodiscard]] double outerRadius() const noexcept;

  /// Not less than that of any cross section up to a height [m].
  [[nodiscard]] double outerRadiusBelow(double height) const noexcept;

  /// Of the contact at a depth, with the corner to the shaft rounded off [m].
  [[nodiscard]] Sloped radiusAt(double height) const noexcept;

  /// Of the flat at the apex, as a circle of the same area [m].
  [[nodiscard]] double flatRadius() const noexcept
  {
    return flat_;
  }

  [[nodiscard]] bool isFlat() const noexcept
  {
    return flat_ > 0.0;
  }

  /// The layer that a height is in; the lowest below it.
  [[nodiscard]] const Layer& layerAt(double height) const noexcept;

  /// Of a cross section that is as far from the axis to its sides [m^2].
  [[nodiscard]] static double crossArea(double radius) noexcept;

  /// Unit vectors across the axis, outward from each side; their coordinates.
  using Sides = Eigen::Array<double, kSides, 1>;
  [[nodiscard]] static const Sides& outwardX() noexcept;
  [[nodiscard]] static const Sides& outwardY() noexcept;
  [[nodiscard]] static Eigen::Vector2d outward(std::size_t k) noexcept
  {
    const auto side = static_cast<Eigen::Index>(k);
    return { outwardX()[side], outwardY()[side] };
  }

  /// And to each corner, of a cross section whose sides are 1 from the axis; k is between the sides
  /// k - 1 and k.
  [[nodiscard]] static const std::array<Eigen::Vector2d, kSides>& corners() noexcept;
  /// Their distance from the axis [-].
  [[nodiscard]] static double outerPart() noexcept;

  /// Corner k of the cross section at a height.
  [[nodiscard]] static Eigen::Vector3d corner(
    const Layer& layer, double height, std::size_t k) noexcept;

private:
  static constexpr std::size_t kMost = Profile::kCircles + 1;

  void add(double low, double high, double from, double to) noexcept;

  std::array<Layer, kMost> layers_{};
  std::size_t count_ = 0;
  double flat_;
};

} // namespace palp
