#pragma once

#include "pipeline/charts/vtkPalpPointedChart.h"
#include "pipeline/view/appearance.h"

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

class vtkAxis;
class vtkContextScene;
class vtkRenderWindow;

namespace palp
{

/// One chart of curves, each a vtkTable, for the screen and for files.
class Plot
{
public:
  /// @param title   what is shown
  /// @param bottom  title of the horizontal axis, with its unit
  /// @param left    title of the vertical axis, with its unit
  Plot(const std::string& title, const std::string& bottom, const std::string& left);
  Plot(const Plot&) = delete;
  Plot& operator=(const Plot&) = delete;

  enum class Mark
  {
    Circle,
    Square,
    Diamond,
  };

  /// What a curve is called, and how it is drawn.
  struct Curve
  {
    enum class Kind
    {
      Line,
      Points,
      Band,
    };

    Kind kind = Kind::Line;
    std::string name{}; ///< empty: a part of the curve before
    appearance::Color color{};
    float size = 0.0F; ///< of a line's width or a mark
    int style = 0;     ///< an appearance::LineStyle or a Mark
  };

  /// @param second  the upper edge of a band; else empty
  void add(const Curve& curve, std::span<const double> x, std::span<const double> first,
    std::span<const double> second = {});

  /// A line through points, in the units of the axes.
  void addLine(const std::string& name, std::span<const double> x, std::span<const double> y,
    const appearance::Color& color, float width = 2.0F,
    appearance::LineStyle style = appearance::LineStyle::Solid);

  void addPoints(const std::string& name, std::span<const double> x, std::span<const double> y,
    const appearance::Color& color, Mark mark = Mark::Circle, float size = 6.0F);

  /// The area between two curves.
  void addBand(const std::string& name, std::span<const double> x, std::span<const double> low,
    std::span<const double> high, const appearance::Color& color);

  /// Logarithmic axes over whole decades, once all curves are in; all numbers positive there.
  void setLogarithmic(bool bottom, bool left);

  /// Axes that reach beyond all points, so that no mark is cut; once all curves are in.
  void keepMarksWhole();

  void hideLegend();

  /// What a reader of the numbers has to know, one line; a comment above them in CSV.
  void setNote(const std::string& note);

  /// Puts the chart into a scene, which then draws it, the legend below.
  void addTo(vtkContextScene& scene);

  /// The same in a part of the scene.
  /// @param bottom, top  [-] of its height
  void addTo(vtkContextScene& scene, double bottom, double top);

  [[nodiscard]] vtkPalpChart& chart()
  {
    return *chart_;
  }

  /// The curves in the order in which they were added; the first column is x.
  [[nodiscard]] const std::vector<vtkSmartPointer<vtkTable>>& tables() const
  {
    return tables_;
  }

  /// As many.
  [[nodiscard]] const std::vector<Curve>& curves() const
  {
    return curves_;
  }

  /// Writes all curves: curve,<x>,<y>; a band has two curves, its lower and its upper one.
  void writeCsv(std::ostream& out) const;

private:
  vtkTable* addTable(const std::string& name, std::span<const double> x,
    std::span<const double> first, std::span<const double> second);
  [[nodiscard]] std::pair<double, double> rangeOf(bool isBottom) const;
  void setDecades(vtkAxis& axis, bool isBottom);

  std::string bottom_;
  std::string left_;
  std::string note_;
  std::vector<vtkSmartPointer<vtkTable>> tables_;
  std::vector<Curve> curves_;
  vtkNew<vtkPalpPointedChart> chart_;
};

/// Puts an empty white scene into a window in the place of what it showed.
vtkContextScene* showEmptyScene(vtkRenderWindow& window);

/// Puts charts into a window in the place of what it showed, one below the other.
/// @return  the scene that they are in
vtkContextScene* showPlots(vtkRenderWindow& window, std::span<const std::unique_ptr<Plot>> plots);

} // namespace palp
