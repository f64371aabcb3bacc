#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>

namespace palp::test
{

/// A surface as an OBJ file.
/// @param scale  from the points to what is written, along each axis; else from m to mm
/// @param head   what stands above
inline void writeObj(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles,
  const Eigen::Vector3d& scale = Eigen::Vector3d::Constant(1e3), std::string_view head = "")
{
  std::ofstream out(file);
  out << head;
  for (const Eigen::Vector3d& point : points)
  {
    out << "v " << point.cwiseProduct(scale).transpose() << '\n';
  }
  for (const auto& [a, b, c] : triangles)
  {
    out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
}

} // namespace palp::test
