#pragma once

#include "pipeline/dent.h"

#include <array>
#include <cstdint>
#include <unordered_map>
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
  std::vector<float> distance;          ///< from the contact's centre along the surface at rest [m]
  std::vector<Zone> zone;
  std::vector<Triangle> triangles;

private:
  // a point at rest
  struct Corner
  {
    Eigen::Vector3d rest;
    Eigen::Vector3f normal;
    Place place;
  };

  void takeCorners(const Dent& dent);
  void halveEdges(const Dent& dent);
  [[nodiscard]] int middleOf(int a, int b, const Dent& dent);
  [[nodiscard]] bool rests(int corner, const Dent& dent) const noexcept;
  void displace(const Dent& dent);
  void turnNormals();

  std::vector<Corner> corners_;
  std::vector<Triangle> coarse_;
  std::unordered_map<std::uint64_t, int> middles_; // of edges by their ends
};

} // namespace palp
