#include "pipeline/deform/vertex_rings.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace palp
{
namespace
{

using Side = std::pair<std::int32_t, std::int32_t>; // the edge of a triangle opposite a point

// joins the sides about one point end to start, each chain beginning at one that nothing precedes;
// O(n log n), for a point may have any number of triangles
class Chains
{
public:
  void join(std::span<const Side> sides, std::vector<std::int32_t>& out)
  {
    sides_ = sides;
    used_.assign(sides.size(), false);
    ends_.clear();
    starts_.clear();
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      starts_.emplace_back(sides[i].first, static_cast<std::int32_t>(i));
      ends_.push_back(sides[i].second);
    }
    std::ranges::sort(starts_);
    std::ranges::sort(ends_);
    next_.resize(sides.size());
    std::iota(next_.begin(), next_.end(), std::size_t{ 0 });

    const std::size_t begin = out.size();
    for (const bool closed : { false, true })
    {
      for (std::size_t i = 0; i < sides.size(); ++i)
      {
        if (!used_[i] && (closed || !std::ranges::binary_search(ends_, sides[i].first)))
        {
          if (out.size() > begin)
          {
            out.push_back(VertexRings::kEnd);
          }
          walk(i, out);
        }
      }
    }
  }

private:
  void walk(std::size_t side, std::vector<std::int32_t>& out)
  {
    out.push_back(sides_[side].first);
    for (std::optional<std::size_t> now = side; now; now = after(sides_[*now].second))
    {
      used_[*now] = true;
      out.push_back(sides_[*now].second);
    }
  }

  // the first unused side that starts at a point
  std::optional<std::size_t> after(std::int32_t point)
  {
    const auto group =
      std::ranges::lower_bound(starts_, point, {}, &std::pair<std::int32_t, std::int32_t>::first);
    if (group == starts_.end())
    {
      return std::nullopt;
    }
    std::size_t& at = next_[static_cast<std::size_t>(group - starts_.begin())];
    for (; at < starts_.size() && starts_[at].first == point; ++at)
    {
      const auto side = static_cast<std::size_t>(starts_[at].second);
      if (!used_[side])
      {
        return side;
      }
    }
    return std::nullopt;
  }

  std::span<const Side> sides_;
  std::vector<bool> used_;
  std::vector<std::pair<std::int32_t, std::int32_t>> starts_; // point, side
  std::vector<std::int32_t> ends_;
  std::vector<std::size_t> next_; // of those with one start, from the first of them
};

bool isProper(const Triangle& triangle)
{
  return triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
}

} // namespace

VertexRings::VertexRings(std::size_t pointCount, std::span<const Triangle> triangles)
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
  Chains chains;
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    chains.join(std::span(opposite).subspan(begin[i], begin[i + 1] - begin[i]), chains_);
    first_[i + 1] = static_cast<std::uint32_t>(chains_.size());
  }
  chains_.shrink_to_fit();
}

} // namespace palp
