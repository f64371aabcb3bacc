#pragma once

#include <array>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

namespace palp
{

/// One component of all voxels of an image.
template <typename Voxel>
struct VoxelLayer
{
  const Voxel* first;
  vtkIdType step;
  vtkIdType count;

  Voxel operator[](vtkIdType i) const
  {
    return first[i * step];
  }
};

/// Place of a voxel in an image of that size, x fastest.
[[nodiscard]] inline std::array<int, 3> indexOf(const int* size, vtkIdType voxel)
{
  const vtkIdType row = voxel / size[0];
  return { static_cast<int>(voxel % size[0]), static_cast<int>(row % size[1]),
    static_cast<int>(row / size[1]) };
}

/// Calls work(voxels of their type).
template <typename Work>
void withVoxels(vtkImageData& image, int layer, Work work)
{
  vtkDataArray& voxels = *image.GetPointData()->GetScalars();
  void* data = voxels.GetVoidPointer(0);
  switch (voxels.GetDataType())
  {
    vtkTemplateMacro(work(VoxelLayer<VTK_TT>{ static_cast<const VTK_TT*>(data) + layer,
      voxels.GetNumberOfComponents(), voxels.GetNumberOfTuples() }));
    default:
      break;
  }
}

} // namespace palp
