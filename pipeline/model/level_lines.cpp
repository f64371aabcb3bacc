#include "pipeline/model/level_lines.h"

#include <cstdint>
#include <unordered_map>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

vtkFloatArray& arrayOf(vtkPolyData& surface, const char* name)
{
  return *vtkFloatArray::SafeDownCast(surface.GetPointData()->GetArray(name));
}

vtkFloatArray& pointsIn(vtkPolyData& surface)
{
  return *vtkFloatArray::SafeDownCast(surface.GetPoints()->GetData());
}

void addBetween(vtkFloatArray& corners, const LevelLines::Point& at, vtkFloatArray& made)
{
  std::array<float, 3> value{};
  for (int k = 0; k < 3; ++k)
  {
    const float from = corners.GetTypedComponent(at.from, k);
    const float to = corners.GetTypedComponent(at.to, k);
    value[static_cast<std::size_t>(k)] = from + at.t * (to - from);
  }
  made.InsertNextTypedTuple(value.data());
}

} // namespace

LevelLines levelLines(
  std::span<const Triangle> triangles, std::span<const float> values, float level)
{
  LevelLines made;
  std::unordered_map<std::uint64_t, int> known; // points by the ends of their edges
  const auto valueAt = [&](int corner) { return values[static_cast<std::size_t>(corner)]; };
  const auto isAbove = [&](int corner) { return valueAt(corner) >= level; };
  const auto pointOn = [&](int low, int high)
  {
    const std::uint64_t key =
      static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high);
    const auto [at, isNew] = known.try_emplace(key, static_cast<int>(made.points.size()));
    if (isNew)
    {
      made.points.push_back({ low, high, (level - valueAt(low)) / (valueAt(high) - valueAt(low)) });
    }
    return at->second;
  };
  for (const Triangle& corners : triangles)
  {
    std::array<int, 2> ends{};
    int crossed = 0;
    // all lines run the same way round what is above: where two ends, or two beginnings, met, the
    // rules by which lines become pixels would leave a gap
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const int a = corners[i];
      const int b = corners[(i + 1) % corners.size()];
      if (isAbove(a) != isAbove(b))
      {
        ends[isAbove(a) ? 0 : 1] = isAbove(a) ? pointOn(b, a) : pointOn(a, b);
        ++crossed;
      }
    }
    crossed == 2 ? made.lines.push_back(ends) : void();
  }
  return made;
}

void addLevelLines(vtkPolyData& surface, std::span<const Triangle> triangles, const char* values,
  const char* vectors, float level, vtkPolyData& lines)
{
  if (lines.GetPoints() == nullptr)
  {
    vtkNew<vtkFloatArray> between;
    between->SetNumberOfComponents(3);
    between->SetName(vectors);
    lines.SetPoints(vtkNew<vtkPoints>());
    lines.SetLines(vtkNew<vtkCellArray>());
    lines.GetPointData()->AddArray(between);
  }
  vtkFloatArray& at = arrayOf(surface, values);
  const LevelLines made = levelLines(
    triangles, { at.GetPointer(0), static_cast<std::size_t>(at.GetNumberOfValues()) }, level);
  const vtkIdType first = lines.GetNumberOfPoints();
  for (const LevelLines::Point& point : made.points)
  {
    addBetween(pointsIn(surface), point, pointsIn(lines));
    addBetween(arrayOf(surface, vectors), point, arrayOf(lines, vectors));
  }
  for (const auto& [a, b] : made.lines)
  {
    lines.GetLines()->InsertNextCell({ first + a, first + b });
  }
}

} // namespace palp
