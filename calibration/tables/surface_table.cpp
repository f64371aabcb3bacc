#include "calibration/tables/surface_table.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/number_table.h"
#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/roots.h"

#include <algorithm>

namespace palp
{
namespace
{

// a surface through its values at the radii of a table
class SinkCurve
{
public:
  explicit SinkCurve(const std::array<double, SurfaceTable::kRadii.size()>& sinks)
    : sinks_(sinks)
    , slopes_(monotoneSlopes(SurfaceTable::kRadii, sinks_))
  {
  }

  // x: distance from the axis over the tip's radius
  [[nodiscard]] double at(double x) const
  {
    if (!(x >= 0.0) || x > SurfaceTable::kRadii.back())
    {
      return 0.0;
    }
    return cubicAt(SurfaceTable::kRadii, sinks_, slopes_, x).value;
  }

private:
  std::array<double, SurfaceTable::kRadii.size()> sinks_;
  std::vector<double> slopes_;
};

} // namespace

std::string SurfaceTable::header()
{
  std::string columns = "depth_over_radius,radius_over_thickness,poisson_ratio";
  for (const double radius : kRadii)
  {
    columns += ",sink_at_" + shortest(radius);
  }
  return columns;
}

SurfaceTable SurfaceTable::read(const std::filesystem::path& file)
{
  const auto lines = NumberTable::readFinite(file, header()).rows;
  SurfaceTable table;
  for (std::size_t a = 0; a < 3; ++a)
  {
    auto& axis = table.axes_[a];
    for (const auto& line : lines)
    {
      axis.push_back(line.values[2 - a]);
    }
    std::sort(axis.begin(), axis.end());
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
  }
  const auto& [poisson, shape, depth] = table.axes_;
  const std::size_t size = poisson.size() * shape.size() * depth.size();
  if (poisson.size() < 2 || shape.size() < 2 || depth.size() < 2 || lines.size() != size)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not every combination of depth, thickness and nu; make the tables again");
  }
  table.rows_.resize(size);
  std::vector<char> seen(size, 0);
  for (const auto& [values, line] : lines)
  {
    std::size_t at = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto& axis = table.axes_[a];
      const auto found = std::lower_bound(axis.begin(), axis.end(), values[2 - a]);
      at = at * axis.size() + static_cast<std::size_t>(found - axis.begin());
    }
    if (seen[at] != 0)
    {
      throw Error(ErrorCode::BadFile, where(file, line) + "given twice; give each row once");
    }
    seen[at] = 1;
    std::copy(values.begin() + 3, values.end(), table.rows_[at].begin());
  }
  return table;
}

SurfaceTable::Sinks SurfaceTable::sinksAt(const Indentation& indentation) const
{
  const double depth = indentation.depth / indentation.tipRadius;
  const auto n = bracket(axes_[0], indentation.poissonRatio);
  const auto h = bracket(axes_[1], indentation.tipRadius / indentation.thickness);
  const auto d = bracket(axes_[2], depth);
  Sinks sum{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const auto pick = [corner](int bit, const Bracket& b)
    {
      const bool upper = (corner >> bit & 1) != 0;
      return std::pair{ b.low + (upper ? 1 : 0), upper ? b.fraction : 1.0 - b.fraction };
    };
    const auto [i, wi] = pick(0, n);
    const auto [j, wj] = pick(1, h);
    const auto [k, wk] = pick(2, d);
    const Sinks& sinks = rows_[(i * axes_[1].size() + j) * axes_[2].size() + k];
    for (std::size_t r = 0; r < sum.size(); ++r)
    {
      sum[r] += wi * wj * wk * sinks[r];
    }
  }
  // below the first depth and beyond the last the surface follows the depth
  const double scale =
    depth / std::clamp(depth, axes_[2].front(), axes_[2].back()) * indentation.tipRadius;
  for (double& sink : sum)
  {
    sink *= scale;
  }
  return sum;
}

double SurfaceTable::sinkAt(const Indentation& indentation, double radius) const
{
  return indentation.depth > 0.0
    ? SinkCurve(sinksAt(indentation)).at(radius / indentation.tipRadius)
    : 0.0;
}

double SurfaceTable::extentRadius(const Indentation& indentation, double threshold) const
{
  if (!(indentation.depth > 0.0))
  {
    return 0.0;
  }
  const SinkCurve curve(sinksAt(indentation));
  if (!(curve.at(0.0) > threshold))
  {
    return 0.0;
  }
  const double outside = kRadii.back() * indentation.tipRadius;
  if (curve.at(kRadii.back()) > threshold)
  {
    return outside;
  }
  const auto sinks = [&](double radius)
  { return curve.at(radius / indentation.tipRadius) > threshold; };
  return bisect(sinks, { 0.0, outside }, 50).low;
}

ExtentTable SurfaceTable::extents(const Indentation& deepest, double threshold) const
{
  constexpr int kRows = 40;
  const double first = std::min(threshold, 0.5 * deepest.depth);
  std::vector<ExtentTable::Extent> rows;
  for (int i = 0; i <= kRows; ++i)
  {
    // close where R_d begins as a root
    const double t = static_cast<double>(i) / kRows;
    Indentation at = deepest;
    at.depth = first + (deepest.depth - first) * t * t;
    rows.push_back({ .depth = at.depth,
      .extentRadius = extentRadius(at, threshold),
      .force = 0.0,
      .contactRadius = 0.0 });
  }
  return ExtentTable(std::move(rows));
}

bool SurfaceTable::covers(const Indentation& indentation) const
{
  const auto within = [](const std::vector<double>& axis, double value)
  { return value >= axis.front() && value <= axis.back(); };
  return within(axes_[0], indentation.poissonRatio) &&
    within(axes_[1], indentation.tipRadius / indentation.thickness) && indentation.depth >= 0.0 &&
    indentation.depth / indentation.tipRadius <= axes_[2].back();
}

} // namespace palp
