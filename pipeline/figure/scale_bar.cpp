#include "pipeline/figure/scale_bar.h"

#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkPoints.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

constexpr double kLongest = 160.0; // [pixels]
constexpr double kRight = 130.0;   // [pixels], beside the axes in the corner

// the largest of 1, 2 or 5 times a power of ten that is not above a value
double roundDown(double most)
{
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double mantissa = most / power;
  return power * (mantissa >= 5.0 ? 5.0 : mantissa >= 2.0 ? 2.0 : 1.0);
}

} // namespace

ScaleBar::ScaleBar(vtkRenderer& renderer)
  : renderer_(renderer)
  , layOut_(renderer, [this, &renderer](const PictureRoom& room) { place(renderer, room); })
{
  appearance::makeInkLine(*bar_, *actor_, 6); // an end, the bar, an end
  renderer.AddActor2D(actor_);
  vtkTextProperty& text = *text_->GetTextProperty();
  appearance::setFont(text, 14, appearance::kInk, true);
  text.SetJustificationToCentered();
  renderer.AddActor2D(text_);
  setVisible(false);
}

void ScaleBar::setVisible(bool visible)
{
  setMarks(renderer_, visible ? kLongest + kRight : 0.0);
  actor_->SetVisibility(visible);
  text_->SetVisibility(visible);
}

void ScaleBar::setInk(const std::array<double, 3>& ink)
{
  actor_->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  text_->GetTextProperty()->SetColor(ink[0], ink[1], ink[2]);
}

void ScaleBar::setPlace(const std::optional<Eigen::Vector3d>& contact)
{
  contact_ = contact;
}

void ScaleBar::place(vtkRenderer& renderer, const PictureRoom& room)
{
  constexpr double kInset = 16.0; // from the left side, at least
  constexpr double kBottom = 24.0;
  constexpr double kEnd = 5.0;
  const double scale = room.scale;
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Eigen::Vector3d eye(camera.GetPosition());
  const double ahead =
    contact_ ? Eigen::Vector3d(camera.GetDirectionOfProjection()).dot(*contact_ - eye) : 0.0;
  const double seen = 2.0 * (ahead > 0.0 ? ahead : camera.GetDistance()) *
    std::tan(0.5 * vtkMath::RadiansFromDegrees(camera.GetViewAngle()));
  const double pixel = seen / room.height; // [m]
  const double right = room.width - kRight * scale;
  const double most = std::clamp(right - kInset * scale, 1.0, kLongest * scale);
  length_ = units::fromMillimeters(roundDown(units::toMillimeters(most * pixel)));
  const double left = right - length_ / pixel;
  const double y = room.foot + kBottom * scale;
  const double end = kEnd * scale;
  const std::array<std::array<double, 2>, 6> corners{ { { left, y + end }, { left, y - end },
    { left, y }, { right, y }, { right, y - end }, { right, y + end } } };
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    bar_->GetPoints()->SetPoint(static_cast<vtkIdType>(i), corners[i][0], corners[i][1], 0.0);
  }
  bar_->GetPoints()->Modified();
  actor_->GetProperty()->SetLineWidth(static_cast<float>(2.0 * scale));
  text_->SetInput((appearance::roundText(units::toMillimeters(length_)) + " mm").c_str());
  text_->SetPosition(0.5 * (left + right), y + end + 2.0 * scale);
}

} // namespace palp
