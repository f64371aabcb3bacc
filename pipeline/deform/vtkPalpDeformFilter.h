/**
 * @class   vtkPalpDeformFilter
 * @brief   presses a tool into a triangle surface
 *
 * Output 0 is the input with the dent: same topology, points in float [m], and the point arrays
 *   "Normals"       float x 3, unit, outward
 *   "Displacement"  float x 3 [m], from rest
 *   "Zone"          unsigned char, 0 rest, 1 ring, 2 on the tool
 * and the field array "TouchedPoints" (int), the points whose position or normal is not at rest.
 *
 * Output 1 is the dent alone, for overlays and for a view closer than the mesh is fine: the
 * triangles with a displaced corner, divided PatchLevel times, and the point arrays "Normals", and
 *   "Displacement"       float x 3 [m], from rest
 *   "Displacement [mm]"  float, length of the displacement
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
   * Edges of output 1 that are farther from the displaced surface are halved further, up to 6
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

protected:
  vtkPalpDeformFilter();
  ~vtkPalpDeformFilter() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPalpDeformFilter(const vtkPalpDeformFilter&) = delete;
  void operator=(const vtkPalpDeformFilter&) = delete;

  bool TakeInput(vtkPolyData* input);
  void FillPatch(vtkPolyData* patch);
  palp::DentArrays Arrays();

  palp::Press Press;
  palp::Dent Dent;
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
