#pragma once

#include "pipeline/deform/dent.h"

#include <array>
#include <vector>

namespace palp
{

/// The dent alone, its triangles divided until it looks round.
///
/// New points lie on the triangles at rest, and give way as the points of the surface do, so that
/// the dent is as exact between them. Normals are those of the surface at rest, interpolated and
/// turned as the dent turns the triangles: at the rim of the patch they are those of the surface.
class DentPatch
{
public:
  /// How often the triangles must be halved so that edges are short against the contact, 0 to 6.
  [[nodiscard]] static int levelFor(const Dent& dent);

  /// @param level      halvings of every edge, 0 to 6
  /// @param tolerance  edges that are farther from the displaced surface are halved further, up to
  ///                   7 times [m]; 0: none
  void build(const Dent& dent, int level, double tolerance = 0.0);

  /// The two points that a point is half way between, which come before it.
  /// @param point  behind those of the dent's region
  [[nodiscard]] const std::array<std::size_t, 2>& between(std::size_t point) const
  {
    return corners_[point].between;
  }

  std::vector<Eigen::Vector3f> points;       ///< [m]
  std::vector<Eigen::Vector3f> normals;      ///< unit
  std::vector<Eigen::Vector3f> displacement; ///< from rest [m]
  std::vector<float> sink;                   ///< along the contact normal [m]
  std::vector<float> distance; ///< from the contact's center along the surface at rest [m]
  std::vector<Zone> zone;
  std::vector<Triangle> triangles;

private:
  // a point at rest
  struct Corner
  {
    Eigen::Vector3d rest;
    Eigen::Vector3f normal;
    GeodesicCoordinates geodesic;
    std::array<std::size_t, 2> between{}; // others, half way, where it is no point of the surface
  };

  static constexpr int kWhole = -1;

  // the corner half way along an edge, which is known by its ends
  struct Middle
  {
    int low = -1;
    int high = -1;
    int corner = kWhole;
  };

  void takeCorners(const Dent& dent);
  void halveEdges(const Dent& dent, double tolerance);
  void addMiddle(int a, int b, const Dent& dent);
  [[nodiscard]] Middle& middleOf(int a, int b);
  [[nodiscard]] GeodesicCoordinates geodesicBetween(
    int a, int b, double fraction, const Eigen::Vector3d& rest, const Dent& dent) const noexcept;
  [[nodiscard]] bool isFar(
    const Triangle& corners, const Dent& dent, double tolerance) const noexcept;
  [[nodiscard]] const GeodesicCoordinates& geodesicOf(int corner) const noexcept
  {
    return corners_[static_cast<std::size_t>(corner)].geodesic;
  }
  [[nodiscard]] bool rests(int corner, const Dent& dent) const noexcept;
  [[nodiscard]] bool restsBetween(int a, int b, const Dent& dent) const noexcept;
  void displace(const Dent& dent);
  void turnNormals();

  std::vector<Corner> corners_;
  std::vector<Triangle> coarse_;
  std::vector<Eigen::Vector3f> normalsAtRest_; // of the triangles, not smoothed
  std::vector<Middle> middles_;                // of edges, a hash table with room for all
};

} // namespace palp
