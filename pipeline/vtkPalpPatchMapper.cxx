#include "pipeline/vtkPalpPatchMapper.h"

#include <algorithm>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtk_glew.h>

vtkStandardNewMacro(vtkPalpPatchMapper);

namespace
{

constexpr vtkIdType kBlock = 64; // points; one call sends a run of blocks

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
  const vtkMTimeType topology = input->GetPolys()->GetMTime();
  if (this->BoundsTopology != topology)
  {
    input->GetCellsBounds(this->RestBounds.data());
    this->BoundsTopology = topology;
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
  vtkIntArray* touched = this->TouchedPoints();
  const bool sentAll = this->VBOBuildTime.GetMTime() != before;
  const vtkIdType count = this->CurrentInput->GetNumberOfPoints();
  this->SentBytes = sentAll ? count * 6 * static_cast<vtkIdType>(sizeof(float)) : 0;
  if (!touched)
  {
    return;
  }
  if (sentAll)
  {
    this->IsMarked.assign(static_cast<std::size_t>(count / kBlock + 1), 0);
    this->Sent.clear();
  }
  this->MarkBlocks(touched);
  if (!sentAll)
  {
    this->SendBlocks("vertexMC", this->CurrentInput->GetPoints()->GetData());
    this->SendBlocks("normalMC", this->CurrentInput->GetPointData()->GetNormals());
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

void vtkPalpPatchMapper::SendBlocks(const char* buffer, vtkDataArray* data)
{
  vtkOpenGLVertexBufferObject* vbo = this->VBOs->GetVBO(buffer);
  if (!vbo || this->Marked.empty())
  {
    return;
  }
  const vtkIdType tuple = 3 * static_cast<vtkIdType>(sizeof(float));
  const auto* first = static_cast<const unsigned char*>(data->GetVoidPointer(0));
  glBindBuffer(GL_ARRAY_BUFFER, vbo->GetHandle());
  for (std::size_t i = 0; i < this->Marked.size();)
  {
    std::size_t end = i + 1;
    while (end < this->Marked.size() && this->Marked[end] == this->Marked[end - 1] + 1)
    {
      ++end;
    }
    const vtkIdType from = this->Marked[i] * kBlock * tuple;
    const vtkIdType to =
      std::min((this->Marked[end - 1] + 1) * kBlock, data->GetNumberOfTuples()) * tuple;
    glBufferSubData(GL_ARRAY_BUFFER, from, to - from, first + from);
    this->SentBytes += to - from;
    i = end;
  }
  glBindBuffer(GL_ARRAY_BUFFER, 0);
}
