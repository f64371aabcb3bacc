#include "app/supports/support_parts.h"

#include "calibration/organ/surface_parts.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/number_table.h"
#include "haptics/files/replace_file.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/closest_point.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace palp
{
namespace
{

using namespace units::literals;

// as fine as a hand paints, and so coarse that a liver's back is some thousands of them
double sizeOf(const Surface& surface)
{
  constexpr double kMost = 3.0_mm;
  constexpr double kAlongBody = 60.0;
  return std::min(kMost, boxAbout(surface.points()).diagonal().norm() / kAlongBody);
}

} // namespace

SupportParts::SupportParts(const Surface& surface)
  : surface_(surface)
  , size_(sizeOf(surface))
{
  begins_.reserve(surface.triangles().size() + 1);
  for (const auto& [a, b, c] : surface.triangles())
  {
    begins_.push_back(parts_.size());
    forPieces({ surface.points()[at(a)], surface.points()[at(b)], surface.points()[at(c)] },
      Eigen::Vector3d::Zero(), size_, 0.0,
      [this](const std::array<Eigen::Vector3d, 3>& corners)
      {
        const auto& [p, q, r] = corners;
        parts_.push_back({ corners, (p + q + r) / 3.0, 0.5 * (q - p).cross(r - p) });
      });
  }
  begins_.push_back(parts_.size());
}

SupportParts::Nearest SupportParts::nearest(const Eigen::Vector3d& place) const
{
  const ClosestPoint closest =
    findClosestPoint(surface_, place, std::numeric_limits<double>::infinity());
  const auto triangle = at(closest.triangle);
  const auto first = parts_.begin() + static_cast<std::ptrdiff_t>(begins_[triangle]);
  const auto last = parts_.begin() + static_cast<std::ptrdiff_t>(begins_[triangle + 1]);
  const auto found = std::min_element(first, last,
    [&closest](const Part& one, const Part& other)
    {
      return (one.middle - closest.point).squaredNorm() <
        (other.middle - closest.point).squaredNorm();
    });
  return { static_cast<std::size_t>(found - parts_.begin()), std::abs(closest.distance) };
}

std::vector<std::size_t> SupportParts::below(const SurfacePoint& brush, double radius) const
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < parts_.size(); ++i)
  {
    const bool isNear = (parts_[i].middle - brush.position).squaredNorm() <= radius * radius;
    if (isNear && parts_[i].area.dot(brush.normal) > 0.0)
    {
      found.push_back(i);
    }
  }
  return found;
}

std::vector<bool> readHeldParts(const SupportParts& parts, const std::filesystem::path& file)
{
  constexpr std::array kColumns{ "x_mm", "y_mm", "z_mm" };
  const NumberTable table = NumberTable::readColumns(file, kColumns);
  if (table.rows.empty())
  {
    throw Error(ErrorCode::BadFile,
      printable(file.string()) + ": holds no point of a support; give one a line, x,y,z in mm");
  }
  std::vector<bool> held(parts.all().size());
  for (const auto& [values, line] : table.rows)
  {
    const Eigen::Vector3d place =
      units::fromMillimeters(1.0) * Eigen::Vector3d(values[0], values[1], values[2]);
    const auto [part, distance] = parts.nearest(place);
    if (distance > parts.size())
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + "the point is " + units::inMillimeters(distance) +
          " away from the surface; give points on it, in mm and in the frame of its file");
    }
    held[part] = true;
  }
  return held;
}

void writeHeldPoints(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
  const std::string& kind)
{
  std::ostringstream out;
  out << "# palp support: " << kind << ", points on the surface in the frame of its file\n"
      << "x_mm,y_mm,z_mm\n";
  for (const Eigen::Vector3d& point : points)
  {
    constexpr double kRounded = 100.0; // to a hundredth of a millimeter
    std::array<double, 3> row{};
    std::ranges::transform(point, row.begin(),
      [](double value) { return std::round(kRounded * units::toMillimeters(value)) / kRounded; });
    writeCsvRow(out, row);
  }
  replaceFile(file, out.str());
}

} // namespace palp
