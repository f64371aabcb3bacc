#pragma once

#include "pipeline/figure/balls.h"

#include <vector>

namespace palp
{

/// A search for hidden nodules that goes on in the window.
struct Search
{
  double from = 0.0;                ///< [s]
  std::vector<double> marks{};      ///< times [s]
  std::vector<Balls::Ball> balls{}; ///< of them
};

} // namespace palp
