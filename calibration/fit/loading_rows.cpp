#include "calibration/fit/loading_rows.h"

#include "haptics/error.h"

#include <algorithm>

namespace palp::fit
{

Rows loadingRows(std::span<const double> depths)
{
  constexpr double kFall = 0.1; // of the range
  if (depths.empty())
  {
    throw Error(ErrorCode::BadValue, "no row; give a curve");
  }
  const double least = std::ranges::min(depths);
  const auto most = std::ranges::max_element(depths); // the first of equals: then comes a hold
  if (least == *most)
  {
    throw Error(ErrorCode::BadValue, "all rows have one depth; give a press");
  }
  const auto deepest = static_cast<std::size_t>(most - depths.begin());
  const double fall = kFall * (*most - least);
  std::size_t first = deepest; // where the tool was highest since it last fell
  for (std::size_t row = deepest; row-- > 0 && depths[row] - depths[first] <= fall;)
  {
    if (depths[row] <= depths[first])
    {
      first = row;
    }
  }
  if (first == deepest)
  {
    throw Error(ErrorCode::BadValue,
      "the depth only falls; give the rows in the order in which the tool goes in");
  }
  return { .first = first, .count = deepest - first + 1 };
}

} // namespace palp::fit
