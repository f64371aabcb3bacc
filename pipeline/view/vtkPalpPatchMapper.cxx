#include "pipeline/view/vtkPalpPatchMapper.h"

#include "pipeline/model/drawing_order.h"
#include "pipeline/model/poly_data.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProgram.h>
#include <vtkUnsignedCharArray.h>
#include <vtk_glew.h>

vtkStandardNewMacro(vtkPalpPatchMapper);

namespace
{

constexpr float kTooLong = 100.0F; // [-] length of the normals of a hidden dent
constexpr vtkIdType kBlock = 64;   // points; one call sends a run of blocks

} // namespace

vtkPalpPatchMapper::vtkPalpPatchMapper()
{
  this->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  this->ScalarVisibilityOff();
}

void vtkPalpPatchMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Padding: " << this->Padding << " m\n"
     << indent << "HideDent: " << this->HideDent << "\n"
     << indent << "SentBytes: " << this->SentBytes << "\n";
}

void vtkPalpPatchMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Current = Built{};
}

double* vtkPalpPatchMapper::GetBounds()
{
  if (!this->GetInput())
  {
    return this->Superclass::GetBounds();
  }
  if (!this->Static)
  {
    this->Update();
  }
  this->ComputeBounds();
  return this->Bounds;
}

void vtkPalpPatchMapper::ComputeBounds()
{
  vtkPolyData* input = this->GetInput();
  // the filter keeps its array of points until it is given another surface
  vtkDataArray* points = input->GetPoints()->GetData();
  const vtkMTimeType topology = input->GetPolys()->GetMTime();
  if (this->BoundsTopology != topology || this->BoundsPoints != points)
  {
    input->GetCellsBounds(this->RestBounds.data());
    this->BoundsTopology = topology;
    this->BoundsPoints = points;
  }
  for (std::size_t i = 0; i < 6; ++i)
  {
    this->Bounds[i] = this->RestBounds[i] + (i % 2 == 0 ? -this->Padding : this->Padding);
  }
}

vtkIntArray* vtkPalpPatchMapper::TouchedPoints()
{
  const bool drawsFloats = !this->ScalarVisibility && this->CurrentInput &&
    vtkFloatArray::SafeDownCast(this->CurrentInput->GetPoints()->GetData()) &&
    vtkFloatArray::SafeDownCast(this->CurrentInput->GetPointData()->GetNormals());
  return drawsFloats
    ? vtkIntArray::SafeDownCast(this->CurrentInput->GetFieldData()->GetArray("TouchedPoints"))
    : nullptr;
}

bool vtkPalpPatchMapper::GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->TouchedPoints())
  {
    this->Current = Built{};
    return this->Superclass::GetNeedToRebuildBufferObjects(renderer, actor);
  }
  const Built wanted{ .Points = this->CurrentInput->GetPoints()->GetData(),
    .Normals = this->CurrentInput->GetPointData()->GetNormals(),
    .Topology = this->CurrentInput->GetPolys()->GetMTime(),
    .Appearance = std::max(actor->GetProperty()->GetMTime(), this->GetMTime()) };
  const bool changed = !(wanted == this->Current);
  this->Current = wanted;
  return changed;
}

void vtkPalpPatchMapper::UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor)
{
  const vtkMTimeType before = this->VBOBuildTime.GetMTime();
  this->Superclass::UpdateBufferObjects(renderer, actor);
  const bool sentAll = this->VBOBuildTime.GetMTime() != before;
  const vtkIdType count = this->CurrentInput->GetNumberOfPoints();
  this->SentBytes = sentAll ? count * 6 * static_cast<vtkIdType>(sizeof(float)) : 0;
  vtkIntArray* touched = this->TouchedPoints();
  if (!touched)
  {
    return;
  }
  vtkDataArray* points = this->CurrentInput->GetPoints()->GetData();
  const vtkMTimeType time = points->GetMTime();
  if (sentAll)
  {
    this->IsMarked.assign(static_cast<std::size_t>(count / kBlock + 1), 0);
    this->Sent.clear();
  }
  else if (time == this->SentTime && this->HideDent == this->SentHidden)
  {
    return;
  }
  this->MarkBlocks(touched);
  if (!sentAll)
  {
    this->SendBlocks("vertexMC", points, false);
  }
  if (!sentAll || this->HideDent)
  {
    this->SendBlocks("normalMC", this->CurrentInput->GetPointData()->GetNormals(), this->HideDent);
  }
  this->SentTime = time;
  this->SentHidden = this->HideDent;
}

void vtkPalpPatchMapper::BuildIBO(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* mesh)
{
  if (!this->TouchedPoints())
  {
    this->Superclass::BuildIBO(renderer, actor, mesh);
    return;
  }
  if (this->OrderedTopology != mesh->GetPolys()->GetMTime())
  {
    this->Ordered = palp::makeCells(palp::inDrawingOrder(
      palp::trianglesOf(*mesh), static_cast<std::size_t>(mesh->GetNumberOfPoints())));
    this->OrderedTopology = mesh->GetPolys()->GetMTime();
  }
  vtkNew<vtkPolyData> ordered;
  ordered->ShallowCopy(mesh);
  ordered->SetPolys(this->Ordered);
  this->Superclass::BuildIBO(renderer, actor, ordered);
}

