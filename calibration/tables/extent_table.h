#pragma once

#include <filesystem>
#include <vector>

namespace palp
{

/// R_d(depth): radius of the deformed region, calibrated off line by finite elements.
///
/// The radius at which the surface sinks by the table's threshold (0.5 mm in the paper);
/// 0 where nothing sinks that far.
///
/// @source Sec. 3.3.2, Fig. 8
class ExtentTable
{
public:
  /// Columns of a file.
  static constexpr const char* kHeader = "depth_mm,extent_radius_mm,force_N,contact_radius_mm";

  struct Extent
  {
    double depth;         ///< delta [m]
    double extentRadius;  ///< R_d [m]
    double force;         ///< of the finite elements [N], or 0
    double contactRadius; ///< of the finite elements [m], or 0
  };

  /// Reads the columns of kHeader; lines that begin with # are comments.
  /// @throws Error  BadFile: missing, another header, fewer than two rows, depths not increasing
  [[nodiscard]] static ExtentTable read(const std::filesystem::path& file);

  /// @param rows    at least two, depths increasing
  /// @throws Error  BadValue
  explicit ExtentTable(std::vector<Extent> rows);

  /// @param depth  delta [m]; below the first row the line to (0, 0), beyond the last its value
  /// @return       R_d [m]
  [[nodiscard]] double extentRadius(double depth) const noexcept;

  [[nodiscard]] const std::vector<Extent>& rows() const noexcept
  {
    return rows_;
  }

private:
  std::vector<Extent> rows_;
};

} // namespace palp
