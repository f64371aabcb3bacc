#include "pipeline/charts/vtkPalpPointedChart.h"

#include "pipeline/view/appearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextMouseEvent.h>
#include <vtkContextScene.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>
#include <vtkVectorOperators.h>

vtkStandardNewMacro(vtkPalpPointedChart);

namespace
{

constexpr std::array<int, 2> Sides{ vtkAxis::BOTTOM, vtkAxis::LEFT };
constexpr float Still = 4.0F; // [pixels]: a hand that clicks moves less

int indexOf(int side)
{
  return side == vtkAxis::BOTTOM ? 0 : 1;
}

} // namespace

void vtkPalpPointedChart::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "At: " << this->At[0] << ' ' << this->At[1] << " pixels\n"
     << indent << "Hovers: " << this->Hovers << '\n';
}

bool vtkPalpPointedChart::IsOver(int side, const vtkVector2f& at)
{
  const int i = indexOf(side);
  return at[i] >= static_cast<float>(this->GetPoint1()[i]) &&
    at[i] <= static_cast<float>(this->GetPoint2()[i]);
}

bool vtkPalpPointedChart::IsInside(const vtkVector2f& at)
{
  return this->IsOver(vtkAxis::BOTTOM, at) && this->IsOver(vtkAxis::LEFT, at);
}

double vtkPalpPointedChart::ValueAt(int side, float pixel)
{
  vtkAxis& axis = *this->GetAxis(side);
  const int i = indexOf(side);
  const double first = this->GetPoint1()[i];
  const double length = std::max(1, this->GetPoint2()[i] - this->GetPoint1()[i]);
  return std::lerp(axis.GetMinimum(), axis.GetMaximum(), (pixel - first) / length);
}

float vtkPalpPointedChart::PixelOf(int side, double value)
{
  vtkAxis& axis = *this->GetAxis(side);
  const int i = indexOf(side);
  const double share = (value - axis.GetMinimum()) / (axis.GetMaximum() - axis.GetMinimum());
  return static_cast<float>(std::lerp(this->GetPoint1()[i], this->GetPoint2()[i], share));
}

bool vtkPalpPointedChart::Redraw()
{
  this->Scene->SetDirty(true);
  return true;
}

bool vtkPalpPointedChart::Hit(const vtkContextMouseEvent& mouse)
{
  const vtkRectf whole = this->Whole();
  const vtkVector2f at = mouse.GetPos();
  return this->GetVisible() && at[0] >= whole.GetLeft() && at[0] <= whole.GetRight() &&
    at[1] >= whole.GetBottom() && at[1] <= whole.GetTop();
}

bool vtkPalpPointedChart::MouseEnterEvent(const vtkContextMouseEvent& mouse)
{
  return this->MouseMoveEvent(mouse);
}

bool vtkPalpPointedChart::MouseMoveEvent(const vtkContextMouseEvent& mouse)
{
  const vtkVector2f before = std::exchange(this->At, mouse.GetPos());
  if (this->Dragging == Drag::Shift)
  {
    this->Shift(this->At - before);
  }
  const bool hovered =
    std::exchange(this->Hovers, this->Dragging == Drag::None && this->IsInside(this->At));
  return this->Dragging == Drag::None && !this->Hovers && !hovered ? true : this->Redraw();
}

bool vtkPalpPointedChart::MouseLeaveEvent(const vtkContextMouseEvent&)
{
  return std::exchange(this->Hovers, false) ? this->Redraw() : true;
}

bool vtkPalpPointedChart::MouseButtonPressEvent(const vtkContextMouseEvent& mouse)
{
  this->At = this->PressedAt = mouse.GetPos();
  this->Hovers = false;
  this->Dragging = mouse.GetButton() == vtkContextMouseEvent::LEFT_BUTTON ? Drag::Shift
    : mouse.GetButton() == vtkContextMouseEvent::RIGHT_BUTTON && this->IsInside(this->At)
    ? Drag::Rectangle
    : Drag::None;
  return this->Redraw();
}

bool vtkPalpPointedChart::MouseButtonReleaseEvent(const vtkContextMouseEvent& mouse)
{
  this->At = mouse.GetPos();
  const vtkVector2f moved = this->At - this->PressedAt;
  const Drag ended = std::exchange(this->Dragging, Drag::None);
  for (const int side : Sides)
  {
    const int i = indexOf(side);
    if (ended == Drag::Rectangle && std::abs(moved[i]) > Still)
    {
      const double from = this->ValueAt(side, this->PressedAt[i]);
      const double to = this->ValueAt(side, this->At[i]);
      this->Hold(side, std::min(from, to), std::max(from, to));
    }
  }
  if (ended == Drag::Shift && std::abs(moved[0]) < Still && std::abs(moved[1]) < Still)
  {
    this->ToggleCurveAt(this->At);
  }
  this->Hovers = this->IsInside(this->At);
  return this->Redraw();
}

