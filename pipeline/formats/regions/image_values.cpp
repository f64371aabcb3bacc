#include "pipeline/formats/regions/image_values.h"

#include "pipeline/formats/regions/voxel_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace palp
{
namespace
{

// a value, how often and where
struct Occurrence
{
  vtkIdType often = 0;
  vtkIdType runs = 0; // of equal voxels along a row
  VoxelBox box;
};

using Occurrences = std::map<double, Occurrence>;

constexpr std::size_t kFew = 256;

// Whole values as a scanner or a map of labels has them in a table, others while they are few.
class Histogram
{
public:
  // false: there are more than can be counted
  [[nodiscard]] bool add(
    double value, vtkIdType often, const std::array<int, 3>& from, const std::array<int, 3>& to)
  {
    const bool isCommon = value >= kFirst && value <= kLast && value == std::floor(value);
    Occurrence& one = isCommon ? common_[static_cast<std::size_t>(value - kFirst)] : others_[value];
    one.often += often;
    ++one.runs;
    one.box.add(from, to);
    return others_.size() <= kFew;
  }

  [[nodiscard]] Occurrences all() const
  {
    Occurrences all = others_;
    for (std::size_t i = 0; i < common_.size(); ++i)
    {
      common_[i].often > 0 ? void(all[kFirst + static_cast<double>(i)] = common_[i]) : void();
    }
    return all;
  }

private:
  static constexpr double kFirst = -32768.0;
  static constexpr double kLast = 65535.0;
  std::vector<Occurrence> common_ =
    std::vector<Occurrence>(static_cast<std::size_t>(kLast - kFirst) + 1);
  Occurrences others_;
};

// takes the finite values, and counts the others; nothing when there are too many
template <typename Voxel>
Occurrences histogram(const VoxelLayer<Voxel>& voxels, const int* size, ImageValues& values)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Histogram all;
  bool isCounted = true;
  values.low = kInfinity;
  values.high = -kInfinity;
  for (vtkIdType row = 0; row < voxels.count; row += size[0])
  {
    const std::array<int, 3> start = indexOf(size, row);
    for (int i = 0; i < size[0];)
    {
      const Voxel stored = voxels[row + i];
      int next = i + 1;
      while (next < size[0] && voxels[row + next] == stored)
      {
        ++next;
      }
      if (const auto value = static_cast<double>(stored); !std::isfinite(value))
      {
        values.firstOf = values.notFinite == 0 ? indexOf(size, row + i) : values.firstOf;
        values.notFinite += next - i;
      }
      else
      {
        values.low = std::min(values.low, value);
        values.high = std::max(values.high, value);
        isCounted = isCounted &&
          all.add(value, next - i, { i, start[1], start[2] }, { next - 1, start[1], start[2] });
      }
      i = next;
    }
  }
  return isCounted ? all.all() : Occurrences();
}

// labels fill regions: of the neighbors that are not both background, most are equal
template <typename Voxel>
bool fillsRegions(const VoxelLayer<Voxel>& voxels, vtkIdType row, const Occurrences& values)
{
  const auto background = static_cast<Voxel>(std::ranges::max_element(values, {},
    [](const auto& entry)
    { return entry.second.often; })->first);
  vtkIdType pairs = 0;
  vtkIdType equal = 0;
  const auto compare = [&](vtkIdType i, vtkIdType k)
  {
    const bool inside = voxels[i] != background || voxels[k] != background;
    pairs += inside;
    equal += inside && voxels[i] == voxels[k];
  };
  for (vtkIdType first = 0; first < voxels.count; first += row)
  {
    const bool isLast = first + row >= voxels.count;
    for (vtkIdType i = first; i < first + row; ++i)
    {
      i + 1 < first + row ? compare(i, i + 1) : void();
      isLast ? void() : compare(i, i + row); // a row may have four voxels
    }
  }
  return 2 * equal > pairs;
}

// at how many places two lists differ
std::uintmax_t differing(std::span<const unsigned char> one, std::span<const unsigned char> other)
{
  std::uintmax_t count = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    count += one[i] != other[i];
  }
  return count;
}

// A scan may have air and padding that are even, but of its many values the most are not.
bool areManyRegions(const Occurrences& values)
{
  constexpr vtkIdType kLong = 2; // voxels of a run
  const auto regions = std::ranges::count_if(
    values, [](const auto& entry) { return entry.second.often >= kLong * entry.second.runs; });
  return 2 * static_cast<std::size_t>(regions) > values.size();
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
        values.distinct.push_back(value);
        values.often.push_back(one.often);
        values.boxes.push_back(one.box);
        whole = whole && values.distinct.back() == std::floor(values.distinct.back());
      }
      const bool areFew = all.size() <= kFew;
      values.labels =
        whole && (areFew || areManyRegions(all)) && fillsRegions(voxels, size[0], all);
      if (!areFew && !values.labels)
      {
        values.distinct.clear();
        values.often.clear();
        values.boxes.clear();
      }
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
  const auto row = static_cast<std::size_t>(size[0]);
  const std::size_t slice = row * static_cast<std::size_t>(size[1]);
  withVoxels(image, 0,
    [&](const auto& voxels)
    {
      std::vector<unsigned char> here(slice); // which of a slice are above
      std::vector<unsigned char> before;
      for (vtkIdType next = 0; next < voxels.count;)
      {
        before.swap(here);
        here.resize(slice);
        std::ranges::generate(here, [&] { return static_cast<double>(voxels[next++]) >= level; });
        const std::span all(here);
        for (std::size_t j = 0; j < slice; j += row)
        {
          crossed += differing(all.subspan(j, row - 1), all.subspan(j + 1, row - 1));
        }
        crossed += differing(all.first(slice - row), all.last(slice - row));
        crossed += next > static_cast<vtkIdType>(slice) ? differing(all, before) : 0;
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
