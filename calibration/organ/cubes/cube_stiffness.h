#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace palp
{

using CubeStiffness = Eigen::Matrix<double, 24, 24>; ///< [N/m], x, y and z of corner after corner

/// Corner of a cube: bit 0 of its number is x, bit 1 y, bit 2 z.
constexpr int kCubeCorners = 8;

constexpr int kCubeParts = 4; ///< parts along a side of a cube of which it is known what is inside

/// What of these parts is inside a body, x fastest, then y and z.
struct CubePoints
{
  static constexpr std::size_t kCount = std::size_t{ kCubeParts } * kCubeParts * kCubeParts;

  std::array<float, kCount> part{};             ///< of each, 0 to 1
  std::array<Eigen::Vector3f, kCount> middle{}; ///< of what is inside, in sides of the cube

  /// Takes all of one of them.
  void set(std::size_t i);

  [[nodiscard]] static constexpr std::size_t size() noexcept
  {
    return kCount;
  }

  /// Whether any of one is inside.
  [[nodiscard]] bool operator[](std::size_t i) const noexcept
  {
    return part[i] > 0.0F;
  }

  /// How many have something inside.
  [[nodiscard]] std::size_t count() const noexcept;

  /// Whether the cube is inside but for rounding.
  [[nodiscard]] bool all() const noexcept
  {
    return filled() > kWhole;
  }

  /// Part of the cube that is inside, 0 to 1.
  [[nodiscard]] double filled() const noexcept;

private:
  static constexpr double kWhole = 1.0 - 1e-6;
};

/// Stiffness of a cube of eight nodes whose dilatation is the mean of the cube, so that it does not
/// lock where nu comes near 1/2.
///
/// @param side           [m]
/// @param youngModulus   [Pa]
/// @param poissonRatio   0 to below 0.5 [-]
/// @source               Hughes, "Generalization of selective integration procedures", 1980 (B-bar)
[[nodiscard]] CubeStiffness cubeStiffness(double side, double youngModulus, double poissonRatio);

/// The same of the part of a cube that is inside: finite cells.
///
/// @param inside  more than nothing
/// @source        Parvizian, Duester and Rank, Computational Mechanics 41, 2007
[[nodiscard]] CubeStiffness cutCubeStiffness(
  double side, double youngModulus, double poissonRatio, const CubePoints& inside);

} // namespace palp
