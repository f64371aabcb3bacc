#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

/// The edges of a surface that are sharp, and how far a place is from them.
class SharpEdges
{
public:
  using Segment = std::array<Eigen::Vector3f, 2>; ///< its ends [m]

  SharpEdges() = default;
  explicit SharpEdges(std::vector<Segment> segments);

  /// To the nearest of them, at a cost that grows with the logarithm of their number.
  ///
  /// @param position  [m], in the frame of the segments
  /// @return          [m]; infinite where there is none
  /// @realtime        pure; no allocation, no lock, no exception
  [[nodiscard]] float distance(const Eigen::Vector3f& position) const noexcept;

private:
  // a ball about some of them
  struct Node
  {
    Eigen::Vector3f center; // [m]
    float radius;           // [m]
    std::int32_t right;     // right child, the left one follows; 0: a leaf
    Segment segment;        // of a leaf
  };

  void build(std::span<Segment> segments);

  std::vector<Node> nodes_; // depth first
};

} // namespace palp
