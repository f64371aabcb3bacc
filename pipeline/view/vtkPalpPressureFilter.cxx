#include "pipeline/view/vtkPalpPressureFilter.h"

#include "haptics/units.h"

#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkPalpPressureFilter);

void vtkPalpPressureFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Pressure at the center: " << this->Pressure.at(0.0) << " Pa\n";
}

void vtkPalpPressureFilter::SetPressure(const palp::ContactPressure& pressure)
{
  this->Pressure = pressure;
  this->Modified();
}

int vtkPalpPressureFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  output->ShallowCopy(input);
  auto* distance = vtkFloatArray::SafeDownCast(input->GetPointData()->GetArray("Distance"));
  if (!distance)
  {
    if (input->GetNumberOfPoints() == 0)
    {
      return 1; // no contact, no patch
    }
    vtkErrorMacro("Input 0 has no point array \"Distance\" of floats.");
    return 0;
  }
  vtkNew<vtkFloatArray> pressure;
  pressure->SetName("Pressure [kPa]");
  pressure->SetNumberOfTuples(distance->GetNumberOfTuples());
  for (vtkIdType i = 0; i < distance->GetNumberOfTuples(); ++i)
  {
    const double pascals = this->Pressure.at(distance->GetValue(i));
    pressure->SetValue(i, static_cast<float>(palp::units::toKilopascals(pascals)));
  }
  output->GetPointData()->AddArray(pressure);
  return 1;
}
