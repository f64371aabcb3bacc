#include "pipeline/formats/image_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{
namespace
{

// calls work(voxels of their type, how many)
template <typename Work>
void withVoxels(vtkImageData& image, Work work)
{
  vtkDataArray& voxels = *image.GetPointData()->GetScalars();
  const vtkIdType count = voxels.GetNumberOfTuples();
  void* data = voxels.GetVoidPointer(0);
  switch (voxels.GetDataType())
  {
    vtkTemplateMacro(work(static_cast<const VTK_TT*>(data), count));
    default:
      break;
  }
}

// how often each finite value occurs; nothing when there are too many
template <typename Voxel>
std::map<Voxel, vtkIdType> histogram(const Voxel* voxels, vtkIdType count)
{
  constexpr std::size_t most = 256;
  std::map<Voxel, vtkIdType> often;
  for (vtkIdType i = 0; i < count;)
  {
    vtkIdType next = i + 1;
    while (next < count && voxels[next] == voxels[i])
    {
      ++next;
    }
    if (std::isfinite(static_cast<double>(voxels[i])))
    {
      often[voxels[i]] += next - i;
    }
    if (often.size() > most)
    {
      return {};
    }
    i = next;
  }
  return often;
}

// labels fill regions: of the neighbors that are not both background, most are equal
template <typename Voxel>
bool fillsRegions(
  const Voxel* voxels, vtkIdType count, vtkIdType row, const std::map<Voxel, vtkIdType>& often)
{
  const Voxel background =
    std::ranges::max_element(often, {}, [](const auto& entry) { return entry.second; })->first;
  vtkIdType pairs = 0;
  vtkIdType equal = 0;
  for (vtkIdType i = 0; i + 1 < count; ++i)
  {
    const bool inside =
      (i + 1) % row != 0 && (voxels[i] != background || voxels[i + 1] != background);
    pairs += inside;
    equal += inside && voxels[i] == voxels[i + 1];
  }
  return 2 * equal > pairs;
}

std::array<int, 3> indexOf(vtkImageData& image, vtkIdType voxel)
{
  const int* size = image.GetDimensions();
  const vtkIdType row = voxel / size[0];
  return { static_cast<int>(voxel % size[0]), static_cast<int>(row % size[1]),
    static_cast<int>(row / size[1]) };
}

} // namespace

ImageValues valuesOf(vtkImageData& image)
{
  ImageValues values;
  const vtkIdType row = image.GetDimensions()[0];
  withVoxels(image,
    [&](const auto* voxels, vtkIdType count)
    {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (vtkIdType i = 0; i < count; ++i)
      {
        const auto value = static_cast<double>(voxels[i]);
        if (!std::isfinite(value))
        {
          if (values.notFinite++ == 0)
          {
            values.firstOf = indexOf(image, i);
          }
          continue;
        }
        low = value < low ? value : low;
        high = value > high ? value : high;
      }
      values.low = low;
      values.high = high;
      const auto often = histogram(voxels, count);
      bool whole = often.size() > 2;
      for (const auto& [value, times] : often)
      {
        values.distinct.push_back(static_cast<double>(value));
        values.often.push_back(times);
        whole = whole && values.distinct.back() == std::floor(values.distinct.back());
      }
      values.labels = whole && fillsRegions(voxels, count, row, often);
    });
  return values;
}

vtkIdType voxelsAbove(vtkImageData& image, double level)
{
  vtkIdType above = 0;
  withVoxels(image,
    [&](const auto* voxels, vtkIdType count)
    {
      above = std::count_if(
        voxels, voxels + count, [level](auto value) { return static_cast<double>(value) > level; });
    });
  return above;
}

std::uintmax_t crossings(vtkImageData& image, double level)
{
  std::uintmax_t crossed = 0;
  const int* size = image.GetDimensions();
  const vtkIdType row = size[0];
  const vtkIdType slice = row * size[1];
  withVoxels(image,
    [&](const auto* voxels, vtkIdType count)
    {
      const auto above = [&](vtkIdType i) { return static_cast<double>(voxels[i]) >= level; };
      for (vtkIdType i = 0; i < count; ++i)
      {
        const bool here = above(i);
        crossed += (i + 1) % row != 0 && here != above(i + 1);
        crossed += i % slice < slice - row && here != above(i + row);
        crossed += i < count - slice && here != above(i + slice);
      }
    });
  return crossed;
}

std::vector<std::uint8_t> indicator(vtkImageData& image, const std::vector<double>& values)
{
  std::vector<std::uint8_t> inside;
  withVoxels(image,
    [&](const auto* voxels, vtkIdType count)
    {
      inside.resize(static_cast<std::size_t>(count));
      for (vtkIdType i = 0; i < count; ++i)
      {
        inside[static_cast<std::size_t>(i)] =
          std::ranges::find(values, static_cast<double>(voxels[i])) != values.end();
      }
    });
  return inside;
}

} // namespace palp
