#pragma once

#include "tests/support/process.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sstream>
#include <string>

namespace palp::test
{

template <typename... Parts>
std::string words(const Parts&... parts)
{
  std::ostringstream text;
  text.precision(10);
  (text << ... << parts);
  return text.str();
}

struct DicomGrid
{
  int columns;
  int rows;
  int slices;
  Eigen::Vector3d first; // [mm]
  Eigen::Vector3d alongRow;
  Eigen::Vector3d alongColumn;
  double columnSpacing;
  double rowSpacing;
  double step; // along the normal, negative: the files go the other way [mm]
};

// stored as CT is: of 12 bits, from -1024 on, 20 HU a mm into the ball
inline constexpr double kDicomIntercept = -1024.0;
inline constexpr double kDicomRadius = 12.0; // [mm]
inline constexpr double kDicomLevel = 100.0; // on the ball [HU]

struct DicomHeader
{
  std::string series = "1.2.3.1";
  std::string description = "abdomen";
  std::string extra{}; // lines for every file
  std::optional<int> without{};
  std::string photometric = "MONOCHROME2";
  double drift = 0.0; // by which each step of the second half is larger [mm]
  double lean = 0.0;  // by which each slice is farther along the columns than the one before [mm]
};

inline std::string dicomHeader(
  const DicomGrid& grid, const Eigen::Vector3d& corner, int k, const DicomHeader& header)
{
  const auto row = [](const Eigen::Vector3d& v) { return words(v.x(), '\\', v.y(), '\\', v.z()); };
  return words("(0008,0016) UI [1.2.840.10008.5.1.4.1.1.2]\n(0008,0018) UI [", header.series, '.',
    k + 1, "]\n(0008,0060) CS [CT]\n(0008,103e) LO [", header.description,
    "]\n(0020,000d) UI [1.2.3]\n(0020,000e) UI [", header.series, "]\n(0020,0011) IS [",
    header.series.back(), "]\n(0020,0013) IS [", k + 1, "]\n(0020,0032) DS [", row(corner),
    "]\n(0020,0037) DS [", row(grid.alongRow), '\\', row(grid.alongColumn),
    "]\n(0028,0002) US 1\n(0028,0004) CS [", header.photometric, "]\n(0028,0010) US ", grid.rows,
    "\n(0028,0011) US ", grid.columns, "\n(0028,0030) DS [", grid.rowSpacing, '\\',
    grid.columnSpacing, "]\n(0028,0100) US 16\n(0028,0101) US 12\n(0028,0102) US 11\n",
    "(0028,0103) US 0\n(0028,1052) DS [", kDicomIntercept, "]\n(0028,1053) DS [1]\n", header.extra);
}

/// Writes a series of images of a ball in the middle of a grid, by the programs of DCMTK.
///
/// @param made     folder for what they read
/// @param options  of dump2dcm, or a program of its own that compresses
/// @return         middle of the ball [m]
inline Eigen::Vector3d writeDicom(const std::filesystem::path& made, const std::string& name,
  const DicomGrid& grid, const std::string& options, const DicomHeader& header = {})
{
  const std::filesystem::path folder = made / name;
  std::filesystem::create_directories(folder);
  const Eigen::Vector3d normal = grid.alongRow.cross(grid.alongColumn);
  const Eigen::Vector3d middle = grid.first +
    0.5 * (grid.columns - 1) * grid.columnSpacing * grid.alongRow +
    0.5 * (grid.rows - 1) * grid.rowSpacing * grid.alongColumn +
    0.5 * (grid.slices - 1) * grid.step * normal;
  std::string calls;
  for (int k = 0; k < grid.slices; ++k)
  {
    if (header.without == k)
    {
      continue;
    }
    const double drift = header.drift * std::max(0, k - grid.slices / 2);
    const Eigen::Vector3d corner =
      grid.first + (k * grid.step + drift) * normal + k * header.lean * grid.alongColumn;
    std::string voxels;
    for (int j = 0; j < grid.rows; ++j)
    {
      for (int i = 0; i < grid.columns; ++i)
      {
        const Eigen::Vector3d p =
          corner + i * grid.columnSpacing * grid.alongRow + j * grid.rowSpacing * grid.alongColumn;
        const double value =
          kDicomLevel + 20.0 * (kDicomRadius - (p - middle).norm()) - kDicomIntercept;
        const auto stored = static_cast<int>(std::lround(std::clamp(value, 0.0, 4095.0)));
        voxels += static_cast<char>(stored & 255);
        voxels += static_cast<char>(stored >> 8);
      }
    }
    const std::string file =
      words(name, header.series.back(), '_', (7 * k + 3) % 101); // in no order
    const std::string source = (made / file).string();
    const std::string image = (folder / (file + ".dcm")).string();
    std::ofstream(source + ".raw", std::ios::binary) << voxels;
    std::ofstream(source + ".txt")
      << dicomHeader(grid, corner, k, header) << "(7fe0,0010) OW =" + source + ".raw\n";
    const bool packs = options.starts_with("dcm");
    calls += words("dump2dcm -q ", packs ? "" : options, ' ', source, ".txt ", image, " && ");
    calls += packs ? words(options, ' ', image, ' ', image, " && ") : "";
  }
  EXPECT_EQ(runCommand(calls + "true").code, 0) << calls;
  return 1e-3 * middle;
}

} // namespace palp::test
