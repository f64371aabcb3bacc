#pragma once

#include "haptics/contact/overlap/tool_solid.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace palp
{

/// What bounds one side of a piece of a triangle.
enum class Bound : std::int8_t
{
  Own = 0, ///< and the two after it: which of its sides
  Bottom = 3,
  Top = 4,
  Side = 5 ///< and those after it
};

/// As a piece keeps it.
constexpr std::int8_t codeOf(Bound bound, std::size_t k = 0) noexcept
{
  return static_cast<std::int8_t>(static_cast<std::size_t>(bound) + k);
}

/// A convex piece of a triangle; edge i goes from corner i to the next.
class Piece
{
public:
  explicit Piece(const std::array<Eigen::Vector3d, 3>& corners) noexcept
    : count_(3)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners_[k] = corners[k];
      bounds_[k] = codeOf(Bound::Own, k);
    }
  }

  [[nodiscard]] std::size_t size() const noexcept
  {
    return count_;
  }
  [[nodiscard]] const Eigen::Vector3d& operator[](std::size_t k) const noexcept
  {
    return corners_[k];
  }
  [[nodiscard]] std::size_t after(std::size_t k) const noexcept
  {
    return k + 1 < count_ ? k + 1 : 0;
  }
  [[nodiscard]] std::int8_t bound(std::size_t k) const noexcept
  {
    return bounds_[k];
  }

  void clear() noexcept
  {
    count_ = 0;
  }

  /// Cuts off what is beyond a plane.
  /// @param over  of a corner, how far it is beyond the plane that cuts
  template <typename Over>
  void clip(Over over, std::int8_t bound) noexcept
  {
    std::array<double, kMost> beyond;
    bool isWhole = true;
    for (std::size_t k = 0; k < count_; ++k)
    {
      beyond[k] = over(corners_[k]);
      isWhole = isWhole && beyond[k] <= 0.0;
    }
    if (isWhole)
    {
      return;
    }
    Piece rest;
    for (std::size_t k = 0; k < count_; ++k)
    {
      const std::size_t next = after(k);
      const bool isIn = beyond[k] <= 0.0;
      if (isIn)
      {
        rest.put(corners_[k], bounds_[k]);
      }
      if (isIn != (beyond[next] <= 0.0))
      {
        const double part = beyond[k] / (beyond[k] - beyond[next]);
        rest.put(corners_[k] + part * (corners_[next] - corners_[k]), isIn ? bound : bounds_[k]);
      }
    }
    count_ = rest.count_;
    std::copy_n(rest.corners_.data(), count_, corners_.data());
    std::copy_n(rest.bounds_.data(), count_, bounds_.data());
  }

private:
  static constexpr std::size_t kMost = 40; // corners: three, and one more by each plane

  Piece() noexcept // NOLINT: nothing is read that was not set
  {
  }

  void put(const Eigen::Vector3d& corner, std::int8_t bound) noexcept
  {
    if (count_ < kMost) // where rounding makes a piece that is not convex
    {
      corners_[count_] = corner;
      bounds_[count_++] = bound;
    }
  }

  std::array<Eigen::Vector3d, kMost> corners_;
  std::array<std::int8_t, kMost> bounds_;
  std::size_t count_ = 0;
};

/// Leaves of a triangle what is in a layer of a tool.
/// @realtime  pure; no allocation, no lock, no exception
void clipTo(const ToolSolid::Layer& layer, Piece& piece) noexcept;

} // namespace palp
