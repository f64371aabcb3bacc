#include "pipeline/figure/orientation.h"

#include "pipeline/view/appearance.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

constexpr std::array<const char*, 6> kSides{ "L", "R", "P", "A", "S", "I" };
constexpr std::array<const char*, 6> kAxes{ "x", "", "y", "", "z", "" };

// of an axis, as it is seen
struct End
{
  const char* name;
  Eigen::Vector2d at; // [-] of its length
  double away;        // from the eye, likewise

  // a shorter one would have its letter on others
  [[nodiscard]] bool hasLetter() const
  {
    constexpr double kSeen = 0.25;
    return *name != '\0' && at.norm() > kSeen;
  }

  // nearer to the eye, with its letter on that of the other
  [[nodiscard]] bool covers(const End& other) const
  {
    constexpr double kLetters = 0.35;
    return hasLetter() && away < other.away && (at - other.at).norm() < kLetters;
  }
};

} // namespace

Orientation::Orientation(vtkRenderer& renderer)
  : layOut_(renderer, [this, &renderer](const PictureRoom& room) { place(renderer, room); })
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(2 * static_cast<vtkIdType>(kEnds));
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < kEnds; ++i)
  {
    cells->InsertNextCell({ 2 * static_cast<vtkIdType>(i), 2 * static_cast<vtkIdType>(i) + 1 });
    vtkTextProperty& text = *letters_[i]->GetTextProperty();
    appearance::setFont(text, 14, appearance::kInk, true);
    text.SetJustificationToCentered();
    text.SetVerticalJustificationToCentered();
    renderer.AddActor2D(letters_[i]);
  }
  lines_->SetPoints(points);
  lines_->SetLines(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(lines_);
  cross_->SetMapper(mapper);
  setInk(appearance::kInk);
  cross_->GetProperty()->SetLineWidth(2.0F);
  renderer.AddActor2D(cross_);
}

void Orientation::setPatient(bool isPatient)
{
  isPatient_ = isPatient;
}

void Orientation::setInk(const std::array<double, 3>& ink)
{
  for (auto& letter : letters_)
  {
    letter->GetTextProperty()->SetColor(ink[0], ink[1], ink[2]);
  }
  cross_->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
}

void Orientation::setVisible(bool visible)
{
  isVisible_ = visible;
}

void Orientation::place(vtkRenderer& renderer, const PictureRoom& room)
{
  constexpr double kArm = 30.0;    // [pixels]
  constexpr double kLetter = 41.0; // from the middle
  constexpr double kMiddle = 54.0; // from the corner
  vtkCamera& camera = *renderer.GetActiveCamera();
  const Eigen::Vector3d sight(camera.GetDirectionOfProjection());
  const Eigen::Vector3d right = sight.cross(Eigen::Vector3d(camera.GetViewUp())).normalized();
  const Eigen::Vector3d up = right.cross(sight);
  const double scale = room.scale;
  const Eigen::Vector2d middle(room.width - kMiddle * scale, room.foot + kMiddle * scale);
  std::array<End, kEnds> ends;
  for (std::size_t i = 0; i < kEnds; ++i)
  {
    const Eigen::Vector3d axis =
      (i % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i / 2));
    ends[i] = { .name = (isPatient_ ? kSides : kAxes)[i],
      .at = { axis.dot(right), axis.dot(up) },
      .away = axis.dot(sight) };
  }
  for (std::size_t i = 0; i < kEnds; ++i)
  {
    const End& one = ends[i];
    const bool isCovered =
      std::ranges::any_of(ends, [&](const End& other) { return other.covers(one); });
    const double arm = *one.name != '\0' ? kArm * scale : 0.0;
    const Eigen::Vector2d end = middle + arm * one.at;
    const Eigen::Vector2d letter = middle + kLetter * scale * one.at;
    lines_->GetPoints()->SetPoint(2 * static_cast<vtkIdType>(i), middle.x(), middle.y(), 0.0);
    lines_->GetPoints()->SetPoint(2 * static_cast<vtkIdType>(i) + 1, end.x(), end.y(), 0.0);
    letters_[i]->SetInput(one.name);
    letters_[i]->SetPosition(letter.x(), letter.y());
    letters_[i]->SetVisibility(isVisible_ && one.hasLetter() && !isCovered);
    // what points away from the eye is fainter
    letters_[i]->GetTextProperty()->SetOpacity(one.away > 0.3 ? 0.45 : 1.0);
  }
  lines_->GetPoints()->Modified();
  cross_->SetVisibility(isVisible_);
}

} // namespace palp