void vtkPalpPatchMapper::ReplaceShaderNormal(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  // without lighting the shader has no normals
  if (this->VBOs->GetNumberOfComponents("normalMC") == 3 &&
    this->PrimitiveInfo[this->LastBoundBO].LastLightComplexity > 0)
  {
    std::string source = shaders[vtkShader::Fragment]->GetSource();
    vtkShaderProgram::Substitute(source, "//VTK::Normal::Impl",
      "if (dot(normalVCVSOutput, normalVCVSOutput) > 1.5) { discard; }\n"
      "//VTK::Normal::Impl\n",
      false);
    shaders[vtkShader::Fragment]->SetSource(source);
  }
  this->Superclass::ReplaceShaderNormal(shaders, renderer, actor);
  if (!shaders[vtkShader::Geometry]->GetSource().empty())
  {
    return; // which passes the normals on
  }
  // a pixel of several samples may have its middle beside the triangle, where lengths mean nothing
  for (const auto& [type, word] :
    { std::pair(vtkShader::Vertex, "out "), std::pair(vtkShader::Fragment, "in ") })
  {
    std::string source = shaders[type]->GetSource();
    const std::string normal = std::string(word) + "vec3 normalVCVSOutput";
    vtkShaderProgram::Substitute(source, normal, "centroid " + normal);
    shaders[type]->SetSource(source);
  }
}

// blocks that are dented now go to Sent, these and the ones dented before to Marked
void vtkPalpPatchMapper::MarkBlocks(vtkIntArray* touched)
{
  this->Marked.clear();
  const int* points = touched->GetPointer(0);
  for (vtkIdType i = 0; i < touched->GetNumberOfValues(); ++i)
  {
    const vtkIdType block = points[i] / kBlock;
    if (!this->IsMarked[static_cast<std::size_t>(block)])
    {
      this->IsMarked[static_cast<std::size_t>(block)] = 1;
      this->Marked.push_back(block);
    }
  }
  const std::size_t now = this->Marked.size();
  for (const vtkIdType block : this->Sent)
  {
    if (!this->IsMarked[static_cast<std::size_t>(block)])
    {
      this->Marked.push_back(block);
    }
  }
  this->Sent.assign(this->Marked.begin(), this->Marked.begin() + static_cast<std::ptrdiff_t>(now));
  for (const vtkIdType block : this->Sent)
  {
    this->IsMarked[static_cast<std::size_t>(block)] = 0;
  }
  std::sort(this->Marked.begin(), this->Marked.end());
}

void vtkPalpPatchMapper::SendBlocks(const char* buffer, vtkDataArray* data, bool hide)
{
  vtkOpenGLVertexBufferObject* vbo = this->VBOs->GetVBO(buffer);
  if (!vbo || this->Marked.empty())
  {
    return;
  }
  const auto* values = static_cast<const float*>(data->GetVoidPointer(0));
  const vtkIdType tuple = 3 * static_cast<vtkIdType>(sizeof(float));
  glBindBuffer(GL_ARRAY_BUFFER, vbo->GetHandle());
  for (std::size_t i = 0; i < this->Marked.size();)
  {
    std::size_t end = i + 1;
    while (end < this->Marked.size() && this->Marked[end] == this->Marked[end - 1] + 1)
    {
      ++end;
    }
    const vtkIdType from = this->Marked[i] * kBlock;
    const vtkIdType to = std::min((this->Marked[end - 1] + 1) * kBlock, data->GetNumberOfTuples());
    const float* first = hide ? this->Hidden(values, from, to) : values + 3 * from;
    glBufferSubData(GL_ARRAY_BUFFER, from * tuple, (to - from) * tuple, first);
    this->SentBytes += (to - from) * tuple;
    i = end;
  }
  glBindBuffer(GL_ARRAY_BUFFER, 0);
}

// the normals of a range of points, too long where the point is displaced
const float* vtkPalpPatchMapper::Hidden(const float* normals, vtkIdType from, vtkIdType to)
{
  auto* zone =
    vtkUnsignedCharArray::SafeDownCast(this->CurrentInput->GetPointData()->GetArray("Zone"));
  this->Lengthened.assign(normals + 3 * from, normals + 3 * to);
  for (vtkIdType point = from; zone && point < to; ++point)
  {
    if (zone->GetValue(point) != 0)
    {
      float* normal = this->Lengthened.data() + 3 * (point - from);
      std::transform(normal, normal + 3, normal, [](float x) { return kTooLong * x; });
    }
  }
  return this->Lengthened.data();
}
