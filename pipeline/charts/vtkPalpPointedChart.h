/**
 * @class   vtkPalpPointedChart
 * @brief   a chart under the pointer: zoom, pan, a line with the values below it
 *
 * The wheel zooms about the pointer and a left drag moves the curves, beside an axis that axis
 * alone; a right drag zooms into a rectangle; a double click lets both axes follow the data again.
 * A click at a name in the legend hides its curve, or shows it. Axes with decades stay as they are.
 */

#pragma once

#include "pipeline/charts/vtkPalpChart.h"

#include <vtkVector.h>

class vtkPalpPointedChart : public vtkPalpChart
{
public:
  vtkTypeMacro(vtkPalpPointedChart, vtkPalpChart);
  static vtkPalpPointedChart* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool Paint(vtkContext2D* painter) override;
  bool Hit(const vtkContextMouseEvent& mouse) override;
  bool MouseEnterEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseMoveEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseLeaveEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseButtonPressEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseButtonReleaseEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseDoubleClickEvent(const vtkContextMouseEvent& mouse) override;
  bool MouseWheelEvent(const vtkContextMouseEvent& mouse, int notches) override;

protected:
  vtkPalpPointedChart() = default;
  ~vtkPalpPointedChart() override = default;

private:
  vtkPalpPointedChart(const vtkPalpPointedChart&) = delete;
  void operator=(const vtkPalpPointedChart&) = delete;

  enum class Drag
  {
    None,
    Shift,
    Rectangle
  };

  bool IsOver(int side, const vtkVector2f& at);
  bool IsInside(const vtkVector2f& at);
  double ValueAt(int side, float pixel);
  float PixelOf(int side, double value);
  void Shift(const vtkVector2f& by);
  void PaintReadings(vtkContext2D* painter);
  bool Redraw();

  Drag Dragging = Drag::None;
  bool Hovers = false; // inside, and no button is down
  vtkVector2f At{ 0.0F, 0.0F };
  vtkVector2f PressedAt{ 0.0F, 0.0F };
};
