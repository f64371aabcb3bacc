#include "pipeline/press_view.h"

#include "haptics/units.h"
#include "pipeline/appearance.h"
#include "pipeline/tool_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vtkCamera.h>
#include <vtkLightKit.h>
#include <vtkMatrix4x4.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

using namespace units::literals;
using appearance::fixedText;

constexpr double kViewAngle = 30.0; // [deg]
constexpr double kDegree = 1.0_deg;

vtkNew<vtkMatrix4x4> placement(const Eigen::Vector3d& origin, const Eigen::Matrix3d& axes)
{
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      matrix->SetElement(row, column, axes(row, column));
    }
    matrix->SetElement(row, 3, origin[row]);
  }
  return matrix;
}

// right-handed axes of which one is given
Eigen::Matrix3d axesAlong(const Eigen::Vector3d& direction, int axis)
{
  const Eigen::Vector3d next = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes.col(axis) = direction;
  axes.col((axis + 1) % 3) = next;
  axes.col((axis + 2) % 3) = direction.cross(next);
  return axes;
}

void setColor(vtkActor& actor, const appearance::Color& color)
{
  actor.GetProperty()->SetColor(color[0], color[1], color[2]);
}

} // namespace

PressView::PressView(vtkRenderer& renderer)
  : renderer_(renderer)
  , colors_(appearance::viridisOn(appearance::kLiver))
{
  const auto& ground = appearance::kGround;
  const auto& sky = appearance::kSky;
  renderer_.SetBackground(ground[0], ground[1], ground[2]);
  renderer_.SetBackground2(sky[0], sky[1], sky[2]);
  renderer_.GradientBackgroundOn();
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.85);
  lights->SetKeyToFillRatio(2.0);
  lights->SetKeyToHeadRatio(2.5);
  lights->AddLightsToRenderer(&renderer_);
  renderer_.GetActiveCamera()->SetViewAngle(kViewAngle);

  addSurface();
  addTool();
  addLine(contactCircle_, appearance::kContact);
  addLine(extentCircle_, appearance::kExtent);
  addTexts();
}

PressView::~PressView() = default;

void PressView::addSurface()
{
  surface_->SetMapper(surfaceMapper_);
  setColor(*surface_, appearance::kLiver);
  surface_->GetProperty()->SetSpecular(0.25);
  surface_->GetProperty()->SetSpecularPower(25.0);

  dentMapper_->SetInputConnection(deform_->GetOutputPort(1));
  dentMapper_->SetScalarModeToUsePointFieldData();
  dentMapper_->SelectColorArray("Displacement [mm]");
  dentMapper_->SetLookupTable(colors_);
  dentMapper_->UseLookupTableScalarRangeOn();
  dentMapper_->InterpolateScalarsBeforeMappingOn();
  dent_->SetMapper(dentMapper_);
  dent_->SetProperty(surface_->GetProperty());
  dent_->VisibilityOff();
}

void PressView::addTool()
{
  // behind the surface that lies on it
  toolMapper_->SetResolveCoincidentTopologyToPolygonOffset();
  toolMapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 8.0);
  tool_->SetMapper(toolMapper_);
  setColor(*tool_, appearance::kTool);
  tool_->GetProperty()->SetOpacity(0.4);
  tool_->GetProperty()->BackfaceCullingOn();
  tool_->GetProperty()->SetSpecular(0.6);
  tool_->GetProperty()->SetSpecularPower(40.0);
  tool_->VisibilityOff();
  setTip(tip_);

  arrowSource_->SetTipResolution(32);
  arrowSource_->SetShaftResolution(32);
  arrowMapper_->SetInputConnection(arrowSource_->GetOutputPort());
  arrow_->SetMapper(arrowMapper_);
  setColor(*arrow_, appearance::kForce);
  arrow_->GetProperty()->SetAmbient(0.35);
  arrow_->VisibilityOff();
}

void PressView::addLine(Line& line, const appearance::Color& color)
{
  line.contour->SetInputConnection(deform_->GetOutputPort(1));
  line.contour->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Distance");
  line.contour->ComputeScalarsOff();
  line.contour->ComputeNormalsOff();
  line.mapper->SetInputConnection(line.contour->GetOutputPort());
  line.mapper->ScalarVisibilityOff();
  line.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  line.mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-4.0, -200.0);
  line.actor->SetMapper(line.mapper);
  line.actor->GetProperty()->SetLineWidth(3.0F);
  line.actor->GetProperty()->LightingOff();
  line.actor->VisibilityOff();
  setColor(*line.actor, color);
  renderer_.AddActor(line.actor);
}

