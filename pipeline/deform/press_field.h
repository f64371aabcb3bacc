#pragma once

#include "calibration/tables/surface_profile.h"
#include "pipeline/deform/bezier_patch.h"
#include "pipeline/deform/local_quadric.h"
#include "pipeline/deform/press_region.h"
#include "pipeline/deform/tool_body.h"

#include <Eigen/Core>
#include <array>
#include <optional>

namespace palp
{

/// What a point of a pressed surface is part of; the values of the array "Zone".
enum class Zone : unsigned char
{
  Rest = 0,
  Ring = 1,   ///< between contact and R_d
  Contact = 2 ///< on the tool
};

/// How far the surface gives way at every point of a press.
///
/// Inside the contact circle the surface lies on the tool. Around it the Bezier patches of Eq. (8),
/// one between each two of kDirections, are laid over the undeformed surface: lengths along it and
/// sinks below it. On a plane this is Fig. 5 to the letter, on a curved surface it leaves neither a
/// step at R_d nor one at the contact circle.
///
/// With a fitted profile the ring is that curve of finite elements in place of Eq. (8), joined to
/// tool and surface in every direction as the Bezier curve is.
///
/// @source Sec. 3.3.1
class PressField
{
public:
  static constexpr int kDirections = 32;

  struct Sink
  {
    double depth; ///< below the undeformed surface, along the contact normal [m]
    Zone zone;
  };

  /// Fits the undeformed surface around the contact and finds the control points.
  ///
  /// @param fitted     of the same depth on a plane; none for the paper's ring
  /// @param isLiteral  contact as wide as region.inner() up to where the tool leaves the surface,
  /// not
  ///                   to a little before it, where the surface would leave at an angle
  void lay(const PressRegion& region, const ToolBody& body, double depth,
    const std::optional<SurfaceProfile>& fitted = std::nullopt, bool isLiteral = false);

  /// How far from the center the ring ought to end: of a fitted profile where that does in any
  /// direction, else beyond where the tool's tangents at the contact circle meet the surface.
  ///
  /// Where it is more than the outer radius, the tool leans, or the surface that is drawn lies
  /// higher, or is more hollow, than the one the contact was found on.
  [[nodiscard]] double reach() const noexcept
  {
    return reach_;
  }

  /// @param geodesic  of a point within the dent, which either faces the tool or does not
  /// @param rest   the point [m]
  [[nodiscard]] Sink sinkAt(const GeodesicCoordinates& geodesic, const Eigen::Vector3d& rest,
    const ToolBody& body) const noexcept;

  /// The same sink, or that below the tool where it would leave the point inside.
  [[nodiscard]] Sink keptOutside(
    const Sink& sink, const Eigen::Vector3d& rest, const ToolBody& body) const noexcept;

  /// The ring's curve in one of kDirections.
  [[nodiscard]] const RingCurve& curve(int direction) const noexcept
  {
    return curves_[static_cast<std::size_t>(direction)];
  }

  /// P0, P1 and P2 in one of kDirections, in the frame of the surface [m].
  [[nodiscard]] std::array<Eigen::Vector3d, 3> controlPoints(
    int direction, const PressRegion& region) const noexcept;

  /// The undeformed surface around the contact, in the frame of the contact.
  [[nodiscard]] const LocalQuadric& surface() const noexcept
  {
    return surface_;
  }

private:
  [[nodiscard]] RingCurve curveTowards(double turns) const noexcept;
  [[nodiscard]] RingCurve curveAlong(
    const Eigen::Vector2d& towards, const PressRegion& region, const ToolBody& body) noexcept;
  [[nodiscard]] bool follows(const RingCurve& curve) const noexcept
  {
    return fittedCurve_ && curve.sink > 0.0 && curve.meet > curve.inner;
  }
  [[nodiscard]] SurfaceProfile fittedTo(const RingCurve& curve) const noexcept;
  [[nodiscard]] double smoothSink(double distance, const RingCurve& curve) const noexcept;
  [[nodiscard]] double sideSink(const GeodesicCoordinates& geodesic, const Eigen::Vector3d& rest,
    const RingCurve& curve, const ToolBody& body) const noexcept;
  [[nodiscard]] double frontSink(const GeodesicCoordinates& geodesic, const Eigen::Vector3d& rest,
    const RingCurve& curve, const ToolBody& body) const noexcept;
  [[nodiscard]] double sinkAbove(const GeodesicCoordinates& geodesic, double below,
    const Eigen::Vector3d& rest, const ToolBody& body) const noexcept;
  [[nodiscard]] double heightOverFit(const GeodesicCoordinates& geodesic) const noexcept
  {
    return geodesic.local.z() - surface_.height(geodesic.local.x(), geodesic.local.y());
  }

  std::optional<SurfaceProfile> fittedCurve_;
  LocalQuadric surface_;
  std::array<RingCurve, kDirections + 1> curves_{}; // the last is the first
  std::array<double, kDirections> bulges_{};        // of the sink between two of them [m], times 4
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  bool isLiteral_ = false;
  double deepest_ = 0.0; // delta [m]
  double reach_ = 0.0;   // [m]
};

} // namespace palp