bool vtkPalpPointedChart::MouseDoubleClickEvent(const vtkContextMouseEvent&)
{
  this->Dragging = Drag::None;
  this->FollowData();
  return this->Redraw();
}

// with what is above or below the curves they move to the side, and beside them up and down
void vtkPalpPointedChart::Shift(const vtkVector2f& by)
{
  const bool inside = this->IsInside(this->PressedAt);
  for (const int side : Sides)
  {
    if (by[indexOf(side)] != 0.0F && (inside || this->IsOver(side, this->PressedAt)))
    {
      const double shift = this->ValueAt(side, 0.0F) - this->ValueAt(side, by[indexOf(side)]);
      vtkAxis& axis = *this->GetAxis(side);
      this->Hold(side, axis.GetMinimum() + shift, axis.GetMaximum() + shift);
    }
  }
}

bool vtkPalpPointedChart::MouseWheelEvent(const vtkContextMouseEvent& mouse, int notches)
{
  constexpr double kNotch = 0.8; // [-] what is left of a range
  this->At = mouse.GetPos();
  const double factor = std::pow(kNotch, notches);
  for (const int side : Sides)
  {
    if (this->IsInside(this->At) || this->IsOver(side, this->At))
    {
      vtkAxis& axis = *this->GetAxis(side);
      const double about = this->ValueAt(side, this->At[indexOf(side)]);
      this->Hold(side, std::lerp(about, axis.GetMinimum(), factor),
        std::lerp(about, axis.GetMaximum(), factor));
    }
  }
  return this->Redraw();
}

bool vtkPalpPointedChart::Paint(vtkContext2D* painter)
{
  const bool painted = this->Superclass::Paint(painter);
  const double* ink = this->GetAxis(vtkAxis::BOTTOM)->GetTitleProperties()->GetColor();
  painter->GetPen()->SetColorF(ink[0], ink[1], ink[2], 0.7);
  painter->GetPen()->SetWidth(1.0F);
  painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
  if (this->Dragging == Drag::Rectangle)
  {
    painter->GetBrush()->SetColorF(ink[0], ink[1], ink[2], 0.1);
    const vtkVector2f size = this->At - this->PressedAt;
    painter->DrawRect(this->PressedAt[0], this->PressedAt[1], size[0], size[1]);
  }
  else if (this->Hovers)
  {
    painter->DrawLine(this->At[0], static_cast<float>(this->GetPoint1()[1]), this->At[0],
      static_cast<float>(this->GetPoint2()[1]));
    this->PaintReadings(painter);
  }
  return painted;
}

// in a box beside the line, on the side that has room
void vtkPalpPointedChart::PaintReadings(vtkContext2D* painter)
{
  const double x = this->ValueAt(vtkAxis::BOTTOM, this->At[0]);
  const double y = this->ValueAt(vtkAxis::LEFT, this->At[1]);
  std::vector<std::string> lines{ this->ReadingOf(vtkAxis::BOTTOM, x) };
  for (const vtkPalpChart::Reading& reading : this->ReadingsAt(x, y))
  {
    lines.push_back(reading.Name + "  " + this->ReadingOf(vtkAxis::LEFT, reading.Value));
    const vtkVector2f dot(this->At[0], this->PixelOf(vtkAxis::LEFT, reading.Value));
    if (this->IsInside(dot))
    {
      const auto& color = reading.Color;
      painter->GetBrush()->SetColor(color[0], color[1], color[2]);
      painter->DrawEllipse(dot[0], dot[1], 4.0F, 4.0F);
    }
  }
  vtkNew<vtkTextProperty> text;
  palp::appearance::setFont(*text, 12);
  text->SetVerticalJustificationToTop();
  painter->ApplyTextProp(text);
  vtkVector2f size(0.0F, 0.0F);
  float line = 0.0F;
  for (const std::string& reading : lines)
  {
    float bounds[4];
    painter->ComputeStringBounds(reading, bounds);
    line = std::max(line, 1.2F * bounds[3]);
    size = { std::max(size[0], bounds[2]), line * static_cast<float>(lines.size()) };
  }
  const float gap = 0.4F * line;
  const bool isLeft = this->At[0] + size[0] + 3.0F * gap > static_cast<float>(this->GetPoint2()[0]);
  const float left = isLeft ? this->At[0] - size[0] - 2.0F * gap : this->At[0] + 2.0F * gap;
  float top = static_cast<float>(this->GetPoint2()[1]) - gap;
  painter->GetBrush()->SetColor(255, 255, 255, 225);
  painter->GetPen()->SetLineType(vtkPen::NO_PEN);
  painter->DrawRect(left - gap, top - size[1] - gap, size[0] + 2.0F * gap, size[1] + 2.0F * gap);
  for (const std::string& reading : lines)
  {
    painter->DrawString(left, top, reading);
    top -= line;
  }
  painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
}