void PressView::addTexts()
{
  for (vtkActor* actor : { surface_.Get(), dent_.Get(), tool_.Get(), arrow_.Get() })
  {
    renderer_.AddActor(actor);
  }
  legend_->SetLookupTable(colors_);
  legend_->SetTitle("displacement [mm]");
  legend_->SetNumberOfLabels(6);
  legend_->SetLabelFormat("%.3g");
  legend_->SetUnconstrainedFontSize(true);
  legend_->SetBarRatio(0.25);
  legend_->SetWidth(0.10);
  legend_->SetHeight(0.45);
  legend_->SetPosition(0.87, 0.28);
  legend_->SetVerticalTitleSeparation(10);
  appearance::setFont(*legend_->GetTitleTextProperty(), 15, appearance::kInk, true);
  appearance::setFont(*legend_->GetLabelTextProperty(), 14);
  for (vtkTextProperty* text : { legend_->GetTitleTextProperty(), legend_->GetLabelTextProperty() })
  {
    text->SetBackgroundColor(1.0, 1.0, 1.0);
    text->SetBackgroundOpacity(0.6);
  }
  legend_->VisibilityOff();
  renderer_.AddActor2D(legend_);

  vtkTextProperty& label = *forceLabel_->GetTextProperty();
  appearance::setFont(label, 20, appearance::kInk, true);
  label.SetBackgroundColor(1.0, 1.0, 1.0);
  label.SetBackgroundOpacity(0.75);
  label.SetVerticalJustificationToCentered();
  forceLabel_->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  forceLabel_->VisibilityOff();
  renderer_.AddActor2D(forceLabel_);

  const std::array<appearance::Color, 3> inks{ appearance::kPaper, appearance::kContact,
    appearance::kExtent };
  for (std::size_t i = 0; i < readings_.size(); ++i)
  {
    vtkTextProperty& text = *readings_[i]->GetTextProperty();
    appearance::setFont(text, 16, inks[i], i == 0);
    text.SetBackgroundColor(0.13, 0.15, 0.18);
    text.SetBackgroundOpacity(0.8);
    readings_[i]->SetPosition(16.0, 72.0 - 28.0 * static_cast<double>(i));
    readings_[i]->VisibilityOff();
    renderer_.AddActor2D(readings_[i]);
  }
}

void PressView::setSurface(vtkPolyData* surface)
{
  deform_->SetInputDataObject(surface);
  surfaceMapper_->SetInputConnection(deform_->GetOutputPort());
  diagonal_ = surface->GetLength();
  deform_->SetPress(Press{});
}

void PressView::setTip(const Tip& tip)
{
  tip_ = tip;
  toolMapper_->SetInputData(toolSurface(tip, std::max(4.0 * baseRadius(tip), 40.0_mm)));
}

void PressView::setExtents(const ExtentTable& extents)
{
  extents_ = extents;
}

double PressView::extentRadius(double depth) const noexcept
{
  return extents_ ? extents_->extentRadius(depth) : 0.0;
}

vtkPolyData* PressView::deformed()
{
  deform_->Update();
  return deform_->GetOutput();
}

void PressView::setVisible(Overlay overlay, bool visible)
{
  visible_[static_cast<std::size_t>(overlay)] = visible;
}

bool PressView::isVisible(Overlay overlay) const
{
  return visible_[static_cast<std::size_t>(overlay)];
}

void PressView::show(const Sample& sample)
{
  const double extent = extentRadius(sample.contact.depth);
  deform_->SetPress({ .contact = sample.contact,
    .pose = sample.pose,
    .tip = tip_,
    .contactRadius = sample.response.contactRadius,
    .extentRadius = extent });
  placeTool(sample.pose);
  placeArrow(sample);
  placeCircles(sample, extent);
  placeDent(sample);
  placeReadings(sample, extent);
}

void PressView::placeTool(const ToolPose& pose)
{
  const bool known = pose.apex.allFinite() && pose.axis.allFinite();
  tool_->SetVisibility(known);
  if (known)
  {
    tool_->SetUserMatrix(placement(pose.apex, axesAlong(-pose.axis, 2)));
  }
}

