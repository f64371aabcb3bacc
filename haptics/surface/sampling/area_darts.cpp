#include "haptics/surface/sampling/area_darts.h"

#include "haptics/surface/facet_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

// 0 for those of the outside, where a tool gets
std::vector<float> hollowsOf(const Surface& surface)
{
  std::vector<std::array<int, 3>> across;
  for (int i = 0; static_cast<std::size_t>(i) < surface.triangles().size(); ++i)
  {
    across.push_back({ surface.across(i, 0), surface.across(i, 1), surface.across(i, 2) });
  }
  return hollowRadii({ surface.points(), surface.triangles(), across });
}

} // namespace

AreaDarts::AreaDarts(const Surface& surface, const std::function<bool(std::size_t triangle)>& isIn)
  : surface_(surface)
{
  const std::vector<float> hollows = hollowsOf(surface);
  for (std::size_t i = 0; i < surface.triangles().size(); ++i)
  {
    if (hollows[i] == 0.0F && isIn(i))
    {
      const auto [a, b, c] = cornersOf(surface, i);
      area_ += 0.5 * (b - a).cross(c - a).norm();
      triangles_.push_back(i);
      sums_.push_back(area_);
    }
  }
}

SurfacePoint AreaDarts::next(std::mt19937_64& engine) const
{
  const double share = area_ * uniform(engine);
  const auto at = std::min(std::ranges::upper_bound(sums_, share) - sums_.begin(),
    static_cast<std::ptrdiff_t>(sums_.size()) - 1);
  const std::size_t triangle = triangles_[static_cast<std::size_t>(at)];
  const auto [a, b, c] = cornersOf(surface_, triangle);
  const double root = std::sqrt(uniform(engine));
  const double across = uniform(engine);
  const Eigen::Vector3d position = (1.0 - root) * a + root * (1.0 - across) * b + root * across * c;
  return surfacePoint(surface_, static_cast<int>(triangle), position);
}

} // namespace palp
