#pragma once

#include "haptics/surface/local_shape.h"
#include "haptics/surface/sharp_edges.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

class BoxTree;
struct Creases; // haptics/surface/facet_part.h
struct LinkedTriangles;

/// Curvature and thickness of a surface, averaged over any ball, and its sharp edges.
///
/// The surface is cut into cells of about a hundredth of its size, gathered in a tree of sums. An
/// average weighs the cells by their area across a normal and by a smooth function of their
/// distance, so that it changes continuously with the ball whatever the mesh, at a cost that does
/// not grow with it.
///
/// The curvature is that of the edges of the mesh: each turns the normal by its dihedral angle,
/// across itself; among triangles smaller than the least ball it is evened out over neighbors. So a
/// face is flat however it is cut, and a hollow counts by what is in contact.
///
/// @source curvature of edges: Cohen-Steiner and Morvan, "Restricted Delaunay triangulations and
///         normal cycle", SoCG 2003
class ShapeField
{
public:
  ShapeField() = default;

  /// @param tree  over the triangles of the mesh
  ShapeField(const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases);

  /// Averages over the part of the surface in a ball that faces along a normal.
  ///
  /// @param center  of the ball [m]
  /// @param radius  of the ball [m]
  /// @param normal  unit vector
  /// @param grain   radius of the sums that may be taken as one [m]; constant for a tool
  /// @param of      what counts as curvature
  /// @return        flat and without end where the ball holds nothing
  /// @realtime      pure; no allocation, no lock, no exception
  [[nodiscard]] LocalShape operator()(const Eigen::Vector3d& center, double radius,
    const Eigen::Vector3d& normal, double grain, CurvatureOf of = CurvatureOf::All) const noexcept;

  /// Distance to the nearest sharp edge, where the surface turns by 55 degrees within a few cells
  /// or has a crease; infinite where there is none [m].
  ///
  /// @param position  [m]
  /// @realtime        pure; no allocation, no lock, no exception
  [[nodiscard]] double edgeDistance(const Eigen::Vector3d& position) const noexcept
  {
    return std::min(sharpEdgeDistance(position),
      static_cast<double>(creases_.distance((position - origin_).cast<float>())));
  }

  /// The same without creases that turn less, and without valleys.
  [[nodiscard]] double sharpEdgeDistance(const Eigen::Vector3d& position) const noexcept
  {
    return static_cast<double>(edges_.distance((position - origin_).cast<float>()));
  }

  /// Smallest radius over which an average is smooth [m].
  [[nodiscard]] double finest() const noexcept
  {
    return finest_;
  }

private:
  // one part of the surface, and whether it is looked into
  struct Node
  {
    Eigen::Vector3f center = Eigen::Vector3f::Zero(); // from the origin [m]
    float radius = 0.0F;    // of the ball about the center that holds all [m]
    float grain = 0.0F;     // from which on the sums stand for the part; infinite: two sides [m]
    std::int32_t right = 0; // right child, the left one follows; 0: a leaf
  };

  // that two triangles have in common, or a part of it
  struct Side
  {
    SharpEdges::Segment ends; // from the origin [m]
    float turn;               // of the surface, half of it each, convex positive [rad]
    bool isCrease;
  };

  // of the surface, smaller than a cell
  struct Piece
  {
    ShapePart sums;
    std::array<int, 2> sides{}; // the first of them, and the one behind the last
  };

  struct Pieces
  {
    std::vector<Piece> all{};
    std::vector<Side> sides{};
  };

  // a piece waiting for its place in the tree
  struct Entry
  {
    Eigen::Array<float, 6, 1> coordinates; // of its center, from the origin, and its normal [m]
    float area;                            // [m^2]
    int piece;
  };

  using Leaves = std::vector<std::span<const Entry>>; // of each node, empty where it is no leaf

  template <typename Visit>
  void search(
    const Eigen::Vector3d& center, double radius, double grain, Visit visit) const noexcept;
  void cutUp(const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases,
    Pieces& pieces, std::vector<Entry>& entries) const;
  Eigen::Vector4f build(std::span<Entry> entries, const Pieces& pieces, Leaves& leaves);
  void measureLeaves(const BoxTree& tree, std::span<const float> hollows, const Pieces& pieces,
    const Leaves& leaves);
  static bool addTurning(std::span<const Side> sides, float least,
    std::vector<SharpEdges::Segment>& sharp, std::vector<SharpEdges::Segment>& creases);
  void addUp();

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Node> nodes_;     // depth first
  std::vector<ShapePart> sums_; // of the same parts
  SharpEdges edges_;            // from the origin
  SharpEdges creases_;          // others, likewise
  double cell_ = 0.0;           // longest side of a leaf [m]
  double finest_ = 0.0;
};

} // namespace palp
