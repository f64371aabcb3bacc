/**
 * @class   vtkPalpChart
 * @brief   a chart whose legend stands below it, in as many rows as the width asks for
 *
 * The toolkit's own legend covers curves, or takes a column that a small chart has not. Plots
 * without a label have no entry.
 */

#pragma once

#include <vtkChartXY.h>

class vtkPalpChart : public vtkChartXY
{
public:
  vtkTypeMacro(vtkPalpChart, vtkChartXY);
  static vtkPalpChart* New();
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Where chart and legend stand in the scene [pixels]. Default: empty, which is all of it.
   */
  void SetRectangle(const vtkRectf& rectangle);
  const vtkRectf& GetRectangle() const
  {
    return this->Rectangle;
  }
  ///@}

  ///@{
  /**
   * Whether the legend is drawn. Default: true.
   */
  vtkSetMacro(Keyed, bool);
  vtkGetMacro(Keyed, bool);
  ///@}

  bool Paint(vtkContext2D* painter) override;

protected:
  vtkPalpChart();
  ~vtkPalpChart() override = default;

private:
  vtkPalpChart(const vtkPalpChart&) = delete;
  void operator=(const vtkPalpChart&) = delete;

  float PaintLegend(vtkContext2D* painter, const vtkRectf& rectangle, bool draw);

  void ScaleTo(double scale);

  vtkRectf Rectangle;
  double Scale = 1.0; // that pens, marks and gaps have now
  bool Keyed = true;
};
