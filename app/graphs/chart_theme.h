#pragma once

class vtkPalpChart;
class vtkRenderWindow;

namespace palp
{

/// Whether a chart is drawn in light ink on dark ground; one that is saved never is.
void paintChart(vtkPalpChart& chart, bool isDark);

/// The ground around the charts of a window.
void paintGround(vtkRenderWindow& window, bool isDark);

} // namespace palp
