#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>

// Label maps of two balls, written as the formats' definitions lay them out.

namespace palp::test
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

// where voxels lie, in the patient's axes to left, back and head [mm]
struct Grid
{
  Vector3i size{ 44, 40, 36 };
  Vector3d side{ 1.5, 2.0, 2.5 };
  Matrix3d axes = Matrix3d::Identity(); // a column for each index
  Vector3d origin = Vector3d::Zero();

  [[nodiscard]] Vector3d at(const Vector3d& index) const
  {
    return origin + axes * index.cwiseProduct(side);
  }
};

// balls of 20 and 13 mm, the one within the other
struct Balls
{
  explicit Balls(const Grid& grid)
    : centers{ grid.at(0.5 * (grid.size - Vector3i::Ones()).cast<double>()), {} }
  {
    centers[1] = centers[0] + Vector3d(4.0, -3.5, 2.0);
  }

  [[nodiscard]] bool isIn(std::size_t ball, const Vector3d& place) const
  {
    return (place - centers[ball]).norm() < radii[ball];
  }

  std::array<Vector3d, 2> centers;
  std::array<double, 2> radii{ 20.0, 13.0 };
};

inline Matrix3d oblique()
{
  return Eigen::AngleAxisd(0.6, Vector3d(2.0, -1.0, 0.7).normalized()).matrix();
}

inline Matrix3d signs(double x, double y, double z)
{
  return Vector3d(x, y, z).asDiagonal();
}

// calls use(label of the voxel), x fastest: 2 in the small ball, 1 in the rest of the other
inline void eachVoxel(const Grid& grid, const std::function<void(const Vector3d&)>& use)
{
  for (int z = 0; z < grid.size.z(); ++z)
  {
    for (int y = 0; y < grid.size.y(); ++y)
    {
      for (int x = 0; x < grid.size.x(); ++x)
      {
        use(grid.at(Vector3d(x, y, z)));
      }
    }
  }
}

template <typename Voxel>
std::string voxelsOf(const Grid& grid, bool isBigEndian = false)
{
  const Balls balls(grid);
  std::string bytes;
  eachVoxel(grid,
    [&](const Vector3d& place)
    {
      const auto label =
        static_cast<Voxel>(balls.isIn(1, place) ? 2 : (balls.isIn(0, place) ? 1 : 0));
      std::array<char, sizeof label> one{};
      std::memcpy(one.data(), &label, sizeof label);
      isBigEndian ? std::ranges::reverse(one) : one.begin();
      bytes.append(one.data(), one.size());
    });
  return bytes;
}

// both balls whole, a byte for each layer
inline std::string layersOf(const Grid& grid)
{
  const Balls balls(grid);
  std::string bytes;
  eachVoxel(grid,
    [&](const Vector3d& place)
    {
      bytes += balls.isIn(0, place) ? '\1' : '\0';
      bytes += balls.isIn(1, place) ? '\1' : '\0';
    });
  return bytes;
}

inline std::string words(const auto& numbers, const char* between)
{
  std::ostringstream text;
  text.precision(17);
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
  {
    text << (i > 0 ? between : "") << numbers(i);
  }
  return text.str();
}

// nifti1.h; forms lead to right, front and head
inline std::string nifti(const Grid& grid, short type, short bits, const std::string& voxels,
  bool isBigEndian, bool hasQuaternion)
{
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, auto value)
  {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    if (isBigEndian)
    {
      std::reverse(bytes.data() + at, bytes.data() + at + sizeof value);
    }
  };
  const Matrix3d toRas = signs(-1, -1, 1);
  const Vector3d origin = toRas * grid.origin;
  Matrix3d axes = toRas * grid.axes;
  put(0, std::int32_t{ 348 });
  put(40, short{ 3 });
  put(70, type);
  put(72, bits);
  const double handed = axes.determinant();
  put(76, static_cast<float>(handed));
  put(108, 352.0F);
  put(112, 1.0F);
  bytes[123] = 2; // mm
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto i = static_cast<Eigen::Index>(k);
    put(42 + 2 * k, static_cast<short>(grid.size[i]));
    put(80 + 4 * k, static_cast<float>(grid.side[i]));
    for (std::size_t column = 0; column < 3 && !hasQuaternion; ++column)
    {
      const auto c = static_cast<Eigen::Index>(column);
      put(280 + 16 * k + 4 * column, static_cast<float>(axes(i, c) * grid.side[c]));
    }
    put(268 + 4 * k, static_cast<float>(origin[i]));
    hasQuaternion ? void() : put(292 + 16 * k, static_cast<float>(origin[i]));
  }
  put(hasQuaternion ? 252 : 254, short{ 1 });
  if (hasQuaternion)
  {
    axes.col(2) *= handed; // a rotation
    const Eigen::Quaterniond turn(axes);
    const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
    put(256, static_cast<float>(sign * turn.x()));
    put(260, static_cast<float>(sign * turn.y()));
    put(264, static_cast<float>(sign * turn.z()));
  }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  return bytes + voxels;
}

inline std::string meta(const Grid& grid, const std::string& type, bool isBigEndian,
  const std::string& voxels, const std::string& file)
{
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = " +
    std::string(isBigEndian ? "True" : "False") +
    "\nTransformMatrix = " + words(grid.axes.reshaped(), " ") +
    "\nOffset = " + words(grid.origin, " ") + "\nElementSpacing = " + words(grid.side, " ") +
    "\nDimSize = " + words(grid.size, " ") + "\nElementType = " + type +
    "\nElementDataFile = " + file + "\n" + voxels;
}

// teem's definition; vectors in the axes that space names
inline std::string nrrd(const Grid& grid, const std::string& space, const Matrix3d& fromLps,
  const std::string& more, const std::string& voxels)
{
  const bool isLayered = more.find("Layer") != more.npos;
  std::string text = "NRRD0005\ndimension: " + std::string(isLayered ? "4" : "3") +
    "\nspace: " + space + "\nsizes: " + (isLayered ? "2 " : "") + words(grid.size, " ") +
    "\nspace directions:" + (isLayered ? " none" : "");
  for (int k = 0; k < 3; ++k)
  {
    text += " (" + words((fromLps * grid.axes.col(k) * grid.side[k]).eval(), ",") + ")";
  }
  return text + "\nspace origin: (" + words((fromLps * grid.origin).eval(), ",") + ")\n" + more +
    "\n\n" + voxels;
}

} // namespace palp::test
