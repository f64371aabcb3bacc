#include "pipeline/formats/regions/image_grids.h"

#include "pipeline/formats/regions/voxel_layer.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

namespace palp
{

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

bool isAboveAround(vtkImageData& image, double level)
{
  const int* extent = image.GetExtent();
  return image.GetScalarComponentAsDouble(extent[0], extent[2], extent[4], 0) >= level;
}

} // namespace palp
