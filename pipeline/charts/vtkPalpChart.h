/**
 * @class   vtkPalpChart
 * @brief   a chart with its legend below it, and axes that follow the data or are held
 *
 * The toolkit's own legend covers curves, or takes a column that a small chart has not. Plots
 * without a label have no entry: they are a part of the curve before.
 */

#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>
#include <vtkChartXY.h>
#include <vtkColor.h>

class vtkPalpChart : public vtkChartXY
{
public:
  vtkTypeMacro(vtkPalpChart, vtkChartXY);
  static vtkPalpChart* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Where chart and legend stand, as shares of the scene's height from below. Default: 0 and 1.
   */
  void SetShare(double bottom, double top);

  ///@{
  /**
   * Whether the legend is drawn. Default: true.
   */
  vtkSetMacro(Keyed, bool);
  vtkGetMacro(Keyed, bool);
  ///@}

  /**
   * What an axis, vtkAxis::BOTTOM or LEFT, shows while it follows the data. Until this is called it
   * follows all curves by itself.
   */
  void SetFollowed(int side, double from, double to);

  ///@{
  /**
   * Holds an axis at a range, whatever the data, until it follows them again. Axes with decades
   * follow always.
   */
  void Hold(int side, double from, double to);
  void Follow(int side);
  void FollowData();
  bool IsHeld(int side) const;
  ///@}

  ///@{
  /**
   * Whether a curve is shown, by its label. Default: true.
   */
  void SetCurveShown(const std::string& label, bool shown);
  bool IsCurveShown(const std::string& label) const;
  ///@}

  /**
   * Shows the curve whose name in the legend is at a place of the scene, or hides it.
   */
  void ToggleCurveAt(const vtkVector2f& at);

  /**
   * Leaves out numbers of the axes that have no room, as where letters have grown with a picture.
   * For a chart that was drawn once, at the ranges that it has then.
   */
  void SpaceTicks();

  /**
   * Takes over from another chart which axes are held and which curves are hidden.
   */
  void TakeViewOf(const vtkPalpChart& other);

  /// A curve's value at a place.
  struct Reading
  {
    std::string Name;
    vtkColor4ub Color;
    double Value;
  };

  /**
   * The curves that are shown where the horizontal axis is x; of several values of one the nearest
   * to y, of points one that is seen there.
   */
  std::vector<Reading> ReadingsAt(double x, double y);

  /**
   * A value of an axis with its unit, as exact as a pixel.
   */
  std::string ReadingOf(int side, double value);

  bool Paint(vtkContext2D* painter) override;

protected:
  vtkPalpChart();
  ~vtkPalpChart() override = default;

  /// Chart and legend in the scene [pixels].
  vtkRectf Whole() const;

private:
  vtkPalpChart(const vtkPalpChart&) = delete;
  void operator=(const vtkPalpChart&) = delete;

  using Range = std::pair<double, double>;

  // of an axis
  struct View
  {
    int Behavior = 0; // of its own, while it is held
    std::optional<Range> Held;
    std::optional<Range> Followed;
  };

  void PaintTitles(vtkContext2D* painter, const vtkRectf& chart);
  float PaintLegend(vtkContext2D* painter, const vtkRectf& rectangle, bool draw);
  void PaintEntry(vtkContext2D* painter, vtkIdType plot, const vtkRectf& mark);
  void ShowCurves();
  void ScaleTo(double scale);

  double Bottom = 0.0; // [-] of the scene
  double Top = 1.0;
  std::array<View, 2> Views; // left and bottom, as vtkAxis counts them
  std::set<std::string> Hidden;
  std::vector<std::pair<std::string, vtkRectf>> Names; // of the legend as it was last drawn
  double Scale = 1.0;                                  // that pens, marks and gaps have now
  bool Keyed = true;
};
