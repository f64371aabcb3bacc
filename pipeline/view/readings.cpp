#include "pipeline/view/readings.h"

#include "haptics/units.h"
#include "pipeline/view/appearance.h"
#include "pipeline/view/force_arrow.h"
#include "pipeline/view/iso_lines.h"

#include <algorithm>
#include <utility>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

constexpr int kUsual = 16; // [points]
constexpr int kSmall = 12;
constexpr double kInset = 16.0; // [pixels]

// beside the marks at the foot where a text is not too long for that; else above them
double footOf(const PictureRoom& room, std::size_t longest)
{
  constexpr double kLetter = 0.6;      // width of one, of its height
  constexpr double kAboveMarks = 36.0; // [pixels]
  const double width = (kInset + kLetter * kUsual * static_cast<double>(longest)) * room.scale;
  const bool isBeside = room.marks == 0.0 || width < room.width - room.marks;
  return room.foot + (isBeside ? kInset : kInset + kAboveMarks) * room.scale;
}

std::string millimeters(double meters)
{
  return appearance::fixedText(units::toMillimeters(meters), 1) + " mm ";
}

} // namespace

Readings::Readings(vtkRenderer& renderer)
  : layOut_(renderer,
      [this](const PictureRoom& room)
      {
        constexpr double kLine = 1.75; // of the letters
        const int letters = room.isNarrow() ? kSmall : kUsual;
        const double step = kLine * letters * room.scale;
        std::size_t lines = 0;
        std::size_t longest = 0;
        for (const auto& line : lines_)
        {
          const std::string text = line->GetVisibility() ? line->GetInput() : "";
          lines += text.empty() ? 0 : 1;
          longest = std::max(longest, text.size());
        }
        double height = room.isNarrow()
          ? kNarrowTop * room.height - static_cast<double>(lines) * step
          : footOf(room, longest);
        for (std::size_t i = kLines; i-- > 0;)
        {
          lines_[i]->GetTextProperty()->SetFontSize(letters);
          lines_[i]->SetPosition((room.isNarrow() ? 0.5 : 1.0) * kInset * room.scale, height);
          height += lines_[i]->GetVisibility() ? step : 0.0;
        }
      })
{
  const std::array<appearance::Color, kLines> inks{ appearance::kPaper, appearance::kPaper,
    appearance::kContact, appearance::kExtent, appearance::kPaper, appearance::kPaper };
  for (std::size_t i = 0; i < kLines; ++i)
  {
    vtkTextProperty& text = *lines_[i]->GetTextProperty();
    appearance::setFont(text, kUsual, inks[i], i == 0);
    text.SetBackgroundColor(0.13, 0.15, 0.18);
    text.SetBackgroundOpacity(0.8);
    renderer.AddActor2D(lines_[i]);
  }
  Readings::hide();
}

void Readings::setKeys(Keys keys)
{
  keys_ = std::move(keys);
}

void Readings::show(const OverlayState& state)
{
  const Response& response = state.sample.response;
  std::array<std::string, kLines> texts;
  texts[0] = " force " + appearance::fixedText(response.force, 2) + " N   depth " +
    millimeters(state.sample.contact.depth);
  if (keys_.arrow)
  {
    const double diagonal = vtkPolyData::SafeDownCast(state.press.GetInput())->GetLength();
    const double ring = ForceArrow::scaleOf(response.force, diagonal).ring;
    texts[1] = " \u2191 arrow: a ring each " + appearance::roundText(ring) + " N ";
  }
  if (keys_.contactCircle)
  {
    texts[2] = " \u25cb contact circle r = " + millimeters(state.press.GetPress().contactRadius);
  }
  if (keys_.extentCircle && state.extentRadius > 0.0)
  {
    texts[3] = " \u25cb extent circle R_d = " + millimeters(state.extentRadius);
  }
  if (keys_.isoLines)
  {
    const double step = IsoLines::stepOf(state.sample.contact.depth);
    texts[4] = " \u2012 equal displacement each " +
      appearance::roundText(units::toMillimeters(step)) + " mm ";
  }
  texts[5] = keys_.validity.empty() ? std::string{} : " " + keys_.validity + " ";
  for (std::size_t i = 0; i < kLines; ++i)
  {
    lines_[i]->SetVisibility(!texts[i].empty());
    lines_[i]->SetInput(texts[i].c_str());
  }
}

void Readings::hide()
{
  for (const auto& line : lines_)
  {
    line->VisibilityOff();
  }
}

} // namespace palp
