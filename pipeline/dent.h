#pragma once

#include "haptics/contact/contact.h"
#include "pipeline/bezier_patch.h"
#include "pipeline/tool_body.h"
#include "pipeline/umbrella.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

/// What a point of a pressed surface is part of; the values of the array "Zone".
enum class Zone : unsigned char
{
  Rest = 0,
  Ring = 1,   ///< between contact and R_d
  Contact = 2 ///< on the tool
};

/// A tool pressed into a surface, and how far around it the surface gives way.
struct Press
{
  Contact contact;
  ToolPose pose;
  Tip tip{ SphereTip{ .radius = 0.01 } };
  double contactRadius = 0.0; ///< r [m]
  double extentRadius = 0.0;  ///< R_d of the table [m]
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
/// The contact region is projected onto the tool along the contact normal; the ring around it
/// sinks by the Bezier patches of Eq. (8). Both are laid over the undeformed surface, in the
/// distance from the contact along it and in the depth below it, which on a plane is Fig. 5 to
/// the letter and on a curved surface leaves neither a step at R_d nor one at the contact circle.
/// The region is grown over mesh neighbours, and where the surface turns away from the tool its
/// triangles are unrolled, so that the far side of a thin lobe is as far as the way around its
/// edge.
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
  /// @param arrays  as reset() or the last update() left them
  void update(const Press& press, const DentArrays& arrays);

  /// Points that differ from rest, and their neighbours, whose normals do.
  [[nodiscard]] std::span<const std::int32_t> touched() const noexcept
  {
    return touched_;
  }

  /// Outer radius of the ring as drawn [m]; 0 at rest.
  [[nodiscard]] double ringRadius() const noexcept
  {
    return outer_;
  }

  /// Distance of a touched point from the contact's centre, along the undeformed surface [m].
  [[nodiscard]] double distance(std::size_t indexInTouched) const noexcept;

  /// Triangles with a displaced corner; indices into touched().
  [[nodiscard]] std::vector<Triangle> triangles() const;

  /// Memory that grows with the mesh, the caller's arrays aside [bytes].
  [[nodiscard]] std::size_t bytes() const noexcept;

private:
  // A point of the dent or beside it, seen along the contact normal.
  struct Node
  {
    double x, y, z; // rest position from the contact's centre [m], z along its normal
    double u, v;    // unrolled into the tangent plane [m]
    bool front;     // the surface has faced the tool all the way here
    bool moved;     // within the dent; else a neighbour, whose normal alone changes
  };

  // The quadric z = c0 + c1 x + c2 y + c3 x^2 + c4 xy + c5 y^2 of the undeformed surface.
  using Quadric = Eigen::Matrix<double, 6, 1>;

  static constexpr int kDirections = 32;

  [[nodiscard]] Eigen::Vector3d rest(std::int32_t point) const noexcept;
  [[nodiscard]] std::int32_t findSeed(const Contact& contact) const noexcept;
  [[nodiscard]] bool faces(std::int32_t point, const Eigen::Vector3d& normal) const noexcept;
  void forgetPress(const DentArrays& arrays);
  void grow(const Press& press, const ToolBody& body);
  void expand(std::size_t from, std::int32_t a, std::int32_t b, const ToolBody& body);
  void meet(std::int32_t point, const Node& node, const ToolBody& body);
  [[nodiscard]] Node seen(std::int32_t point) const noexcept;
  [[nodiscard]] Eigen::Vector2d unrolled(
    std::int32_t from, std::int32_t beside, std::int32_t point) const noexcept;
  void fitSurface();
  void layRing(const ToolBody& body);
  void displace(const ToolBody& body, const DentArrays& arrays);
  [[nodiscard]] double sinkOf(
    const Node& node, const RingCurve& curve, double toTool) const noexcept;
  [[nodiscard]] RingCurve curveTowards(double x, double y) const noexcept;
  [[nodiscard]] double surfaceHeight(double x, double y) const noexcept;
  void computeNormal(std::int32_t point, const DentArrays& arrays) const noexcept;

  std::span<const float> rest_;
  Umbrella umbrella_;
  std::vector<std::int32_t> slot_; // place in touched_, -1 for points at rest

  // one press; capacity is kept from frame to frame
  std::vector<std::int32_t> touched_;
  std::vector<std::int32_t> before_; // touched_ of the last press
  std::vector<Node> nodes_;          // of touched_
  std::vector<std::int32_t> queue_;  // slots to grow from
  Eigen::Matrix3d frame_;            // rows: two tangents and the normal
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::int32_t seed_ = 0;
  double inner_ = 0.0;   // r [m]
  double outer_ = 0.0;   // [m]
  double deepest_ = 0.0; // delta [m]
  Quadric quadric_ = Quadric::Zero();
  std::array<RingCurve, kDirections> ring_{};
};

} // namespace palp
