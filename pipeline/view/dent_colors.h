#pragma once

#include "haptics/force/validity.h"
#include "pipeline/layout/before_render.h"
#include "pipeline/model/surface_map.h"
#include "pipeline/view/appearance.h"
#include "pipeline/view/overlay_props.h"
#include "pipeline/view/vtkPalpPressureFilter.h"

#include <array>
#include <optional>
#include <string>
#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkScalarBarActor.h>

namespace palp
{

/// The dent drawn by itself, plain or in colors, with their legend.
class DentColors
{
public:
  enum class By
  {
    Nothing,
    Displacement,
    Pressure,
    Validity,
    Map ///< none of its own: those of the surface around it
  };

  /// @param property  of the surface around it
  DentColors(vtkRenderer& renderer, vtkPalpDeformFilter& press, vtkProperty* property);

  /// @param deepest  of another dent with the same colors, whose range is that of the deeper [m]
  void show(const OverlayState& state, By by, double deepest = 0.0);
  void hide();

  /// The legend of the colors of the whole surface.
  void showLegend(const SurfaceMap& map);

  /// From the values of such a map to colors.
  [[nodiscard]] vtkLookupTable* surfaceColors() const
  {
    return surfaceColors_;
  }

  /// Color of the surface around the dent, in which the colors end.
  void setBase(const appearance::Color& color);

  /// The law whose rules are shown; without one there are none.
  void setLaw(const ForceLaw& law);

  /// Upper end of the colors of displacement [mm] or pressure [kPa]; 0 lets it follow the press.
  void setRange(double top)
  {
    fixedTop_ = top;
  }

  /// Of the dent, to be cut as the surface around it.
  [[nodiscard]] vtkMapper* mapper()
  {
    return mapper_;
  }

  /// Whether the legend is shown with the colors.
  void setLegend(bool shown)
  {
    hasLegend_ = shown;
  }

  /// The rule nearest to its limit, with the fraction of it that is used; empty without a law.
  [[nodiscard]] std::string rule(const OverlayState& state) const;

private:
  [[nodiscard]] std::optional<Rule> worstRule(const OverlayState& state) const;
  void placeLegend(const PictureRoom& room);
  void showLegend(vtkLookupTable& colors, const char* title, double low, double high);
  void colorBy(const char* array, const char* title, double top);

  std::optional<Validity> validity_;
  double fixedTop_ = 0.0;
  bool hasLegend_ = true;
  vtkNew<vtkPalpPressureFilter> pressure_;
  vtkSmartPointer<vtkLookupTable> map_;
  vtkSmartPointer<vtkLookupTable> surfaceColors_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkSmartPointer<vtkProperty> plain_;
  vtkNew<vtkScalarBarActor> legend_;
  BeforeRender layOut_; // the legend, whose title is wider than itself
};

} // namespace palp
