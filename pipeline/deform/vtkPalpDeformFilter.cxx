#include "pipeline/deform/vtkPalpDeformFilter.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkFieldData.h>
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
  this->SetNumberOfInputPorts(2);
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

int vtkPalpDeformFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == 1 ? 1 : 0);
  return 1;
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
  this->Deepen();

  const bool moves = this->Press.motion != nullptr;
  if (moves)
  {
    this->MoveBody();
  }
  else
  {
    const auto touched = this->Dent.region().points();
    const auto besides = this->Dent.besides();
    this->Touched->SetNumberOfValues(static_cast<vtkIdType>(touched.size() + besides.size()));
    int* const end = std::copy(touched.begin(), touched.end(), this->Touched->GetPointer(0));
    std::copy(besides.begin(), besides.end(), end);
  }
  output->ShallowCopy(input);
  output->SetPoints(moves ? this->MovedPoints : this->Points);
  output->GetPointData()->SetNormals(moves ? this->MovedNormals : this->Normals);
  output->GetPointData()->AddArray(moves ? this->MovedDisplacement : this->Displacement);
  output->GetPointData()->AddArray(this->Zone);
  output->GetFieldData()->AddArray(this->Touched);
  output->GetPoints()->Modified();
  output->GetPointData()->GetNormals()->Modified();
  output->GetPointData()->GetArray("Displacement")->Modified();
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
  this->Moved = {};

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

// every point, on top of its dent
void vtkPalpDeformFilter::MoveBody()
{
  const vtkIdType count = this->Zone->GetNumberOfTuples();
  if (!this->Moved.isOf(this->Press.motion.get()))
  {
    const auto size = static_cast<std::size_t>(3 * count);
    this->Moved = { this->Press.motion, { this->RestPositions->GetPointer(0), size } };
    this->MovedPoints = vtkSmartPointer<vtkPoints>::New();
    this->MovedPoints->SetData(floats("Points", 3, count));
    this->MovedNormals = floats("Normals", 3, count);
    this->MovedDisplacement = floats("Displacement", 3, count);
  }
  this->Moved.load(this->Press.loads);
  this->Moved.move(this->Displacement->GetPointer(0), this->Normals->GetPointer(0),
    { .points = static_cast<float*>(this->MovedPoints->GetVoidPointer(0)),
      .normals = this->MovedNormals->GetPointer(0),
      .displacement = this->MovedDisplacement->GetPointer(0) });
  if (this->Touched->GetNumberOfValues() != count)
  {
    this->Touched->SetNumberOfValues(count);
  }
  std::iota(this->Touched->GetPointer(0), this->Touched->GetPointer(0) + count, 0);
}

// as the triangles of the surface move that its points lie on
void vtkPalpDeformFilter::MovePatch()
{
  const auto shared = this->Dent.region().points();
  this->PatchMoved.clear();
  for (std::size_t i = 0; i < this->Patch.points.size(); ++i)
  {
    if (i < shared.size())
    {
      this->PatchMoved.push_back(this->Moved.at(shared[i]));
      continue;
    }
    const auto [a, b] = this->Patch.between(i);
    const auto& first = this->PatchMoved[a];
    const auto& second = this->PatchMoved[b];
    this->PatchMoved.push_back(
      { 0.5F * (first.move + second.move), 0.5F * (first.turn + second.turn) });
  }
}

Eigen::Vector3d vtkPalpDeformFilter::WithBody(
  const Eigen::Vector3d& point, const Eigen::Vector3d& place) const
{
  if (!this->Press.motion)
  {
    return point;
  }
  const palp::OrganMotion::Moved moved = this->Press.motion->movedAt(place, this->Press.loads);
  return point + palp::vectorOf(moved.move) + palp::vectorOf(moved.turn).cross(point - place);
}

// in the body at rest, whatever moves that
void vtkPalpDeformFilter::Deepen()
{
  if (this->GetNumberOfInputConnections(1) == 0)
  {
    return;
  }
  auto* other = SafeDownCast(this->GetInputAlgorithm(1, 0));
  if (other && other->Points &&
    other->Points->GetNumberOfPoints() == this->Points->GetNumberOfPoints())
  {
    this->Dent.deepen(other->Dent.region().points(), other->Arrays(), this->Arrays());
  }
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
  const bool moves = this->Press.motion != nullptr;
  moves ? this->MovePatch() : this->PatchMoved.clear();
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
    Eigen::Vector3f point = this->Patch.points[at];
    Eigen::Vector3f normal = this->Patch.normals[at];
    Eigen::Vector3f displacement = this->Patch.displacement[at];
    const double millimeters = palp::units::toMillimeters(static_cast<double>(displacement.norm()));
    if (moves)
    {
      const palp::OrganMotion::Moved& moved = this->PatchMoved[at];
      const Eigen::Vector3f turn = palp::vectorOf(moved.turn).cast<float>();
      const Eigen::Vector3f by =
        palp::vectorOf(moved.move).cast<float>() + turn.cross(displacement);
      point += by;
      displacement += by;
      normal = (normal + turn.cross(normal)).normalized();
    }
    this->PatchPositions->SetTypedTuple(i, point.data());
    this->PatchNormals->SetTypedTuple(i, normal.data());
    this->PatchDisplacement->SetTypedTuple(i, displacement.data());
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
