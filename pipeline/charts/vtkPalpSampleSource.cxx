#include "pipeline/charts/vtkPalpSampleSource.h"

#include "haptics/units.h"

#include <cmath>
#include <utility>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkPalpSampleSource);

namespace
{

vtkNew<vtkFloatArray> column(vtkTable* table, const char* name, std::size_t capacity)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->Allocate(static_cast<vtkIdType>(capacity));
  table->AddColumn(array);
  return array;
}

} // namespace

vtkPalpSampleSource::vtkPalpSampleSource()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
  this->Depths.reserve(Points);
}

void vtkPalpSampleSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Span: " << this->Span << " s\n"
     << indent << "From: " << this->From << " s\n"
     << indent << "To: " << this->To << " s\n"
     << indent << "FirstTime: " << this->FirstTime << " s\n"
     << indent << "LastTime: " << this->LastTime << " s\n"
     << indent << "Depths: " << this->Depths.size() << " points\n";
}

void vtkPalpSampleSource::SetSpan(double seconds)
{
  this->Span = seconds;
  this->Time = palp::SampleColumns(seconds, Finest);
  this->LookAt(0.0, seconds);
  this->Modified();
}

void vtkPalpSampleSource::LookAt(double from, double to)
{
  if (this->From != from || this->To != to)
  {
    this->From = from;
    this->To = to;
    this->Modified();
  }
}

void vtkPalpSampleSource::AddSample(const palp::Sample& sample)
{
  const double depth = sample.contact.depth;
  const double force = sample.response.force;
  if (!std::isfinite(sample.time) || !std::isfinite(depth) || !std::isfinite(force))
  {
    return;
  }
  this->Time.add(sample.time, force);
  this->FirstTime = std::exchange(this->Empty, false) ? sample.time : this->FirstTime;
  this->LastTime = sample.time;

  constexpr double kVisible = 2e-5; // [m], a tenth of a pixel where 10 mm fill a chart
  const std::size_t last = (this->NextDepth + Points - 1) % Points;
  const bool isNew = this->Depths.empty() || std::abs(this->Depths[last].Depth - depth) > kVisible;
  if (depth > 0.0 && isNew)
  {
    if (this->Depths.size() < Points)
    {
      this->Depths.push_back({ depth, force, sample.time });
    }
    else
    {
      this->Depths[this->NextDepth] = { depth, force, sample.time };
    }
    this->NextDepth = (this->NextDepth + 1) % Points;
  }
  this->Modified();
}

void vtkPalpSampleSource::Clear()
{
  this->Time.clear();
  this->Depths.clear();
  this->NextDepth = 0;
  this->Empty = true;
  this->FirstTime = this->LastTime = 0.0;
  this->Modified();
}

int vtkPalpSampleSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkTable* overTime = vtkTable::GetData(outputVector, 0);
  const auto times = column(overTime, "time [s]", 2 * Columns);
  const auto forces = column(overTime, "force [N]", 2 * Columns);
  this->Time.forEach(this->From, this->To, (this->To - this->From) / Columns,
    [&](const palp::SampleColumns::Column& at)
    {
      for (const bool isFirst : { true, false })
      {
        const double force = isFirst == at.isFalling ? at.largest : at.least;
        times->InsertNextValue(static_cast<float>(at.start));
        forces->InsertNextValue(static_cast<float>(force));
      }
    });

  vtkTable* overDepth = vtkTable::GetData(outputVector, 1);
  const auto depths = column(overDepth, "depth [mm]", Points);
  const auto answers = column(overDepth, "force [N]", Points);
  for (const Point& point : this->Depths)
  {
    if (point.Time >= this->LastTime - this->Span)
    {
      depths->InsertNextValue(static_cast<float>(palp::units::toMillimeters(point.Depth)));
      answers->InsertNextValue(static_cast<float>(point.Force));
    }
  }
  return 1;
}
