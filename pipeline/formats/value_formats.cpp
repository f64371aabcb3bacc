#include "pipeline/formats/value_formats.h"

#include "pipeline/formats/meshes/refuse.h"
#include "pipeline/model/poly_data.h"

#include <algorithm>
#include <cmath>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace palp
{
namespace
{

// as programs that show images count: each axis from 0
std::string placeOf(std::size_t index, const FileValues& file)
{
  const auto nx = static_cast<std::size_t>(file.voxels[0]);
  const auto ny = static_cast<std::size_t>(file.voxels[1]);
  return nx == 0 ? "value " + std::to_string(index)
                 : "voxel " + std::to_string(index % nx) + "," + std::to_string(index / nx % ny) +
      "," + std::to_string(index / nx / ny);
}

void checkNumbers(const FileValues& file, const std::filesystem::path& name)
{
  const auto odd =
    std::ranges::find_if_not(file.values, [](float value) { return std::isfinite(value); });
  if (odd != file.values.end())
  {
    refuse(name,
      placeOf(static_cast<std::size_t>(odd - file.values.begin()), file) +
        " of it, counted from 0, is no number; write 0 where nothing is known");
  }
}

std::string namesOf(vtkDataSetAttributes& data)
{
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
  {
    const char* name = data.GetArrayName(i);
    names += name != nullptr ? std::string(" ") + name : "";
  }
  return names;
}

} // namespace

FileValues imageValues(const PatientImage& volume, const std::filesystem::path& file)
{
  vtkImageData& image = *volume.image;
  if (image.GetNumberOfScalarComponents() != 1)
  {
    refuse(file, "several values in a voxel, as of regions that overlap; save it with one in each");
  }
  FileValues found;
  image.GetDimensions(found.voxels.data());
  vtkNew<vtkMatrix4x4> toPatient;
  toPatient->DeepCopy(volume.toPatient);
  vtkNew<vtkMatrix4x4> whole;
  vtkMatrix4x4::Multiply4x4(toPatient, image.GetIndexToPhysicalMatrix(), whole);
  int extent[6];
  image.GetExtent(extent); // whose first index is 0 in what is found
  const double first[4] = { static_cast<double>(extent[0]), static_cast<double>(extent[2]),
    static_cast<double>(extent[4]), 1.0 };
  double origin[4];
  whole->MultiplyPoint(first, origin);
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      found.toSpace[4 * row + column] = column == 3
        ? origin[row]
        : whole->GetElement(static_cast<int>(row), static_cast<int>(column));
    }
  }
  vtkDataArray& scalars = *image.GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < scalars.GetNumberOfTuples(); ++i)
  {
    found.values.push_back(
      static_cast<float>(volume.slope * scalars.GetComponent(i, 0) + volume.intercept));
  }
  for (const Segment& segment : volume.segments)
  {
    found.names.push_back({ volume.slope * segment.value + volume.intercept, segment.name });
  }
  found.unit = volume.unit;
  checkNumbers(found, file);
  return found;
}

FileValues arrayValues(
  vtkPolyData& surface, const std::string& array, const std::filesystem::path& file)
{
  vtkDataArray* atPoints = surface.GetPointData()->GetArray(array.c_str());
  vtkDataArray* atCells = surface.GetCellData()->GetArray(array.c_str());
  vtkDataArray* values = atPoints != nullptr ? atPoints : atCells;
  if (values == nullptr || values->GetNumberOfComponents() != 1)
  {
    const std::string there = namesOf(*surface.GetPointData()) + namesOf(*surface.GetCellData());
    refuse(file,
      "no array '" + array + "' with one number at a place; name one of" +
        (there.empty() ? " another file, this has none" : there));
  }
  FileValues found;
  found.points = pointsOf(surface);
  if (values == atCells)
  {
    std::vector<Eigen::Vector3d> middles;
    for (vtkIdType i = 0; i < surface.GetNumberOfCells(); ++i)
    {
      double box[6];
      surface.GetCellBounds(i, box);
      middles.emplace_back(
        0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5]));
    }
    found.points = std::move(middles);
  }
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    found.values.push_back(static_cast<float>(values->GetComponent(i, 0)));
  }
  auto* unit = vtkStringArray::SafeDownCast(surface.GetFieldData()->GetAbstractArray(kUnitArray));
  found.unit =
    unit != nullptr && unit->GetNumberOfValues() == 1 ? unit->GetValue(0) : std::string();
  checkNumbers(found, file);
  return found;
}

} // namespace palp
