#include "pipeline/deform/vtkPalpDeformFilter.h"

#include "haptics/units.h"

#include <algorithm>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkPalpDeformFilter);

namespace
{

vtkSmartPointer<vtkFloatArray> floats(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

// false when a polygon is not a triangle of the surface's points
bool readTriangles(vtkCellArray* polys, vtkIdType pointCount, std::vector<palp::Triangle>& out)
{
  out.reserve(static_cast<std::size_t>(polys->GetNumberOfCells()));
  const auto cells = vtk::TakeSmartPointer(polys->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(size, ids);
    const auto isPoint = [pointCount](vtkIdType id) { return id >= 0 && id < pointCount; };
    if (size != 3 || !std::all_of(ids, ids + size, isPoint))
    {
      return false;
    }
    out.push_back({ static_cast<int>(ids[0]), static_cast<int>(ids[1]), static_cast<int>(ids[2]) });
  }
  return true;
}

} // namespace

vtkPalpDeformFilter::vtkPalpDeformFilter()
{
  this->SetNumberOfOutputPorts(2);
  this->Touched->SetName("TouchedPoints");
  this->PatchNormals->SetName("Normals");
  this->PatchDisplacement->SetName("Displacement");
  this->PatchLength->SetName("Displacement [mm]");
  this->PatchDistance->SetName("Distance");
  this->PatchZone->SetName("Zone");
  for (vtkFloatArray* array :
    { this->PatchPositions.Get(), this->PatchNormals.Get(), this->PatchDisplacement.Get() })
  {
    array->SetNumberOfComponents(3);
  }
}

void vtkPalpDeformFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Depth: " << this->Press.contact.depth << " m\n"
     << indent << "ContactRadius: " << this->Press.contactRadius << " m\n"
     << indent << "ExtentRadius: " << this->Press.extentRadius << " m\n"
     << indent << "RingRadius: " << this->Dent.region().outer() << " m\n"
     << indent << "GeneratePatch: " << this->GeneratePatch << "\n"
     << indent << "PatchLevel: " << this->PatchLevel << "\n"
     << indent << "PatchTolerance: " << this->PatchTolerance << "\n";
}

void vtkPalpDeformFilter::SetPress(const palp::Press& press)
{
  this->Press = press;
  this->Modified();
}

int vtkPalpDeformFilter::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

int vtkPalpDeformFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!input->GetPoints() || input->GetNumberOfPolys() == 0)
  {
    vtkErrorMacro("Input 0 has no triangles.");
    return 0;
  }
  if (!this->TakeInput(input))
  {
    vtkErrorMacro("Input 0 has a polygon that is not a triangle; use vtkTriangleFilter before.");
    return 0;
  }
  this->Dent.update(this->Press, this->Arrays());

  const auto touched = this->Dent.region().points();
  this->Touched->SetNumberOfValues(static_cast<vtkIdType>(touched.size()));
  std::copy(touched.begin(), touched.end(), this->Touched->GetPointer(0));

  output->ShallowCopy(input);
  output->SetPoints(this->Points);
  output->GetPointData()->SetNormals(this->Normals);
  output->GetPointData()->AddArray(this->Displacement);
  output->GetPointData()->AddArray(this->Zone);
  output->GetFieldData()->AddArray(this->Touched);
  this->Points->Modified();
  this->Normals->Modified();
  this->Displacement->Modified();
  this->Zone->Modified();
  this->Touched->Modified();

  if (this->GeneratePatch)
  {
    this->FillPatch(vtkPolyData::GetData(outputVector, 1));
  }
  return 1;
}

