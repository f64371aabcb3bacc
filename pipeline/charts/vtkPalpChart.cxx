#include "pipeline/charts/vtkPalpChart.h"

#include "pipeline/view/appearance.h"

#include <string>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

namespace
{

constexpr double kLeastHeight =
  80.0; // [pixels at a scale of 1]: title and numbers below, and a curve

} // namespace

vtkStandardNewMacro(vtkPalpChart);

vtkPalpChart::vtkPalpChart()
{
  this->SetShowLegend(false);
  this->SetAutoSize(false);
  this->SetRenderEmpty(true); // else axes have no place, which their titles stand at
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis* axis = this->GetAxis(side);
    axis->SetTitleVisible(false); // which would be over the numbers at a large scale
    axis->SetMargins(axis->GetMargins()[0] + 5, axis->GetMargins()[1]);
  }
}

void vtkPalpChart::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bottom: " << this->Bottom << '\n'
     << indent << "Top: " << this->Top << '\n'
     << indent << "Keyed: " << this->Keyed << '\n'
     << indent << "Hidden: " << this->Hidden.size() << " curves\n";
}

void vtkPalpChart::SetShare(double bottom, double top)
{
  this->Bottom = bottom;
  this->Top = top;
  this->Modified();
}

// fonts follow the dots per inch of the screen; what has its size in pixels follows here
void vtkPalpChart::ScaleTo(double scale)
{
  const auto growth = static_cast<float>(scale / this->Scale);
  if (growth == 1.0F)
  {
    return;
  }
  this->Scale = scale;
  for (vtkIdType i = 0; i < this->GetNumberOfPlots(); ++i)
  {
    vtkPlot* plot = this->GetPlot(i);
    plot->GetPen()->SetWidth(growth * plot->GetPen()->GetWidth());
    if (auto* points = vtkPlotPoints::SafeDownCast(plot))
    {
      points->SetMarkerSize(growth * points->GetMarkerSize());
    }
  }
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis* axis = this->GetAxis(side);
    for (vtkPen* pen : { axis->GetPen(), axis->GetGridPen() })
    {
      pen->SetWidth(growth * pen->GetWidth());
    }
    axis->SetLabelOffset(growth * axis->GetLabelOffset());
    axis->SetTickLength(growth * axis->GetTickLength());
    axis->SetMargins(static_cast<int>(growth * static_cast<float>(axis->GetMargins()[0])),
      static_cast<int>(growth * static_cast<float>(axis->GetMargins()[1])));
  }
  this->SetHiddenAxisBorder(
    static_cast<int>(growth * static_cast<float>(this->GetHiddenAxisBorder())));
}

vtkRectf vtkPalpChart::Whole() const
{
  const double height = this->Scene->GetSceneHeight();
  return { 0.0F, static_cast<float>(this->Bottom * height),
    static_cast<float>(this->Scene->GetSceneWidth()),
    static_cast<float>((this->Top - this->Bottom) * height) };
}

bool vtkPalpChart::Paint(vtkContext2D* painter)
{
  if (vtkRenderer* renderer = this->Scene->GetRenderer())
  {
    this->ScaleTo(renderer->GetRenderWindow()->GetDPI() / palp::appearance::kDpi);
  }
  this->ShowCurves();
  const vtkRectf rectangle = this->Whole();
  const float legend = this->Keyed ? this->PaintLegend(painter, rectangle, false) : 0.0F;
  const vtkRectf chart(rectangle.GetX(), rectangle.GetY() + legend, rectangle.GetWidth(),
    rectangle.GetHeight() - legend);
  if (chart.GetHeight() < kLeastHeight * this->Scale)
  {
    return false; // its axes would have no length, and its curves no finite scale
  }
  if (this->GetSize() != chart)
  {
    this->SetSize(chart);
    this->GetAxis(vtkAxis::LEFT)->Modified(); // else the chart keeps its old layout
  }
  const bool painted = this->Superclass::Paint(painter);
  this->PaintTitles(painter, chart);
  if (this->Keyed)
  {
    this->PaintLegend(painter, rectangle, true);
  }
  return painted;
}

// those of the axes, along the edge of the chart
void vtkPalpChart::PaintTitles(vtkContext2D* painter, const vtkRectf& chart)
{
  for (const int side : { vtkAxis::BOTTOM, vtkAxis::LEFT })
  {
    vtkAxis* axis = this->GetAxis(side);
    painter->ApplyTextProp(axis->GetTitleProperties());
    float bounds[4];
    painter->ComputeStringBounds(axis->GetTitle(), bounds);
    const float middle =
      0.5F * (axis->GetPoint1()[side == vtkAxis::LEFT] + axis->GetPoint2()[side == vtkAxis::LEFT]);
    side == vtkAxis::LEFT
      ? painter->DrawString(chart.GetX() + 1.15F * bounds[2], middle, axis->GetTitle())
      : painter->DrawString(middle, chart.GetY() + 1.15F * bounds[3], axis->GetTitle());
  }
}

// its height, whether it is drawn or not
float vtkPalpChart::PaintLegend(vtkContext2D* painter, const vtkRectf& rectangle, bool draw)
{
  vtkNew<vtkTextProperty> text;
  palp::appearance::setFont(*text, 12);
  text->SetVerticalJustificationToCentered();
  painter->ApplyTextProp(text);
  float bounds[4];
  painter->ComputeStringBounds(std::string("Mg"), bounds);
  const float line = 1.25F * bounds[3];
  const float mark = 1.6F * bounds[3];
  const float gap = 0.5F * bounds[3];

  this->Names.clear();
  float x = gap;
  float row = 1.0F;
  for (vtkIdType i = 0; i < this->GetNumberOfPlots(); ++i)
  {
    const std::string label = this->GetPlot(i)->GetLabel();
    if (label.empty())
    {
      continue;
    }
    painter->ComputeStringBounds(label, bounds);
    const float width = mark + gap + bounds[2];
    if (x > gap && x + width > rectangle.GetWidth())
    {
      x = gap;
      row += 1.0F;
    }
    if (draw)
    {
      const float y = this->GetSize().GetY() - (row - 0.5F) * line; // down from the chart
      const float left = rectangle.GetX() + x;
      this->Names.emplace_back(label, vtkRectf(left, y - 0.5F * line, width, line));
      this->PaintEntry(painter, i, vtkRectf(left, y - 0.3F * line, mark, 0.6F * line));
      const bool isShown = this->IsCurveShown(label);
      text->SetColor(this->GetAxis(vtkAxis::BOTTOM)->GetTitleProperties()->GetColor());
      text->SetOpacity(isShown ? 1.0 : 0.45);
      painter->ApplyTextProp(text);
      painter->DrawString(left + mark + gap, y, label);
    }
    x += width + 2.0F * gap;
  }
  return x > gap ? row * line + gap : 0.0F;
}

// of a hidden curve an empty box
void vtkPalpChart::PaintEntry(vtkContext2D* painter, vtkIdType plot, const vtkRectf& mark)
{
  if (this->IsCurveShown(this->GetPlot(plot)->GetLabel()))
  {
    this->GetPlot(plot)->PaintLegend(painter, mark, 0);
    return;
  }
  painter->GetPen()->SetColor(160, 160, 160);
  painter->GetPen()->SetWidth(1.0F);
  painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
  painter->GetBrush()->SetColor(255, 255, 255, 0);
  painter->DrawRect(mark.GetX(), mark.GetY(), mark.GetWidth(), mark.GetHeight());
}
