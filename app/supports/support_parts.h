#pragma once

#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// A surface in parts of a few millimeters, each of which is held or not: what a brush paints, and
/// what a file of points tells.
class SupportParts
{
public:
  /// @param surface  lives as long as this
  explicit SupportParts(const Surface& surface);

  struct Part
  {
    std::array<Eigen::Vector3d, 3> corners; ///< [m]
    Eigen::Vector3d middle;                 ///< [m]
    Eigen::Vector3d area;                   ///< along the outward normal [m^2]
  };
  [[nodiscard]] const std::vector<Part>& all() const noexcept
  {
    return parts_;
  }

  /// No edge of a part is longer [m].
  [[nodiscard]] double size() const noexcept
  {
    return size_;
  }

  /// The part of the surface that a place is nearest to.
  struct Nearest
  {
    std::size_t part = 0;
    double distance = 0.0; ///< of the place from the surface [m]
  };
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& place) const;

  /// What a brush covers: those within a radius that face like its middle, so that no thin lobe is
  /// painted through [m].
  [[nodiscard]] std::vector<std::size_t> below(const SurfacePoint& brush, double radius) const;

private:
  const Surface& surface_;
  double size_;
  std::vector<Part> parts_;         // triangle by triangle
  std::vector<std::size_t> begins_; // where those of each begin, and the end
};

/// Reads which parts a file of points holds, `x_mm,y_mm,z_mm` in the frame of the surface: each of
/// them the part that it is nearest to.
///
/// @return        of each part whether it is held
/// @throws Error  BadFile: missing, empty, not a number, a point away from the surface; names it
[[nodiscard]] std::vector<bool> readHeldParts(
  const SupportParts& parts, const std::filesystem::path& file);

/// Writes the file that reads as these again.
/// @param points  middles of the parts, in the frame of the surface's file [m]
/// @param kind    for people
/// @throws Error  BadFile: cannot be written
void writeHeldPoints(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
  const std::string& kind);

} // namespace palp
