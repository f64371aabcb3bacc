#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/series/organ_motion.h"
#include "haptics/pose.h"
#include "pipeline/deform/press_field.h"
#include "pipeline/deform/press_region.h"
#include "pipeline/deform/tool_body.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// A tool pressed into a surface, and how far around it the surface gives way.
struct Press
{
  Contact contact;
  ToolPose pose;
  Tip tip{ SphereTip{ .radius = 0.01 } };
  double contactRadius = 0.0; ///< r [m]
  double extentRadius = 0.0;  ///< R_d of the table [m]

  /// The surface of finite elements at this depth, in place of the paper's ring and its radii.
  std::optional<SurfaceProfile> fitted{};

  /// What friction carries along the surface with the tool, at the contact [m].
  Eigen::Vector3d carried = Eigen::Vector3d::Zero();

  bool isLiteral = false; ///< contactRadius is drawn also where it leaves the surface at an angle

  /// What moves the whole body below the dent, of all tools on it; null or none: it stays. Contact
  /// and pose are then as they are seen from the body where the tool is.
  std::shared_ptr<const OrganMotion> motion{};
  std::vector<OrganLoad> loads{};
};

/// The arrays of a surface as drawn, three floats a point, one byte a zone.
struct DentArrays
{
  float* points;       ///< [m]
  float* normals;      ///< unit, outward
  float* displacement; ///< from rest [m]
  unsigned char* zone; ///< of Zone
};

/// The dent of a press in the points of a surface, at a cost that follows the dent.
///
/// The topology is that of the rest state, and so is every point outside the ring.
///
/// @source Sec. 3.3
class Dent
{
public:
  Dent() = default;

  /// @param rest       three floats a point [m], borrowed
  /// @param triangles  outward oriented
  Dent(std::span<const float> rest, std::span<const Triangle> triangles);

  /// Everything at rest; O(points).
  void reset(const DentArrays& arrays);

  /// Replaces the last press by this one; a press that does not touch leaves the exact rest state.
  ///
  /// No allocation once a dent of this size has been seen.
  ///
  /// @param arrays  as reset() or the last update() left them
  void update(const Press& press, const DentArrays& arrays);

  /// Puts points where another dent of the same surface has them, wherever that one is deeper,
  /// until the next update().
  ///
  /// @param touched  by the other: its points, and their neighbors
  /// @param other    as its update() left them
  /// @param arrays   as update() left them
  void deepen(
    std::span<const std::int32_t> touched, const DentArrays& other, const DentArrays& arrays);

  /// The points where it was.
  [[nodiscard]] std::span<const std::int32_t> deepened() const noexcept
  {
    return deepened_;
  }

  /// The points and neighbors of the other that are not of region().
  [[nodiscard]] std::span<const std::int32_t> besides() const noexcept
  {
    return besides_;
  }

  /// Whether the other dent touched points or neighbors of this one.
  [[nodiscard]] bool meetsOther() const noexcept
  {
    return meetsOther_;
  }

  /// The points of the dent, which differ from rest, and their neighbors, whose normals do.
  [[nodiscard]] const PressRegion& region() const noexcept
  {
    return region_;
  }

  /// How far the surface gives way at a point of the last press; continuous along the surface,
  /// but for the wall that a tool sunk beyond its base cuts.
  [[nodiscard]] PressField::Sink sinkAt(
    const GeodesicCoordinates& geodesic, const Eigen::Vector3d& rest) const noexcept;

  /// From rest to the last press [m].
  /// @param sink  of sinkAt there [m]
  [[nodiscard]] Eigen::Vector3d displacement(
    const GeodesicCoordinates& geodesic, double sink) const noexcept;

  /// Of a point at rest, as if the tool had carried nothing along.
  [[nodiscard]] bool isInsideTool(const Eigen::Vector3d& point) const noexcept
  {
    return body_->inside(point) > 0.0;
  }

  [[nodiscard]] const PressField& field() const noexcept
  {
    return field_;
  }

  /// Memory that grows with the mesh, the caller's arrays aside [bytes].
  [[nodiscard]] std::size_t bytes() const noexcept
  {
    return region_.bytes();
  }

private:
  void lay(const Press& press, double outer);
  void forgetPress(const DentArrays& arrays);
  void displace(std::size_t from, std::size_t to, const DentArrays& arrays) const noexcept;
  void keepSidesUpright(const DentArrays& arrays);
  bool keepUpright(const Triangle& corners, const DentArrays& arrays);
  void computeNormal(std::int32_t point, const DentArrays& arrays) const noexcept;

  std::span<const float> rest_;
  PressRegion region_;
  PressField field_;
  std::optional<ToolBody> body_; // where the tissue that is carried along would be at rest
  Eigen::Vector3d carried_ = Eigen::Vector3d::Zero(); // at the contact [m]
  std::vector<std::int32_t> before_;                  // points of the last press
  std::vector<std::int32_t> deepened_;
  std::vector<std::int32_t> besides_; // touched by the other dent alone
  bool meetsOther_ = false;
};

} // namespace palp
