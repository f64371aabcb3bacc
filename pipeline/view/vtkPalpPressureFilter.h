/**
 * @class   vtkPalpPressureFilter
 * @brief   the contact pressure on a dent
 *
 * Adds to output 1 of vtkPalpDeformFilter the point array
 *   "Pressure [kPa]"  float, by the array "Distance" [m]; 0 outside the contact
 */

#pragma once

#include "haptics/force/linear/contact_pressure.h"

#include <vtkPolyDataAlgorithm.h>

class vtkPalpPressureFilter : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkPalpPressureFilter, vtkPolyDataAlgorithm);
  static vtkPalpPressureFilter* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The pressure over the distance from the contact's center. Default: none.
   */
  void SetPressure(const palp::ContactPressure& pressure);

protected:
  vtkPalpPressureFilter() = default;
  ~vtkPalpPressureFilter() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPalpPressureFilter(const vtkPalpPressureFilter&) = delete;
  void operator=(const vtkPalpPressureFilter&) = delete;

  palp::ContactPressure Pressure;
};
