#include "pipeline/formats/joined_corners.h"

#include "pipeline/model/coincident_points.h"

#include <algorithm>
#include <vector>

namespace palp
{

FileSurface withJoinedCorners(FileSurface surface)
{
  if (surface.points.size() < 2 * surface.triangles.size())
  {
    return surface;
  }
  const std::vector<int> first = firstOfEach(surface.points);
  std::vector<int> number(first.size());
  int count = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    const bool isFirst = at(first[i]) == i;
    if (isFirst)
    {
      surface.points[at(count)] = surface.points[i];
    }
    number[i] = isFirst ? count++ : number[at(first[i])];
  }
  surface.points.resize(at(count));
  for (Triangle& triangle : surface.triangles)
  {
    std::ranges::transform(
      triangle, triangle.begin(), [&](int corner) { return number[at(corner)]; });
  }
  return surface;
}

} // namespace palp
