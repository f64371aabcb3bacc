/**
 * @class   vtkPalpPatchMapper
 * @brief   draws the output of vtkPalpDeformFilter and sends only what changed
 *
 * VTK's mapper sends all points and builds all indices again whenever the points are modified.
 * This one does so when the topology, the arrays themselves or the appearance changed; otherwise
 * it sends the blocks of points that are in the field array "TouchedPoints" now or were in it
 * when it last sent. An input without that array, or drawn with scalars, is drawn as usual.
 *
 * Triangles are sent in an order that shades a corner once, not once a triangle, for a mesh of any
 * order; so the cells of a hardware selection are not those of the input.
 *
 * Where the dent is drawn by somebody else, finer (output 1 of the filter), HideDent leaves its
 * triangles out: their displaced corners are sent with normals too long to be true, and the
 * fragment shader discards what has such a normal, whatever the order of the triangles.
 *
 * Units are kept (no shift and scale), and the bounds are those of the first update padded by
 * Padding, so that neither follows the dent.
 */

#pragma once

#include <array>
#include <vector>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

class vtkCellArray;
class vtkDataArray;
class vtkIntArray;

class vtkPalpPatchMapper : public vtkOpenGLPolyDataMapper
{
public:
  vtkTypeMacro(vtkPalpPatchMapper, vtkOpenGLPolyDataMapper);
  static vtkPalpPatchMapper* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How far a dent may lead out of the box of the surface at rest [m]. Default: 0.02.
   */
  vtkSetClampMacro(Padding, double, 0.0, 1.0);
  vtkGetMacro(Padding, double);
  ///@}

  ///@{
  /**
   * Whether the triangles with a displaced corner are left out. Default: off.
   */
  void SetHideDent(bool hide)
  {
    this->HideDent = hide;
  }
  vtkGetMacro(HideDent, bool);
  ///@}

  ///@{
  /**
   * Bytes sent to the graphics memory by the last render, for tests and benchmarks; the size of
   * everything when all was sent.
   */
  vtkGetMacro(SentBytes, vtkIdType);
  ///@}

  double* GetBounds() override;
  void GetBounds(double bounds[6]) override
  {
    this->Superclass::GetBounds(bounds);
  }
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPalpPatchMapper();
  ~vtkPalpPatchMapper() override = default;

  void ComputeBounds() override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void UpdateBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildIBO(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* mesh) override;
  void ReplaceShaderNormal(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;

private:
  vtkPalpPatchMapper(const vtkPalpPatchMapper&) = delete;
  void operator=(const vtkPalpPatchMapper&) = delete;

  // everything but the touched points that the buffers were built from
  struct Built
  {
    const void* Points = nullptr;
    const void* Normals = nullptr;
    vtkMTimeType Topology = 0;
    vtkMTimeType Appearance = 0;
    bool operator==(const Built&) const = default;
  };

  vtkIntArray* TouchedPoints();
  void MarkBlocks(vtkIntArray* touched);
  void SendBlocks(const char* buffer, vtkDataArray* data, bool hide);
  const float* Hidden(const float* normals, vtkIdType from, vtkIdType to);

  vtkSmartPointer<vtkCellArray> Ordered; // the triangles as they are sent
  vtkMTimeType OrderedTopology = 0;      // what they were made from
  double Padding = 0.02;
  bool HideDent = false;
  bool SentHidden = false;
  vtkMTimeType SentTime = 0;
  std::vector<float> Lengthened; // normals on their way
  vtkIdType SentBytes = 0;
  Built Current;
  std::array<double, 6> RestBounds{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  vtkMTimeType BoundsTopology = 0;
  vtkWeakPointer<vtkDataArray> BoundsPoints;
  std::vector<unsigned char> IsMarked; // one for each block of points
  std::vector<vtkIdType> Marked;       // blocks to send
  std::vector<vtkIdType> Sent;         // blocks not at rest in the graphics memory
};
