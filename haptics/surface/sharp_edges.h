#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palp
{

/// The edges of a surface that are sharp, how far a place is from them, and how sharp they are.
class SharpEdges
{
public:
  struct Segment
  {
    std::array<Eigen::Vector3f, 2> ends; ///< [m]
    float turn;                          ///< of the surface there, convex positive [rad]
  };

  struct Nearest
  {
    float distance = std::numeric_limits<float>::infinity(); ///< [m]
    float turn = 0.0F;                                       ///< as of the segment [rad]
  };

  SharpEdges() = default;
  explicit SharpEdges(std::vector<Segment> segments);

  /// The nearest of them, at a cost that grows with the logarithm of their number.
  ///
  /// @param position  [m], in the frame of the segments
  /// @param turn      that it has at least [rad]
  /// @return          infinitely far where there is none
  /// @realtime        pure; no allocation, no lock, no exception
  [[nodiscard]] Nearest nearest(const Eigen::Vector3f& position, float turn = 0.0F) const noexcept;

private:
  // a ball about some of them
  struct Node
  {
    Eigen::Vector3f center; // [m]
    float radius;           // [m]
    float turn;             // the most of them [rad]
    std::int32_t right;     // right child, the left one follows; 0: a leaf
    Segment segment;        // of a leaf
  };

  void build(std::span<Segment> segments);

  std::vector<Node> nodes_; // depth first
};

} // namespace palp
