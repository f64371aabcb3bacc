#include "pipeline/model/coincident_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace palp
{

std::vector<int> firstOfEach(std::span<const Eigen::Vector3d> points)
{
  using Shown = std::array<float, 3>;
  std::vector<std::pair<Shown, int>> numbered; // and which point it is
  numbered.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    // what is next to nothing beside the others is the rounding of 0, as sin(pi) has it
    const double nothing = points[i].cwiseAbs().maxCoeff() * 0x1p-32;
    const Eigen::Vector3f x =
      (points[i].array().abs() <= nothing).select(0.0, points[i].array()).matrix().cast<float>();
    if (x.allFinite())
    {
      numbered.push_back({ { x[0], x[1], x[2] }, static_cast<int>(i) });
    }
  }
  std::ranges::sort(numbered);
  std::vector<int> first(points.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 1; i < numbered.size(); ++i)
  {
    if (numbered[i].first == numbered[i - 1].first)
    {
      first[static_cast<std::size_t>(numbered[i].second)] =
        first[static_cast<std::size_t>(numbered[i - 1].second)];
    }
  }
  return first;
}

} // namespace palp