void PressView::placeArrow(const Sample& sample)
{
  const bool shown = isVisible(Overlay::ForceArrow) && sample.contact.touching();
  arrow_->SetVisibility(shown);
  forceLabel_->SetVisibility(shown);
  if (!shown)
  {
    return;
  }
  // as long as the force is large, within what the view can hold; as thick as the tool allows
  constexpr double kMetresPerNewton = 0.025;
  const double length = std::clamp(
    sample.response.force * kMetresPerNewton, 15.0_mm, std::max(70.0_mm, 6.0 * baseRadius(tip_)));
  const double thickness = std::min(0.15 * baseRadius(tip_), 0.12 * length);
  arrowSource_->SetShaftRadius(thickness / length);
  arrowSource_->SetTipRadius(2.6 * thickness / length);
  arrowSource_->SetTipLength(std::min(0.5, 7.0 * thickness / length));
  const Eigen::Vector3d normal = sample.contact.normal;
  const Eigen::Vector3d start = sample.contact.center - sample.contact.depth * normal;
  arrow_->SetUserMatrix(placement(start, length * axesAlong(normal, 0)));

  const Eigen::Vector3d end = start + (length + thickness) * normal;
  forceLabel_->GetPositionCoordinate()->SetValue(end.x(), end.y(), end.z());
  forceLabel_->SetInput(fixedText(sample.response.force, 2).append(" N").c_str());
}

void PressView::placeCircles(const Sample& sample, double extent)
{
  const bool touching = sample.contact.touching();
  contactCircle_.actor->SetVisibility(touching && isVisible(Overlay::ContactCircle));
  contactCircle_.contour->SetValue(0, sample.response.contactRadius);
  extentCircle_.actor->SetVisibility(touching && isVisible(Overlay::ExtentCircle) && extent > 0.0);
  extentCircle_.contour->SetValue(0, extent);
}

// the dent is drawn by itself where it is finer than the mesh or has colours
void PressView::placeDent(const Sample& sample)
{
  const bool touching = sample.contact.touching();
  const bool colored = touching && isVisible(Overlay::DisplacementColors);
  deform_->SetGeneratePatch(touching);
  deform_->Update();
  const bool apart = colored || (touching && deform_->GetUsedPatchLevel() > 0);
  dent_->SetVisibility(apart);
  surfaceMapper_->SetHideDent(apart);
  dentMapper_->SetScalarVisibility(colored);
  legend_->SetVisibility(colored);
  if (colored)
  {
    colors_->SetTableRange(0.0, appearance::roundUp(units::toMillimetres(sample.contact.depth)));
  }
}

void PressView::placeReadings(const Sample& sample, double extent)
{
  const bool shown = isVisible(Overlay::Readings) && sample.contact.touching();
  const auto millimetres = [](double metres)
  { return fixedText(units::toMillimetres(metres), 1) + " mm "; };
  const std::string force = fixedText(sample.response.force, 2);
  readings_[0]->SetInput(
    (" force " + force + " N   depth " + millimetres(sample.contact.depth)).c_str());
  readings_[1]->SetInput(
    (" \u25cb contact circle r = " + millimetres(sample.response.contactRadius)).c_str());
  readings_[2]->SetInput((" \u25cb extent circle R_d = " + millimetres(extent)).c_str());
  readings_[0]->SetVisibility(shown);
  readings_[1]->SetVisibility(shown && isVisible(Overlay::ContactCircle));
  readings_[2]->SetVisibility(shown && isVisible(Overlay::ExtentCircle) && extent > 0.0);
}

void PressView::lookAtSurface()
{
  vtkCamera& camera = *renderer_.GetActiveCamera();
  camera.SetFocalPoint(0.0, 0.0, 0.0);
  camera.SetPosition(-0.35, -1.0, 0.75);
  camera.SetViewUp(0.0, 0.0, 1.0);
  double bounds[6];
  surfaceMapper_->GetBounds(bounds);
  renderer_.ResetCamera(bounds);
}

void PressView::lookAt(const Eigen::Vector3d& place, const Eigen::Vector3d& normal)
{
  // 50 degrees from the normal shows into the dent and along the arrow
  constexpr double kObliquity = 50.0;
  const double height = std::max(9.0 * baseRadius(tip_), 0.45 * diagonal_);
  const double distance = 0.5 * height / std::tan(0.5 * kViewAngle * kDegree);
  // from the front where that is possible, so that the view does not roll with the normal
  Eigen::Vector3d side = -Eigen::Vector3d::UnitY() + normal.y() * normal;
  side = side.norm() > 0.3 ? side.normalized() : normal.unitOrthogonal();
  const Eigen::Vector3d towards =
    std::cos(kObliquity * kDegree) * normal + std::sin(kObliquity * kDegree) * side;
  const Eigen::Vector3d focus = place + 0.12 * height * normal;
  const Eigen::Vector3d eye = focus + distance * towards;
  vtkCamera& camera = *renderer_.GetActiveCamera();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(normal.data());
  renderer_.ResetCameraClippingRange();
}

} // namespace palp
