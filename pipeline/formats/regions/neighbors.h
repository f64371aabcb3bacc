#pragma once

#include "haptics/surface/edges.h"
#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace palp
{

/// Numbers the points anew, so that in each block of them those with as many triangles follow each
/// other: what goes over their neighbors then seldom guesses wrong how many there are.
void groupByTriangles(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

/// The neighbors of all points, in blocks of points that fit the fast memory of a processor.
class Neighbors
{
public:
  Neighbors(std::size_t points, const Edges& edges);

  [[nodiscard]] std::span<const int> of(std::size_t point) const
  {
    return { all_.data() + first_[point], all_.data() + first_[point + 1] };
  }

  /// Calls work(step, block) for all blocks, and steps from 0 on: each when the step before is done
  /// for all that the block's points are or have as neighbors, and as soon as that, so that what a
  /// step leaves is still at hand for the next.
  void inWaves(std::size_t steps, const std::function<void(std::size_t, std::size_t)>& work) const;

  /// Calls use(point, its neighbors) for each point of a block.
  template <typename Use>
  void each(std::size_t block, const Use& use) const
  {
    for (std::size_t run = firstRun_[block]; run < firstRun_[block + 1]; ++run)
    {
      const std::size_t from = runs_[run];
      const std::size_t to = runs_[run + 1];
      switch (of(from).size())
      {
        case 4:
          eachOf<4>(from, to, use);
          break;
        case 5:
          eachOf<5>(from, to, use);
          break;
        case 6:
          eachOf<6>(from, to, use);
          break;
        case 7:
          eachOf<7>(from, to, use);
          break;
        default:
          eachOf<std::dynamic_extent>(from, to, use);
      }
    }
  }

private:
  template <std::size_t kCount, typename Use>
  void eachOf(std::size_t from, std::size_t to, const Use& use) const
  {
    for (std::size_t i = from; i < to; ++i)
    {
      use(i, std::span<const int, kCount>(of(i)));
    }
  }

  std::vector<int> first_; // #points + 1
  std::vector<int> all_;
  std::vector<std::size_t> runs_;     // first points of those with as many neighbors; and their end
  std::vector<std::size_t> firstRun_; // of each block; and their end
  std::vector<std::size_t> needed_;   // by each block or one before it, the last block
};

} // namespace palp
