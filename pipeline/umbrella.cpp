#include "pipeline/umbrella.h"

#include <algorithm>
#include <utility>

namespace palp
{
namespace
{

using Side = std::pair<std::int32_t, std::int32_t>; // the edge of a triangle opposite a point

// takes sides from the list and joins them end to start, beginning at one that nothing precedes
void chain(std::vector<Side>& sides, std::vector<std::int32_t>& out)
{
  while (!sides.empty())
  {
    const auto isStart = [&](const Side& side)
    {
      return std::none_of(
        sides.begin(), sides.end(), [&](const Side& other) { return other.second == side.first; });
    };
    auto next = std::find_if(sides.begin(), sides.end(), isStart);
    next = next == sides.end() ? sides.begin() : next;
    out.push_back(next->first);
    while (next != sides.end())
    {
      const std::int32_t end = next->second;
      out.push_back(end);
      sides.erase(next);
      next = std::find_if(
        sides.begin(), sides.end(), [end](const Side& side) { return side.first == end; });
    }
    if (!sides.empty())
    {
      out.push_back(Umbrella::kEnd);
    }
  }
}

bool isProper(const Triangle& triangle)
{
  return triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
}

} // namespace

Umbrella::Umbrella(std::size_t pointCount, std::span<const Triangle> triangles)
{
  // sides opposite each point, as compressed rows
  std::vector<std::uint32_t> begin(pointCount + 1, 0);
  for (const Triangle& triangle : triangles)
  {
    for (int corner : triangle)
    {
      begin[static_cast<std::size_t>(corner) + 1] += isProper(triangle) ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    begin[i + 1] += begin[i];
  }
  std::vector<Side> opposite(begin.back());
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  for (const Triangle& triangle : triangles)
  {
    for (std::size_t k = 0; k < 3 && isProper(triangle); ++k)
    {
      opposite[fill[static_cast<std::size_t>(triangle[k])]++] = { triangle[(k + 1) % 3],
        triangle[(k + 2) % 3] };
    }
  }

  first_.assign(pointCount + 1, 0);
  chains_.reserve(opposite.size() + pointCount);
  std::vector<Side> sides;
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    sides.assign(opposite.begin() + begin[i], opposite.begin() + begin[i + 1]);
    chain(sides, chains_);
    first_[i + 1] = static_cast<std::uint32_t>(chains_.size());
  }
  chains_.shrink_to_fit();
}

} // namespace palp
