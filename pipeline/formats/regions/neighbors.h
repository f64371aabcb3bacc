#pragma once

#include "haptics/surface/box_tree.h"
#include "haptics/surface/edges.h"

#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// The neighbors of all points, one after the other.
class Neighbors
{
public:
  Neighbors(std::size_t points, const Edges& edges)
    : first_(points + 1, 0)
    , all_(2 * edges.all.size())
  {
    for (const auto& [a, b] : edges.all)
    {
      ++first_[at(a) + 1];
      ++first_[at(b) + 1];
    }
    for (std::size_t i = 0; i < points; ++i)
    {
      first_[i + 1] += first_[i];
    }
    std::vector<int> next = first_;
    for (const auto& [a, b] : edges.all)
    {
      all_[at(next[at(a)]++)] = b;
      all_[at(next[at(b)]++)] = a;
    }
  }

  [[nodiscard]] std::span<const int> of(std::size_t point) const
  {
    return { all_.data() + first_[point], all_.data() + first_[point + 1] };
  }

private:
  std::vector<int> first_; // #points + 1
  std::vector<int> all_;
};

} // namespace palp
