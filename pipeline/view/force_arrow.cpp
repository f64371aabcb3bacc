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
constexpr double kMargin = 6.0; // of the label from the edge [pixels]

} // namespace

double ForceArrow::lengthOf(double force, double diagonal) noexcept
{
  return std::clamp(
    force * kLengthPerForce, std::min(kShortest, kLeast * diagonal), kLongest * diagonal);
}

ForceArrow::ForceArrow(vtkRenderer& renderer)
  : layOut_(renderer,
      [this, &renderer](double width, double height, double scale)
      {
        renderer.SetWorldPoint(end_.x(), end_.y(), end_.z(), 1.0);
        renderer.WorldToDisplay();
        const double* at = renderer.GetDisplayPoint();
        double size[2]{};
        label_->GetSize(&renderer, size);
        const double margin = kMargin * scale;
        const double half = 0.5 * size[1];
        const double x = std::max(margin, std::min(at[0], width - margin - size[0]));
        const double y = at[1] + (x < at[0] ? size[1] : 0.0); // off the arrow it would cover
        label_->SetPosition(x, std::max(margin + half, std::min(y, height - margin - half)));
      })
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
  renderer.AddActor2D(label_);
  ForceArrow::hide();
}

void ForceArrow::show(const OverlayState& state)
{
  const double diagonal = vtkPolyData::SafeDownCast(state.press.GetInput())->GetLength();
  const double force = state.sample.response.force;
  const double length = lengthOf(force, diagonal);
  const double thickness =
    std::min({ 0.15 * baseRadius(state.tip), 0.12 * length, kMaxThickness * diagonal });
  source_->SetShaftRadius(thickness / length);
  source_->SetTipRadius(2.6 * thickness / length);
  source_->SetTipLength(std::min(0.5, 7.0 * thickness / length));

  const Contact& contact = state.sample.contact;
  const Eigen::Vector3d start = contact.center - contact.depth * contact.normal;
  arrow_->SetUserMatrix(
    appearance::placement(start, length * appearance::axesAlong(contact.normal, 0)));
  end_ = start + (length + thickness) * contact.normal;
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
