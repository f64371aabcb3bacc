#include "pipeline/formats/regions/image_values.h"

#include "pipeline/formats/regions/voxel_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace palp
{
namespace
{

// a value, how often and where
struct Occurrence
{
  vtkIdType often = 0;
  VoxelBox box;
};

template <typename Voxel>
using Histogram = std::map<Voxel, Occurrence>;

// takes the finite values, and counts the others; no histogram when there are too many
template <typename Voxel>
Histogram<Voxel> histogram(const VoxelLayer<Voxel>& voxels, const int* size, ImageValues& values)
{
  constexpr std::size_t most = 256;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Histogram<Voxel> all;
  bool areFew = true;
  values.low = kInfinity;
  values.high = -kInfinity;
  for (vtkIdType i = 0; i < voxels.count;)
  {
    const Voxel stored = voxels[i];
    const vtkIdType end = areFew ? (i / size[0] + 1) * size[0] : i + 1; // of the row
    vtkIdType next = i + 1;
    while (next < end && voxels[next] == stored)
    {
      ++next;
    }
    if (const auto value = static_cast<double>(stored); !std::isfinite(value))
    {
      values.firstOf = values.notFinite == 0 ? indexOf(size, i) : values.firstOf;
      values.notFinite += next - i; // infinite ones may be a row
    }
    else
    {
      values.low = std::min(values.low, value);
      values.high = std::max(values.high, value);
      if (areFew)
      {
        Occurrence& one = all[stored];
        one.often += next - i;
        one.box.add(indexOf(size, i), indexOf(size, next - 1));
        areFew = all.size() <= most;
      }
    }
    i = next;
  }
  return areFew ? all : Histogram<Voxel>();
}

// labels fill regions: of the neighbors that are not both background, most are equal
template <typename Voxel>
bool fillsRegions(const VoxelLayer<Voxel>& voxels, vtkIdType row, const Histogram<Voxel>& values)
{
  const Voxel background = std::ranges::max_element(values, {},
    [](const auto& entry) {
      return entry.second.often;
    })->first;
  vtkIdType pairs = 0;
  vtkIdType equal = 0;
  const auto compare = [&](vtkIdType i, vtkIdType k)
  {
    const bool inside = voxels[i] != background || voxels[k] != background;
    pairs += inside;
    equal += inside && voxels[i] == voxels[k];
  };
  for (vtkIdType i = 0; i + 1 < voxels.count; ++i)
  {
    (i + 1) % row != 0 ? compare(i, i + 1) : void();
    i + row < voxels.count ? compare(i, i + row) : void(); // a row may have four voxels
  }
  return 2 * equal > pairs;
}

} // namespace

void VoxelBox::add(const std::array<int, 3>& from, const std::array<int, 3>& to) noexcept
{
  const bool isFirst = empty();
  for (std::size_t k = 0; k < 3; ++k)
  {
    low[k] = isFirst ? from[k] : std::min(low[k], from[k]);
    high[k] = isFirst ? to[k] : std::max(high[k], to[k]);
  }
}

ImageValues valuesOf(vtkImageData& image, int layer)
{
  ImageValues values;
  const int* size = image.GetDimensions();
  withVoxels(image, layer,
    [&](const auto& voxels)
    {
      const auto all = histogram(voxels, size, values);
      bool whole = all.size() > 2;
      for (const auto& [value, one] : all)
      {
        values.distinct.push_back(static_cast<double>(value));
        values.often.push_back(one.often);
        values.boxes.push_back(one.box);
        whole = whole && values.distinct.back() == std::floor(values.distinct.back());
      }
      values.labels = whole && fillsRegions(voxels, size[0], all);
    });
  return values;
}

vtkIdType voxelsAbove(vtkImageData& image, double level)
{
  vtkIdType above = 0;
  withVoxels(image, 0,
    [&](const auto& voxels)
    {
      for (vtkIdType i = 0; i < voxels.count; ++i)
      {
        above += static_cast<double>(voxels[i]) > level;
      }
    });
  return above;
}

std::uintmax_t crossings(vtkImageData& image, double level)
{
  std::uintmax_t crossed = 0;
  const int* size = image.GetDimensions();
  const vtkIdType row = size[0];
  const vtkIdType slice = row * size[1];
  withVoxels(image, 0,
    [&](const auto& voxels)
    {
      const auto above = [&](vtkIdType i) { return static_cast<double>(voxels[i]) >= level; };
      for (vtkIdType i = 0; i < voxels.count; ++i)
      {
        const bool here = above(i);
        crossed += (i + 1) % row != 0 && here != above(i + 1);
        crossed += i % slice < slice - row && here != above(i + row);
        crossed += i < voxels.count - slice && here != above(i + slice);
      }
    });
  return crossed;
}

VoxelBox boxWhere(vtkImageData& image, const std::function<bool(double)>& isWanted, int layer)
{
  VoxelBox box;
  const int* size = image.GetDimensions();
  withVoxels(image, layer,
    [&](const auto& voxels)
    {
      for (vtkIdType row = 0; row < voxels.count; row += size[0])
      {
        vtkIdType first = row;
        vtkIdType last = row + size[0] - 1;
        const auto isIn = [&](vtkIdType i) { return isWanted(static_cast<double>(voxels[i])); };
        while (first <= last && !isIn(first))
        {
          ++first;
        }
        while (last > first && !isIn(last))
        {
          --last;
        }
        first <= last ? box.add(indexOf(size, first), indexOf(size, last)) : void();
      }
    });
  return box;
}

} // namespace palp
