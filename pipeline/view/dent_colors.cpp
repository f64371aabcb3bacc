#include "pipeline/view/dent_colors.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/units.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <cmath>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

constexpr double kLegendWidth = 0.10; // of the picture

// so many steps from 0 that each is 1, 2 or 5 times a power of ten, where that can be
int stepsUpTo(double top)
{
  for (const int steps : { 5, 4, 6, 3 })
  {
    const double step = top / steps;
    const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    for (const double round : { 1.0, 2.0, 5.0 })
    {
      if (std::abs(digit - round) < 1e-6)
      {
        return steps;
      }
    }
  }
  return 5;
}

} // namespace

DentColors::DentColors(vtkRenderer& renderer, vtkPalpDeformFilter& press, vtkProperty* property)
  : map_(appearance::evenMapOn(appearance::kLiver))
  , surfaceColors_(appearance::evenMapOn(appearance::kLeast))
  , plain_(property)
  , layOut_(renderer, [this](const PictureRoom& room) { placeLegend(room); })
{
  pressure_->SetInputConnection(press.GetOutputPort(1));
  mapper_->SetInputConnection(press.GetOutputPort(1));
  mapper_->SetScalarModeToUsePointFieldData();
  mapper_->SetLookupTable(map_);
  mapper_->UseLookupTableScalarRangeOn();
  mapper_->InterpolateScalarsBeforeMappingOn();
  actor_->SetMapper(mapper_);
  renderer.AddActor(actor_);

  legend_->SetLookupTable(map_);
  legend_->SetUnconstrainedFontSize(true);
  legend_->SetBarRatio(0.25);
  appearance::setFont(*legend_->GetTitleTextProperty(), 14, appearance::kInk, true);
  appearance::setFont(*legend_->GetLabelTextProperty(), 14);
  for (vtkTextProperty* text : { legend_->GetTitleTextProperty(), legend_->GetLabelTextProperty() })
  {
    text->SetBackgroundColor(1.0, 1.0, 1.0);
    text->SetBackgroundOpacity(0.6);
  }
  renderer.AddActor2D(legend_);
  hide();
}

// beside the body; in a picture that is narrow, and full of it from side to side, above it
void DentColors::placeLegend(const PictureRoom& room)
{
  constexpr double kHalfTitle = 60.0; // [pixels]
  const bool isAbove = room.isNarrow();
  const double left = 1.0 - 0.5 * kLegendWidth - kHalfTitle * room.scale / room.width;
  const double foot = isAbove ? 0.0 : room.foot / room.height;
  legend_->SetOrientation(isAbove ? VTK_ORIENT_HORIZONTAL : VTK_ORIENT_VERTICAL);
  legend_->SetPosition(isAbove ? 0.1 : std::max(0.0, std::min(0.82, left)),
    isAbove ? kNarrowTop : foot + 0.30 * (1.0 - foot));
  legend_->SetWidth(isAbove ? 0.8 : kLegendWidth);
  legend_->SetHeight(isAbove ? kLegendWidth : 0.5 * (1.0 - foot));
  legend_->SetVerticalTitleSeparation(static_cast<int>(10.0 * room.scale));
}

void DentColors::hide()
{
  actor_->VisibilityOff();
  legend_->VisibilityOff();
}

// between round bounds, with the values of a map that is one in their middle; each label is exact
void DentColors::showLegend(const SurfaceMap& map)
{
  constexpr double kLeastSpread = 0.02; // of the largest, that colors are to tell apart
  constexpr double kSteps = 10.0;
  const double more = std::max(0.0, 0.5 * (kLeastSpread * map.high - (map.high - map.low)));
  const double step = appearance::roundUp((map.high - map.low + 2.0 * more) / kSteps);
  const double low = std::floor((map.low - more) / step);
  const double pairs = std::ceil(0.5 * (std::ceil((map.high + more) / step) - low));
  showLegend(*surfaceColors_, map.title.c_str(), step * low, step * (low + 2.0 * pairs));
  legend_->SetNumberOfLabels(static_cast<int>(pairs) + 1);
  legend_->SetLabelFormat(("%." + std::to_string(appearance::decimalsOf(step)) + "f").c_str());
}

