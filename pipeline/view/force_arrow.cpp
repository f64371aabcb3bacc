#include "pipeline/view/force_arrow.h"

#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kLengthPerForce = 0.015; // [m/N]
constexpr double kShortest = 12.0_mm;
// shares of the body's diagonal, whatever the tool: the body stays seen behind the arrow
constexpr double kLeast = 0.05;
constexpr double kLongest = 0.3;
constexpr double kMaxThickness = 0.008;

} // namespace

double ForceArrow::lengthOf(double force, double diagonal) noexcept
{
  return std::clamp(
    force * kLengthPerForce, std::min(kShortest, kLeast * diagonal), kLongest * diagonal);
}

ForceArrow::ForceArrow(vtkRenderer& renderer)
{
  source_->SetTipResolution(32);
  source_->SetShaftResolution(32);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source_->GetOutputPort());
  arrow_->SetMapper(mapper);
  appearance::setColor(*arrow_->GetProperty(), appearance::kForce);
  arrow_->GetProperty()->SetAmbient(0.35);
  renderer.AddActor(arrow_);

  vtkTextProperty& text = *label_->GetTextProperty();
  appearance::setFont(text, 20, appearance::kInk, true);
  text.SetBackgroundColor(1.0, 1.0, 1.0);
  text.SetBackgroundOpacity(0.75);
  text.SetVerticalJustificationToCentered();
  label_->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  renderer.AddActor2D(label_);
  ForceArrow::hide();
}

void ForceArrow::show(const OverlayState& moment)
{
  const double diagonal = vtkPolyData::SafeDownCast(moment.press.GetInput())->GetLength();
  const double force = moment.sample.response.force;
  const double length = lengthOf(force, diagonal);
  const double thickness =
    std::min({ 0.15 * baseRadius(moment.tip), 0.12 * length, kMaxThickness * diagonal });
  source_->SetShaftRadius(thickness / length);
  source_->SetTipRadius(2.6 * thickness / length);
  source_->SetTipLength(std::min(0.5, 7.0 * thickness / length));

  const Contact& contact = moment.sample.contact;
  const Eigen::Vector3d start = contact.center - contact.depth * contact.normal;
  arrow_->SetUserMatrix(
    appearance::placement(start, length * appearance::axesAlong(contact.normal, 0)));
  const Eigen::Vector3d end = start + (length + thickness) * contact.normal;
  label_->GetPositionCoordinate()->SetValue(end.x(), end.y(), end.z());
  const bool isCut = force * kLengthPerForce > length;
  label_->SetInput(
    appearance::fixedText(force, 2).append(isCut ? " N (arrow cut off)" : " N").c_str());
  arrow_->VisibilityOn();
  label_->VisibilityOn();
}

void ForceArrow::hide()
{
  arrow_->VisibilityOff();
  label_->VisibilityOff();
}

} // namespace palp
