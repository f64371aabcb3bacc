/**
 * @class   vtkPalpDeformFilter
 * @brief   presses a tool into a triangle surface
 *
 * Input 1, which may be missing, is output 0 of another such filter with the same input 0: each
 * point of output 0 goes where the deeper of both dents has it, in a body at rest that this filter
 * then moves.
 *
 * Output 0 is the input with the dent: same topology, points in float [m], and the point arrays
 *   "Normals"       float x 3, unit, outward
 *   "Displacement"  float x 3 [m], from rest
 *   "Zone"          unsigned char, 0 rest, 1 ring, 2 on the tool
 * and the field array "TouchedPoints" (int), the points whose position or normal is not at rest:
 * all of them where the press moves the body as a whole, by which every point and normal is moved.
 *
 * Output 1 is the dent alone, for overlays and for a view closer than the mesh is fine: the
 * triangles with a displaced corner, divided PatchLevel times, and the point arrays "Normals", and
 *   "Displacement"       float x 3 [m], from rest
 *   "Displacement [mm]"  float, length of the displacement, without the body's own motion
 *   "Distance"           float [m], from the contact's center along the undeformed surface
 *   "Zone"               as above
 * It costs nothing until GeneratePatch is on; its arrays are changed in place, too.
 *
 * The arrays of output 0 are made once for an input and then changed in place, at a cost that
 * follows the dent. They are marked modified, as any filter's; a mapper that would send all of
 * them again can send the touched ones alone (vtkPalpPatchMapper).
 */

#pragma once

#include "pipeline/deform/dent.h"
#include "pipeline/deform/dent_patch.h"
#include "pipeline/motion/moved_surface.h"

#include <memory>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkUnsignedCharArray.h>

class vtkPalpDeformFilter : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkPalpDeformFilter, vtkPolyDataAlgorithm);
  static vtkPalpDeformFilter* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The press, in the frame of the input [m]. Default: none, which gives the surface at rest.
   */
  void SetPress(const palp::Press& press);
  const palp::Press& GetPress() const
  {
    return this->Press;
  }
  ///@}

  ///@{
  /**
   * Whether output 1 is made. Default: off.
   */
  vtkSetMacro(GeneratePatch, bool);
  vtkGetMacro(GeneratePatch, bool);
  vtkBooleanMacro(GeneratePatch, bool);
  ///@}

  ///@{
  /**
   * How often the edges of output 1 are halved, 0 to 6; -1 takes what makes the contact look
   * round. Default: -1.
   */
  vtkSetClampMacro(PatchLevel, int, -1, 6);
  vtkGetMacro(PatchLevel, int);
  ///@}

  ///@{
  /**
   * Edges of output 1 that are farther from the displaced surface are halved further, up to 7
   * times [m]; 0: none. Default: 0.
   */
  vtkSetClampMacro(PatchTolerance, double, 0.0, 1.0);
  vtkGetMacro(PatchTolerance, double);
  ///@}

  /**
   * How often they were halved by the last update.
   */
  vtkGetMacro(UsedPatchLevel, int);

  /**
   * The dent after the last update.
   */
  const palp::Dent& GetDent() const
  {
    return this->Dent;
  }

  /**
   * Output 1 after the last update that made it.
   */
  const palp::DentPatch& GetPatch() const
  {
    return this->Patch;
  }

  /**
   * Where a point is that goes along with a place of the surface at rest, as the body moved in the
   * last update; where the body stays, as it is.
   */
  Eigen::Vector3d WithBody(const Eigen::Vector3d& point, const Eigen::Vector3d& place) const;

protected:
  vtkPalpDeformFilter();
  ~vtkPalpDeformFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPalpDeformFilter(const vtkPalpDeformFilter&) = delete;
  void operator=(const vtkPalpDeformFilter&) = delete;

  bool TakeInput(vtkPolyData* input);
  void Deepen();
  void FillPatch(vtkPolyData* patch);
  palp::DentArrays Arrays();
  void MoveBody();
  void MovePatch();

  palp::Press Press;
  palp::Dent Dent;
  palp::MovedSurface Moved; // of the rest position
  palp::DentPatch Patch;
  bool GeneratePatch = false;
  int PatchLevel = -1;
  double PatchTolerance = 0.0;
  int UsedPatchLevel = 0;

  // what the dent was built from
  vtkSmartPointer<vtkPoints> RestPoints;
  vtkSmartPointer<vtkCellArray> RestPolys;
  vtkMTimeType RestTime = 0;
  vtkSmartPointer<vtkFloatArray> RestPositions; // of RestPoints, or a copy in float

  // output 0, kept from update to update
  vtkSmartPointer<vtkPoints> Points;
  vtkSmartPointer<vtkFloatArray> Normals;
  vtkSmartPointer<vtkFloatArray> Displacement;
  vtkSmartPointer<vtkUnsignedCharArray> Zone;
  vtkNew<vtkIntArray> Touched;

  // output 0 where the body moves: of the above, moved
  vtkSmartPointer<vtkPoints> MovedPoints;
  vtkSmartPointer<vtkFloatArray> MovedNormals;
  vtkSmartPointer<vtkFloatArray> MovedDisplacement;

  std::vector<palp::OrganMotion::Moved> PatchMoved; // of each point, where the body moves

  // output 1, the same
  vtkNew<vtkPoints> PatchPoints;
  vtkNew<vtkFloatArray> PatchPositions;
  vtkNew<vtkFloatArray> PatchNormals;
  vtkNew<vtkFloatArray> PatchDisplacement;
  vtkNew<vtkFloatArray> PatchLength; // of the displacement
  vtkNew<vtkFloatArray> PatchDistance;
  vtkNew<vtkUnsignedCharArray> PatchZone;
  vtkNew<vtkCellArray> PatchTriangles;
};
