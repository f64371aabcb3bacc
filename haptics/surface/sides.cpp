#include "haptics/surface/sides.h"

namespace palp
{

Sides sidesByPoint(std::size_t points, std::span<const Triangle> triangles)
{
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  Sides sides{ .first = std::vector<int>(points + 1, 0), .all = {} };
  const auto eachSide = [&](auto&& use)
  {
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      const Triangle& t = triangles[i];
      for (std::size_t k = 0; k < 3 && t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; ++k)
      {
        const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
        use(low, Side{ high, static_cast<int>(i), static_cast<int>(k) });
      }
    }
  };
  eachSide([&](int low, const Side&) { ++sides.first[at(low) + 1]; });
  for (std::size_t i = 0; i < points; ++i)
  {
    sides.first[i + 1] += sides.first[i];
  }
  sides.all.resize(at(sides.first.back()));
  std::vector<int> next = sides.first;
  eachSide([&](int low, const Side& side) { sides.all[at(next[at(low)]++)] = side; });
  for (std::size_t i = 0; i < points; ++i)
  {
    std::sort(sides.all.begin() + sides.first[i], sides.all.begin() + sides.first[i + 1],
      [](const Side& a, const Side& b) { return a.other < b.other; });
  }
  return sides;
}

} // namespace palp
