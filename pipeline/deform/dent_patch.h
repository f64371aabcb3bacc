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
  /// How often the triangles must be halved so that edges are short against the contact, 0 to 4.
  [[nodiscard]] static int levelFor(const Dent& dent);

  /// @param level  halvings of every edge, 0 to 4
  void build(const Dent& dent, int level);

  std::vector<Eigen::Vector3f> points;  ///< [m]
  std::vector<Eigen::Vector3f> normals; ///< unit
  std::vector<float> sink;              ///< along the contact normal [m]
  std::vector<float> distance;          ///< from the contact's center along the surface at rest [m]
  std::vector<Zone> zone;
  std::vector<Triangle> triangles;

private:
  // a point at rest
  struct Corner
  {
    Eigen::Vector3d rest;
    Eigen::Vector3f normal;
    GeodesicCoordinates geodesic;
  };

  // the corner half way along an edge, which is known by its ends
  struct Middle
  {
    int low = -1;
    int high = -1;
    int corner = -1;
  };

  void takeCorners(const Dent& dent);
  void halveEdges(const Dent& dent);
  [[nodiscard]] Middle& entryOf(int low, int high);
  [[nodiscard]] int middleOf(int a, int b, const Dent& dent);
  [[nodiscard]] bool rests(int corner, const Dent& dent) const noexcept;
  void displace(const Dent& dent);
  void turnNormals();

  std::vector<Corner> corners_;
  std::vector<Triangle> coarse_;
  std::vector<Eigen::Vector3f> normalsAtRest_; // of the triangles, not smoothed
  std::vector<Middle> middles_;                // of edges, a hash table with room for all
};

} // namespace palp