void DentColors::showLegend(vtkLookupTable& colors, const char* title, double low, double high)
{
  colors.SetTableRange(low, high);
  legend_->SetLookupTable(&colors);
  legend_->SetNumberOfLabels(1 + stepsUpTo(high));
  legend_->SetLabelFormat("%.3g");
  legend_->SetTitle(title);
  legend_->SetVisibility(hasLegend_);
}

void DentColors::setBase(const appearance::Color& color)
{
  map_->DeepCopy(appearance::evenMapOn(color));
}

void DentColors::setLaw(const ForceLaw& law)
{
  validity_.emplace(law);
}

void DentColors::show(const OverlayState& state, By by, double deepest)
{
  const Contact& contact = state.sample.contact;
  mapper_->SetInputConnection(state.press.GetOutputPort(1));
  const bool hasColors = by == By::Displacement || by == By::Pressure;
  mapper_->SetScalarVisibility(hasColors); // once: each change makes shaders and legend anew
  legend_->SetVisibility(hasColors && hasLegend_);
  actor_->SetProperty(plain_);
  actor_->VisibilityOn();
  if (by == By::Displacement)
  {
    // of the dent alone where the body gives way as a whole
    const bool isLocal = state.press.GetPress().motion != nullptr;
    colorBy("Displacement [mm]", isLocal ? "local\ndisplacement\n[mm]" : "displacement\n[mm]",
      units::toMillimeters(std::max(state.press.GetPress().contact.depth, deepest)));
  }
  else if (by == By::Pressure)
  {
    const Response& response = state.sample.response;
    const ContactPressure pressure(
      state.tip, contact.depth, response.contactRadius, response.force);
    pressure_->SetPressure(pressure);
    mapper_->SetInputConnection(pressure_->GetOutputPort());
    // a sharp apex and a flat edge have no largest value: twice the one half way says enough
    const double half = pressure.at(0.5 * response.contactRadius);
    colorBy("Pressure [kPa]", "contact\npressure\n[kPa]",
      units::toKilopascals(std::min(std::max(pressure.at(0.0), half), 2.0 * half)));
  }
  else if (const auto worst = worstRule(state); by == By::Validity && worst)
  {
    const appearance::Color& color = !worst->holds() ? appearance::kBad
      : worst->fraction() > Rule::kDoubtful          ? appearance::kDoubtful
                                                     : appearance::kGood;
    vtkNew<vtkProperty> property;
    property->DeepCopy(plain_);
    appearance::setColor(*property, color);
    actor_->SetProperty(property);
  }
}

void DentColors::colorBy(const char* array, const char* title, double top)
{
  mapper_->SelectColorArray(array);
  showLegend(*map_, title, 0.0, fixedTop_ > 0.0 ? fixedTop_ : appearance::roundUp(top));
}

std::optional<Rule> DentColors::worstRule(const OverlayState& state) const
{
  if (!validity_)
  {
    return std::nullopt;
  }
  const Contact& contact = state.sample.contact;
  const Rules rules = (*validity_)(contactGeometryOf(contact), contact.edgeDistance);
  return *std::max_element(rules.begin(), rules.end(),
    [](const Rule& a, const Rule& b) { return a.fraction() < b.fraction(); });
}

std::string DentColors::rule(const OverlayState& state) const
{
  const auto worst = worstRule(state);
  if (!worst)
  {
    return {};
  }
  std::string name = worst->name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const char* verdict = !worst->holds()   ? "not valid: "
    : worst->fraction() > Rule::kDoubtful ? "doubtful: "
                                          : "valid: ";
  return verdict + name + " uses " + appearance::fixedText(100.0 * worst->fraction(), 0) +
    " % of its limit";
}

} // namespace palp
