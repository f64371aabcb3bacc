#pragma once

#include "haptics/contact/contact.h"
#include "pipeline/deform/tool_body.h"
#include "pipeline/deform/vertex_rings.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

/// Position of a direction of a plane among evenly spaced ones, without trigonometry or a branch.
///
/// @return  0 to 4 quarter turns from x over y; 0 for no direction
[[nodiscard]] inline float diamondAngle(double x, double y) noexcept
{
  const double sum = std::abs(x) + std::abs(y);
  return sum > 0.0 ? static_cast<float>(2.0 - std::copysign(1.0 + x / sum, y)) : 0.0F;
}

/// The unit vector of diamondAngle().
[[nodiscard]] inline Eigen::Vector2d directionOf(double turns) noexcept
{
  const double x = turns < 2.0 ? 1.0 - turns : turns - 3.0;
  return Eigen::Vector2d(x, std::copysign(1.0 - std::abs(x), 2.0 - turns)).normalized();
}

/// A point of a pressed surface, seen from the contact, by its geodesic from there.
struct GeodesicCoordinates
{
  Eigen::Vector3d local; ///< rest position from the contact's center [m], z along its normal
  double distance;       ///< length of the geodesic [m]
  float turns;           ///< direction in which it leaves the contact, see diamondAngle()
  float facing;          ///< 1 where the surface faces the tool all along it, 0 where it does
                         ///< not, between on an edge from the one to the other
  float steepness;       ///< 0 where the surface lies across the normal, to 1 where it turns away
  float extra = 0.0F;    ///< sinks further than the field by this, so that no side turns over [m]
  bool within;           ///< within the dent; else next to it

  /// The geodesic, unrolled into the tangent plane [m].
  [[nodiscard]] Eigen::Vector2d logMap() const noexcept
  {
    return distance * directionOf(turns);
  }

  [[nodiscard]] bool isFront() const noexcept
  {
    return facing == 1.0F;
  }
  [[nodiscard]] bool isBetween() const noexcept
  {
    return facing > 0.0F && facing < 1.0F;
  }
};

/// The part of a surface around a contact, grown over mesh neighbors.
///
/// Where the surface faces the tool, a geodesic is the straight line to the point: as seen along
/// the normal at the contact circle, as r is, and as long as the distance in space at the outer
/// circle and where the surface is about to turn away. Where it has turned away, geodesics go on
/// along the triangles, laid flat one by one; the far side of a thin lobe is therefore as far as
/// the path around its edge.
class PressRegion
{
public:
  PressRegion() = default;

  /// @param rest       three floats a point [m], borrowed
  /// @param triangles  outward oriented
  PressRegion(std::span<const float> rest, std::span<const Triangle> triangles);

  /// Finds the points nearer than the outer radius, those inside the tool, the one nearest to the
  /// contact, and the neighbors of all these. Where edges are longer than the contact is wide, the
  /// way to a point inside the tool leads over points that stay where they are, next to the tool.
  ///
  /// Its cost follows their number as long as the contact moves by small steps; a jump to another
  /// part of the surface adds the square root of all points, one to another sheet all of them.
  ///
  /// @param inner  contact radius r [m]
  /// @param outer  outer radius [m], more than inner
  void grow(const Contact& contact, const ToolBody& body, double inner, double outer);

  /// Empty again.
  void clear() noexcept;

  /// The points found.
  [[nodiscard]] std::span<const std::int32_t> points() const noexcept
  {
    return points_;
  }

  /// Their coordinates, in the same order.
  [[nodiscard]] std::span<const GeodesicCoordinates> geodesics() const noexcept
  {
    return geodesics_;
  }

  /// Index of a point in points(), negative when it is not there.
  [[nodiscard]] std::int32_t find(std::int32_t point) const noexcept
  {
    return slot_[static_cast<std::size_t>(point)] >> kBits;
  }

  /// Calls a function with every triangle that has a corner within the dent, as indices into
  /// points().
  template <typename Function>
  void forEachTriangle(Function function) const;

  /// Whether there may be a triangle that does not face the tool.
  [[nodiscard]] bool hasSides() const noexcept
  {
    return hasSides_;
  }

  /// Adds to GeodesicCoordinates::extra of the point of an index.
  void sinkFurther(std::size_t index, double more) noexcept
  {
    geodesics_[index].extra += static_cast<float>(more);
  }

  /// Whether the edge between two points leads through the dent, seen along the normal; never of a
  /// mesh whose edges are short against the dent, for they cross no more than its rim.
  [[nodiscard]] bool crosses(
    const GeodesicCoordinates& a, const GeodesicCoordinates& b) const noexcept;

  /// Whether the edge between two points crosses the contact and is longer than its radius.
  [[nodiscard]] bool spansContact(
    const GeodesicCoordinates& a, const GeodesicCoordinates& b) const noexcept;

  /// Of a point that faces the tool.
  [[nodiscard]] GeodesicCoordinates geodesicInFront(
    const Eigen::Vector3d& point, float steepness = 0.0F) const noexcept;

  /// Of a point on the edge between two others, at a fraction of the way from a to b.
  [[nodiscard]] GeodesicCoordinates geodesicBetween(const GeodesicCoordinates& a,
    const GeodesicCoordinates& b, double fraction, const Eigen::Vector3d& point) const noexcept;

  [[nodiscard]] Eigen::Vector3d rest(std::int32_t point) const noexcept
  {
    const float* p = rest_.data() + 3 * static_cast<std::size_t>(point);
    return { p[0], p[1], p[2] };
  }

