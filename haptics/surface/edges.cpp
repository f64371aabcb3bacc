#include "haptics/surface/edges.h"

#include <algorithm>

namespace palp
{
namespace
{

// one side of a triangle, from its corner k, kept at the lower of its two points
struct Side
{
  int other; // the higher point
  int triangle;
  int k;
};

struct Sides
{
  std::vector<int> first; // of each point in all; #points + 1
  std::vector<Side> all;  // at each point by the higher one
};

Sides sidesByPoint(std::size_t points, std::span<const Triangle> triangles)
{
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

} // namespace

Edges edgesOf(std::size_t points, std::span<const Triangle> triangles)
{
  const Sides sides = sidesByPoint(points, triangles);
  Edges edges{ .across = { triangles.size(), { -1, -1, -1 } } };
  edges.all.reserve(sides.all.size() / 2);
  for (std::size_t point = 0; point < points; ++point)
  {
    const auto end = at(sides.first[point + 1]);
    for (auto side = at(sides.first[point]); side < end;)
    {
      const Side& one = sides.all[side];
      std::size_t next = side;
      int ways = 0; // upward less downward
      for (; next < end && sides.all[next].other == one.other; ++next)
      {
        const Side& each = sides.all[next];
        ways += triangles[at(each.triangle)][at(each.k)] == static_cast<int>(point) ? 1 : -1;
      }
      edges.all.push_back({ static_cast<int>(point), one.other });
      if (next - side == 2)
      {
        const Side& two = sides.all[side + 1];
        edges.across[at(one.triangle)][at(one.k)] = two.triangle;
        edges.across[at(two.triangle)][at(two.k)] = one.triangle;
      }
      else
      {
        edges.unpaired.push_back(edges.all.back());
        edges.crowded += next - side > 2;
        edges.unbalanced += ways != 0;
      }
      side = next;
    }
  }
  return edges;
}

std::vector<int> piecesOf(std::span<const std::array<int, 3>> across)
{
  std::vector<int> pieces(across.size(), -1);
  std::vector<std::size_t> waiting;
  int count = 0;
  for (std::size_t start = 0; start < across.size(); ++start)
  {
    if (pieces[start] >= 0)
    {
      continue;
    }
    pieces[start] = count;
    waiting.push_back(start);
    while (!waiting.empty())
    {
      const std::size_t triangle = waiting.back();
      waiting.pop_back();
      for (const int other : across[triangle])
      {
        if (other >= 0 && pieces[at(other)] < 0)
        {
          pieces[at(other)] = count;
          waiting.push_back(at(other));
        }
      }
    }
    ++count;
  }
  return pieces;
}

} // namespace palp
