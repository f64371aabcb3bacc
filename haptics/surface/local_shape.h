#pragma once

#include <Eigen/Core>
#include <limits>

namespace palp
{

/// What a force law asks of the surface that a tool presses, averaged over a ball.
struct LocalShape
{
  /// How one of them changes.
  struct Slope
  {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< with the center of the ball
    double radius = 0.0;                              ///< with its radius
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< with the normal, across it
  };

  double meanCurvature = 0.0;                                 ///< [1/m], convex positive
  double curvatureSpread = 0.0;                               ///< half the difference [1/m]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body, hollows filled [m]
  double hollow = 0.0; ///< part of it below which a hollow or a gap lets the wall bend [-]
  Slope meanCurvatureSlope{};
  Slope curvatureSpreadSlope{};
  Slope thicknessSlope{};
};

/// One part of a surface, or the sums of several.
struct ShapePart
{
  Eigen::Vector3f area = Eigen::Vector3f::Zero(); ///< along the outward normal [m^2]
  Eigen::Matrix3f bend = Eigen::Matrix3f::Zero(); ///< area times the tensor of curvature [m]
  float slenderness = 0.0F;                       ///< area over the root of the thickness [m^1.5]
  float hollow = 0.0F;                            ///< area above a hollow [m^2]
  bool isSharp = false;                           ///< it holds a sharp edge, or a part does

  /// Without what turns at a sharp edge.
  [[nodiscard]] ShapePart ofFaces() const noexcept
  {
    return isSharp ? ShapePart{ area, Eigen::Matrix3f::Zero(), slenderness, hollow, true } : *this;
  }
};

/// What counts as the curvature of a surface.
enum class CurvatureOf
{
  All,   ///< sharp edges too, which let a body give way as if it were round
  Faces, ///< not they, where something else tells how the body gives way at them
};

/// The average over the parts in a ball that face along a normal, each by its area across it.
/// @realtime  pure; no allocation, no lock, no exception
class ShapeAverage
{
public:
  /// @param radius  of the ball [m]
  ShapeAverage(const Eigen::Vector3d& normal, double radius) noexcept;

  /// @param root    root of the weight, 1 - (distance / radius)^2
  /// @param offset  of the part from the center [m]
  void add(const ShapePart& part, float root, const Eigen::Vector3f& offset) noexcept;

  /// Flat and without end where there was none.
  [[nodiscard]] LocalShape shape() const noexcept;

private:
  [[nodiscard]] double mean(Eigen::Index of) const noexcept;
  [[nodiscard]] LocalShape::Slope slope(
    Eigen::Index of, const Eigen::Vector2d& turning) const noexcept;

  double radius_;
  Eigen::Vector3f normal_;
  Eigen::Vector3f u_; // across it
  Eigen::Vector3f v_;
  // columns: area, mean curvature, its differences along and between u and v, slenderness; rows:
  // the sum, its slopes over the place, the radius and the normal along u and v, and one for the
  // processor, which adds four at a time
  Eigen::Matrix<float, 8, 5> sums_ = Eigen::Matrix<float, 8, 5>::Zero();
  Eigen::Vector2f lean_ = Eigen::Vector2f::Zero(); // of the tensor, from u and v to the normal
  float hollow_ = 0.0F;
};

} // namespace palp
