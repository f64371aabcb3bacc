#include "pipeline/view/force_arrow.h"

#include "haptics/units.h"
#include "pipeline/model/tool_surface.h"
#include "pipeline/view/appearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

constexpr double kLengthPerForce = 0.015; // [m/N], to the largest scale
// shares of the body's diagonal, whatever the tool: the body stays seen behind the arrow
constexpr double kHead = 0.045;
constexpr double kLongestShaft = 0.27;
constexpr double kBetweenRings = 0.02; // at least
constexpr double kThickness = 0.004;
constexpr int kSides = 24;         // of a shaft of a few pixels, which each picture makes anew
constexpr double kFarthest = 0.15; // from the axis of a tool of any size
constexpr double kMargin = 6.0;    // of the label from the edge [pixels]

// 1, 2 or 5 times a power of ten, not below a value
double roundNumber(double least) noexcept
{
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  const double mantissa = least / power;
  return power * (mantissa <= 1.0 ? 1.0 : mantissa <= 2.0 ? 2.0 : mantissa <= 5.0 ? 5.0 : 10.0);
}

// [pixels]
Eigen::Vector2d onScreen(vtkRenderer& renderer, const Eigen::Vector3d& point)
{
  renderer.SetWorldPoint(point.x(), point.y(), point.z(), 1.0);
  renderer.WorldToDisplay();
  return Eigen::Vector2d(renderer.GetDisplayPoint());
}

} // namespace

ForceArrow::Scale ForceArrow::scaleOf(double force, double diagonal) noexcept
{
  const double reduction = force * kLengthPerForce / (kLongestShaft * diagonal);
  const double length = kLengthPerForce / (reduction > 1.0 ? roundNumber(reduction) : 1.0);
  return { .length = length, .ring = roundNumber(kBetweenRings * diagonal / length) };
}

double ForceArrow::lengthOf(double force, double diagonal) noexcept
{
  return force * scaleOf(force, diagonal).length + kHead * diagonal;
}

ForceArrow::ForceArrow(vtkRenderer& renderer)
  : layOut_(renderer, [this, &renderer](const PictureRoom& room) { place(renderer, room); })
{
  arrow_->SetMapper(mapper_);
  appearance::setColor(*arrow_->GetProperty(), appearance::kForce);
  arrow_->GetProperty()->SetAmbient(0.35);
  renderer.AddActor(arrow_);

  appearance::makeInkLine(*line_, *leader_, 2);
  renderer.AddActor2D(leader_);

  vtkTextProperty& text = *label_->GetTextProperty();
  appearance::setFont(text, 20, appearance::kInk, true);
  text.SetBackgroundColor(1.0, 1.0, 1.0);
  text.SetBackgroundOpacity(0.85);
  text.SetVerticalJustificationToCentered();
  renderer.AddActor2D(label_);
  ForceArrow::hide();
}

void ForceArrow::place(vtkRenderer& renderer, const PictureRoom& room)
{
  if (!arrow_->GetVisibility())
  {
    return;
  }
  // to the left of the tool, as it is seen: the legend of colors has the right side
  const vtkCamera& camera = *renderer.GetActiveCamera();
  const Eigen::Vector3d sight(const_cast<vtkCamera&>(camera).GetDirectionOfProjection());
  const Eigen::Vector3d across = along_.cross(sight);
  const Eigen::Vector3d start =
    start_ + aside_ * (across.norm() > 0.1 ? across.normalized() : along_.unitOrthogonal());
  arrow_->SetUserMatrix(appearance::placement(start, appearance::axesAlong(along_, 2)));
  renderer.ResetCameraClippingRange(); // it may stand in front of all else

  const Eigen::Vector2d at = onScreen(renderer, start + length_ * along_);
  double size[2]{};
  label_->GetSize(&renderer, size);
  const double margin = kMargin * room.scale;
  const double away = 24.0 * room.scale; // [pixels]
  const double half = 0.5 * size[1];
  // off the dent, where there is room
  const bool fitsLeft = at[0] - away - size[0] > margin;
  const bool fitsRight = at[0] + away + size[0] < room.width - margin;
  const bool isLeft = fitsLeft && (at.x() < onScreen(renderer, start_).x() || !fitsRight);
  const double x = std::clamp(isLeft ? at[0] - away - size[0] : at[0] + away, margin,
    std::max(margin, room.width - margin - size[0]));
  const double lowest = room.foot + margin + half;
  const double y =
    std::clamp(at[1] + 0.5 * away, lowest, std::max(lowest, room.height - margin - half));
  label_->SetPosition(x, y);
  line_->GetPoints()->SetPoint(0, at.x(), at.y(), 0.0);
  line_->GetPoints()->SetPoint(1, std::clamp(at[0], x, x + size[0]), y, 0.0);
  line_->GetPoints()->Modified();
}

void ForceArrow::show(const OverlayState& state)
{
  const double diagonal = vtkPolyData::SafeDownCast(state.press.GetInput())->GetLength();
  const double force = state.sample.response.force;
  const Scale scale = scaleOf(force, diagonal);
  const double shaft = force * scale.length;
  const double thick = kThickness * diagonal;
  std::vector<Eigen::Vector2d> profile{ { 0.0, 0.0 }, { thick, 0.0 } };
  const double ring = scale.ring * scale.length;
  for (int i = 1; i * ring < shaft + 0.1 * thick; ++i)
  {
    for (const auto& [out, up] : { std::array{ 1.0, -0.3 }, std::array{ 1.7, -0.3 },
           std::array{ 1.7, 0.3 }, std::array{ 1.0, 0.3 } })
    {
      profile.emplace_back(out * thick, std::min(shaft, i * ring + up * thick));
    }
  }
  profile.emplace_back(thick, shaft);
  profile.emplace_back(3.0 * thick, shaft);
  length_ = lengthOf(force, diagonal);
  profile.emplace_back(0.0, length_);
  mapper_->SetInputData(revolved(profile, kSides));

  const Contact& contact = state.sample.contact;
  start_ = contact.center;
  along_ = contact.normal;
  aside_ = std::min(1.4 * baseRadius(state.tip) + 3.0 * thick, kFarthest * diagonal);
  label_->SetInput((appearance::fixedText(force, 2) + " N").c_str());
  arrow_->VisibilityOn();
  leader_->VisibilityOn();
  label_->VisibilityOn();
}

void ForceArrow::hide()
{
  arrow_->VisibilityOff();
  leader_->VisibilityOff();
  label_->VisibilityOff();
}

} // namespace palp
