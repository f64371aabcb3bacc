#include "pipeline/model/merged_mesh.h"

#include "pipeline/model/coincident_points.h"

#include <algorithm>
#include <utility>

namespace palp
{

MergedMesh mergedMesh(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  const std::vector<int> first = firstOfEach(points);
  std::vector<bool> isUsed(points.size());
  MergedMesh result;
  result.triangles.reserve(triangles.size());
  result.from.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    Triangle t = triangles[i];
    std::ranges::transform(t, t.begin(), [&](int corner) { return first[at(corner)]; });
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    {
      continue;
    }
    std::ranges::for_each(t, [&](int corner) { isUsed[at(corner)] = true; });
    result.triangles.push_back(t);
    result.from.push_back(static_cast<int>(i));
  }
  std::vector<int> number(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    number[i] = static_cast<int>(result.points.size());
    isUsed[i] ? result.points.push_back(points[i].cast<float>().cast<double>()) : void();
  }
  for (Triangle& t : result.triangles)
  {
    std::ranges::transform(t, t.begin(), [&](int corner) { return number[at(corner)]; });
  }
  return result;
}

MergedMesh mergedWithout(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const std::vector<bool>& isOut)
{
  std::vector<Triangle> rest(triangles.begin(), triangles.end());
  std::size_t i = 0;
  std::erase_if(rest, [&](const Triangle&) { return isOut[i++]; });
  return mergedMesh(points, rest);
}

std::vector<bool> repeatedTriangles(std::span<const Triangle> triangles, bool turned)
{
  std::vector<std::pair<Triangle, std::size_t>> sorted(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    sorted[i] = { triangles[i], i };
    Triangle& t = sorted[i].first;
    turned ? void(std::ranges::sort(t))
           : void(std::rotate(t.begin(), std::ranges::min_element(t), t.end()));
  }
  std::ranges::sort(sorted);
  std::vector<bool> result(triangles.size());
  for (std::size_t i = 1; i < sorted.size(); ++i)
  {
    result[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
  }
  return result;
}

} // namespace palp