  /// Along the normal of the surface at rest at a point, twice the area of its triangles [m^2].
  [[nodiscard]] Eigen::Vector3d areaAround(std::int32_t point) const noexcept;

  /// A position of the contact's frame in that of the surface [m].
  [[nodiscard]] Eigen::Vector3d toSurface(const Eigen::Vector3d& local) const noexcept
  {
    return center_ + axes_.transpose() * local;
  }

  /// And the other way.
  [[nodiscard]] Eigen::Vector3d toLocal(const Eigen::Vector3d& point) const noexcept
  {
    return axes_ * (point - center_);
  }

  [[nodiscard]] Eigen::Vector3d normal() const noexcept
  {
    return axes_.row(2);
  }
  [[nodiscard]] double inner() const noexcept
  {
    return inner_;
  }
  [[nodiscard]] double outer() const noexcept
  {
    return outer_;
  }

  /// Mean length of the edges at the point nearest to the contact [m].
  [[nodiscard]] double edgeLength() const noexcept;

  [[nodiscard]] std::size_t pointCount() const noexcept
  {
    return slot_.size();
  }
  [[nodiscard]] const VertexRings& rings() const noexcept
  {
    return rings_;
  }
  [[nodiscard]] std::size_t bytes() const noexcept;

private:
  static constexpr std::int32_t kSettledBit = 1;
  static constexpr std::int32_t kSharpBit = 2; // see isSharpAt()
  static constexpr std::int32_t kBits = 2;
  static constexpr std::int32_t kNowhere = -1 << kBits;

  [[nodiscard]] std::int32_t findSeed(const Contact& contact) const noexcept;
  [[nodiscard]] std::int32_t descentStep(std::int32_t start, const Contact& contact) const noexcept;
  [[nodiscard]] std::int32_t findClosestPoint(
    const Contact& contact, std::size_t every) const noexcept;
  [[nodiscard]] bool faces(std::int32_t point, const Eigen::Vector3d& normal) const noexcept;
  [[nodiscard]] bool isSettled(std::int32_t point) const noexcept
  {
    return (slot_[static_cast<std::size_t>(point)] & kSettledBit) != 0;
  }
  template <typename Function>
  void forEachAreaAround(std::int32_t point, Function function) const;
  [[nodiscard]] bool isSharpAt(std::int32_t point) const noexcept;
  [[nodiscard]] double longestEdge(std::int32_t point) const noexcept;
  [[nodiscard]] bool isNear(std::int32_t point, const ToolBody& body) const noexcept;
  [[nodiscard]] bool isCoarse() const noexcept;
  void spread(const ToolBody& body);
  [[nodiscard]] bool reachAcrossEdges();
  void expand(std::size_t from, std::int32_t a, std::int32_t b, const ToolBody& body);
  [[nodiscard]] std::size_t indexOf(std::int32_t point);
  void settle(
    std::int32_t point, const Eigen::Vector3d& local, const ToolBody& body, bool isGentle);
  void meetAround(std::int32_t point, std::int32_t from, std::int32_t beside, const ToolBody& body);
  [[nodiscard]] float steepnessAt(std::int32_t point) const noexcept;
  [[nodiscard]] double distanceInFront(
    const Eigen::Vector3d& local, double steepness) const noexcept;
  [[nodiscard]] GeodesicCoordinates geodesicAround(
    std::int32_t from, std::int32_t beside, std::int32_t point) const noexcept;

  std::span<const float> rest_;
  VertexRings rings_;
  std::vector<std::int32_t> slot_; // of every point its index in points_, above kBits

  // of one press; capacity is kept from frame to frame
  std::vector<std::int32_t> points_;
  std::vector<GeodesicCoordinates> geodesics_;
  std::vector<std::int32_t> queue_;                    // slots to grow from
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity(); // rows: two tangents and the normal
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double inner_ = 0.0;
  double outer_ = 0.0;
  double longestEdge_ = 0.0; // of the surface [m]
  double perWidth_ = 0.0;    // 1 / (outer - inner) [1/m]
  double perTurn_ = 0.0;     // 1 / width of the zone where lengths become true ones [1/m]
  std::int32_t seed_ = 0;
  bool hasSides_ = false;
};

// calls with twice the area vector of each triangle of a point, at rest
template <typename Function>
void PressRegion::forEachAreaAround(std::int32_t point, Function function) const
{
  const Eigen::Vector3d p = rest(point);
  std::int32_t before = VertexRings::kEnd;
  for (const std::int32_t next : rings_.around(point))
  {
    if (before != VertexRings::kEnd && next != VertexRings::kEnd)
    {
      function(Eigen::Vector3d((rest(before) - p).cross(rest(next) - p)));
    }
    before = next;
  }
}

template <typename Function>
void PressRegion::forEachTriangle(Function function) const
{
  const auto isWithin = [&](std::int32_t index)
  { return geodesics_[static_cast<std::size_t>(index)].within; };
  for (std::int32_t owner = 0; owner < static_cast<std::int32_t>(points_.size()); ++owner)
  {
    if (!isWithin(owner))
    {
      continue;
    }
    std::int32_t before = VertexRings::kEnd;
    for (const std::int32_t next : rings_.around(points_[static_cast<std::size_t>(owner)]))
    {
      if (before != VertexRings::kEnd && next != VertexRings::kEnd)
      {
        // a triangle belongs to the first of its corners within the dent
        const std::int32_t a = find(before);
        const std::int32_t b = find(next);
        if ((a > owner || !isWithin(a)) && (b > owner || !isWithin(b)))
        {
          function(Triangle{ owner, a, b });
        }
      }
      before = next;
    }
  }
}

} // namespace palp
