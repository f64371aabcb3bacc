#pragma once

#include <vector>

namespace palp
{

/// A search for hidden nodules that goes on in the window.
struct Search
{
  double from = 0.0;           ///< [s]
  std::vector<double> marks{}; ///< times [s]
};

} // namespace palp
