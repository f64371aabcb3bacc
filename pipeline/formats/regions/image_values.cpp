#include "pipeline/formats/regions/image_values.h"

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

// one component of all voxels
template <typename Voxel>
struct Layer
{
  const Voxel* first;
  vtkIdType step;
  vtkIdType count;

  Voxel operator[](vtkIdType i) const
  {
    return first[i * step];
  }
};

// calls work(voxels of their type)
template <typename Work>
void withVoxels(vtkImageData& image, int layer, Work work)
{
  vtkDataArray& voxels = *image.GetPointData()->GetScalars();
  void* data = voxels.GetVoidPointer(0);
  switch (voxels.GetDataType())
  {
    vtkTemplateMacro(work(Layer<VTK_TT>{ static_cast<const VTK_TT*>(data) + layer,
      voxels.GetNumberOfComponents(), voxels.GetNumberOfTuples() }));
    default:
      break;
  }
}

// a value, how often and where
struct Occurrence
{
  vtkIdType often = 0;
  VoxelBox box;
};

template <typename Voxel>
using Histogram = std::map<Voxel, Occurrence>;

std::array<int, 3> indexOf(const int* size, vtkIdType voxel)
{
  const vtkIdType row = voxel / size[0];
  return { static_cast<int>(voxel % size[0]), static_cast<int>(row % size[1]),
    static_cast<int>(row / size[1]) };
}

// of the finite values; nothing when there are too many
template <typename Voxel>
Histogram<Voxel> histogram(const Layer<Voxel>& voxels, const int* size)
{
  constexpr std::size_t most = 256;
  Histogram<Voxel> values;
  for (vtkIdType i = 0; i < voxels.count;)
  {
    const Voxel value = voxels[i];
    const vtkIdType end = (i / size[0] + 1) * size[0]; // of the row
    vtkIdType next = i + 1;
    while (next < end && voxels[next] == value)
    {
      ++next;
    }
    if (std::isfinite(static_cast<double>(value)))
    {
      Occurrence& one = values[value];
      one.often += next - i;
      one.box.add(indexOf(size, i), indexOf(size, next - 1));
    }
    if (values.size() > most)
    {
      return {};
    }
    i = next;
  }
  return values;
}

// labels fill regions: of the neighbors that are not both background, most are equal
template <typename Voxel>
bool fillsRegions(const Layer<Voxel>& voxels, vtkIdType row, const Histogram<Voxel>& values)
{
  const Voxel background = std::ranges::max_element(values, {},
    [](const auto& entry) {
      return entry.second.often;
    })->first;
  vtkIdType pairs = 0;
  vtkIdType equal = 0;
  for (vtkIdType i = 0; i + 1 < voxels.count; ++i)
  {
    const bool inside =
      (voxels[i] != background || voxels[i + 1] != background) && (i + 1) % row != 0;
    pairs += inside;
    equal += inside && voxels[i] == voxels[i + 1];
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
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (vtkIdType i = 0; i < voxels.count; ++i)
      {
        const auto value = static_cast<double>(voxels[i]);
        if (!std::isfinite(value))
        {
          if (values.notFinite++ == 0)
          {
            values.firstOf = indexOf(size, i);
          }
          continue;
        }
        low = value < low ? value : low;
        high = value > high ? value : high;
      }
      values.low = low;
      values.high = high;
      const auto all = histogram(voxels, size);
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

vtkSmartPointer<vtkImageData> maskAbout(vtkImageData& image, const VoxelBox& box)
{
  auto mask = vtkSmartPointer<vtkImageData>::New();
  std::array<int, 3> size{};
  std::array<double, 3> origin{};
  const int* extent = image.GetExtent(); // whose first voxel may be any
  for (std::size_t k = 0; k < 3; ++k)
  {
    size[k] = box.high[k] - box.low[k] + 3;
    origin[k] = image.GetOrigin()[k] + image.GetSpacing()[k] * (extent[2 * k] + box.low[k] - 1);
  }
  mask->SetDimensions(size.data());
  mask->SetSpacing(image.GetSpacing());
  mask->SetOrigin(origin.data());
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  std::fill_n(static_cast<std::uint8_t*>(mask->GetScalarPointer()), mask->GetNumberOfPoints(),
    std::uint8_t{ 0 });
  return mask;
}

namespace
{

// calls visit(place in an image of one more voxel to each side, place in the image) for each row
template <typename Visit>
void eachRow(const int* size, const VoxelBox& box, Visit visit)
{
  const std::array<vtkIdType, 3> wide{ box.high[0] - box.low[0] + 3, box.high[1] - box.low[1] + 3,
    box.high[2] - box.low[2] + 3 };
  for (vtkIdType z = box.low[2]; z <= box.high[2]; ++z)
  {
    for (vtkIdType y = box.low[1]; y <= box.high[1]; ++y)
    {
      visit(((z - box.low[2] + 1) * wide[1] + y - box.low[1] + 1) * wide[0] + 1,
        (z * size[1] + y) * size[0] + box.low[0]);
    }
  }
}

} // namespace

void mark(vtkImageData& mask, vtkImageData& image, const VoxelBox& box,
  const std::function<bool(double)>& isWanted, int layer)
{
  auto* marks = static_cast<std::uint8_t*>(mask.GetScalarPointer());
  withVoxels(image, layer,
    [&](const auto& voxels)
    {
      auto known = voxels[0]; // neighbors are alike
      bool wanted = isWanted(static_cast<double>(known));
      eachRow(image.GetDimensions(), box,
        [&](vtkIdType to, vtkIdType from)
        {
          for (vtkIdType i = 0; i <= box.high[0] - box.low[0]; ++i)
          {
            if (const auto value = voxels[from + i]; value != known)
            {
              known = value;
              wanted = isWanted(static_cast<double>(value));
            }
            marks[to + i] |= static_cast<std::uint8_t>(wanted);
          }
        });
    });
}

vtkSmartPointer<vtkImageData> closedAtBorder(vtkImageData& image, double level, double outside)
{
  const int* size = image.GetDimensions();
  vtkIdType border = 0;
  vtkIdType above = 0;
  const VoxelBox all{ {}, { size[0] - 1, size[1] - 1, size[2] - 1 } };
  auto closed = vtkSmartPointer<vtkImageData>::New();
  withVoxels(image, 0,
    [&](const auto& voxels)
    {
      for (vtkIdType row = 0; row < voxels.count; row += size[0])
      {
        const auto [x, y, z] = indexOf(size, row);
        const bool isSide = y == 0 || z == 0 || y == all.high[1] || z == all.high[2];
        for (vtkIdType i = 0; i < size[0]; i += isSide ? 1 : std::max(size[0] - 1, 1))
        {
          ++border;
          above += static_cast<double>(voxels[row + i]) >= level;
        }
      }
      if (above == 0 || above == border)
      {
        return;
      }
      closed->ShallowCopy(maskAbout(image, all));
      closed->AllocateScalars(image.GetScalarType(), 1);
      closed->GetPointData()->GetScalars()->Fill(outside);
      auto* to = static_cast<std::remove_cv_t<std::remove_pointer_t<decltype(voxels.first)>>*>(
        closed->GetScalarPointer());
      eachRow(size, all,
        [&](vtkIdType into, vtkIdType from)
        { std::copy_n(voxels.first + from, size[0], to + into); });
    });
  return above == 0 || above == border ? vtkSmartPointer<vtkImageData>(&image) : closed;
}

} // namespace palp