// builds everything anew when the points or triangles of the input are not those of the last update
bool vtkPalpDeformFilter::TakeInput(vtkPolyData* input)
{
  vtkPoints* points = input->GetPoints();
  vtkCellArray* polys = input->GetPolys();
  const vtkMTimeType time = std::max(points->GetMTime(), polys->GetMTime());
  if (this->RestPoints == points && this->RestPolys == polys && this->RestTime == time)
  {
    return true;
  }
  const vtkIdType count = points->GetNumberOfPoints();
  std::vector<palp::Triangle> triangles;
  this->RestPoints = nullptr;
  if (!readTriangles(polys, count, triangles))
  {
    return false;
  }
  this->RestPositions = vtkFloatArray::SafeDownCast(points->GetData());
  if (!this->RestPositions)
  {
    this->RestPositions = floats("Points", 3, count);
    this->RestPositions->DeepCopy(points->GetData());
  }
  this->RestPoints = points;
  this->RestPolys = polys;
  this->RestTime = time;

  const auto size = static_cast<std::size_t>(3 * count);
  this->Dent = palp::Dent({ this->RestPositions->GetPointer(0), size }, triangles);
  this->Points = vtkSmartPointer<vtkPoints>::New();
  this->Points->SetData(floats("Points", 3, count));
  this->Normals = floats("Normals", 3, count);
  this->Displacement = floats("Displacement", 3, count);
  this->Zone = vtkSmartPointer<vtkUnsignedCharArray>::New();
  this->Zone->SetName("Zone");
  this->Zone->SetNumberOfTuples(count);
  this->Dent.reset(this->Arrays());
  return true;
}

palp::DentArrays vtkPalpDeformFilter::Arrays()
{
  return { .points = static_cast<float*>(this->Points->GetVoidPointer(0)),
    .normals = this->Normals->GetPointer(0),
    .displacement = this->Displacement->GetPointer(0),
    .zone = this->Zone->GetPointer(0) };
}

void vtkPalpDeformFilter::FillPatch(vtkPolyData* patch)
{
  this->UsedPatchLevel =
    this->PatchLevel < 0 ? palp::DentPatch::levelFor(this->Dent) : this->PatchLevel;
  this->Patch.build(this->Dent, this->UsedPatchLevel, this->PatchTolerance);
  const auto count = static_cast<vtkIdType>(this->Patch.points.size());
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(this->PatchPositions),
         static_cast<vtkDataArray*>(this->PatchNormals),
         static_cast<vtkDataArray*>(this->PatchDisplacement),
         static_cast<vtkDataArray*>(this->PatchLength),
         static_cast<vtkDataArray*>(this->PatchDistance),
         static_cast<vtkDataArray*>(this->PatchZone) })
  {
    array->SetNumberOfTuples(count); // keeps memory that is large enough
    array->Modified();
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    this->PatchPositions->SetTypedTuple(i, this->Patch.points[at].data());
    this->PatchNormals->SetTypedTuple(i, this->Patch.normals[at].data());
    const Eigen::Vector3f& displacement = this->Patch.displacement[at];
    this->PatchDisplacement->SetTypedTuple(i, displacement.data());
    const double millimeters = palp::units::toMillimeters(static_cast<double>(displacement.norm()));
    this->PatchLength->SetValue(i, static_cast<float>(millimeters));
    this->PatchDistance->SetValue(i, this->Patch.distance[at]);
    this->PatchZone->SetValue(i, static_cast<unsigned char>(this->Patch.zone[at]));
  }
  this->PatchTriangles->Reset();
  for (const palp::Triangle& triangle : this->Patch.triangles)
  {
    const vtkIdType corners[] = { triangle[0], triangle[1], triangle[2] };
    this->PatchTriangles->InsertNextCell(3, corners);
  }
  this->PatchTriangles->Modified();
  this->PatchPoints->SetData(this->PatchPositions);
  this->PatchPoints->Modified();
  patch->SetPoints(this->PatchPoints);
  patch->SetPolys(this->PatchTriangles);
  patch->GetPointData()->SetNormals(this->PatchNormals);
  patch->GetPointData()->AddArray(this->PatchDisplacement);
  patch->GetPointData()->AddArray(this->PatchLength);
  patch->GetPointData()->AddArray(this->PatchDistance);
  patch->GetPointData()->AddArray(this->PatchZone);
}
