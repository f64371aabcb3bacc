#include "pipeline/view/press_view.h"

#include "haptics/units.h"
#include "pipeline/layout/fill_picture.h"
#include "pipeline/model/section_face.h"
#include "pipeline/view/control_net.h"
#include "pipeline/view/force_arrow.h"
#include "pipeline/view/ghost.h"
#include "pipeline/view/iso_lines.h"
#include "pipeline/view/surface_circle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kViewAngle = 30.0_deg;
constexpr double kWet = 0.35; // share of a highlight
constexpr appearance::Color kEdges{ 0.28, 0.07, 0.06 };

constexpr std::size_t indexOf(Overlay overlay)
{
  return static_cast<std::size_t>(overlay);
}

} // namespace

PressView::PressView(vtkRenderer& renderer)
  : renderer_(renderer)
{
  appearance::setUpScene(renderer_);
  renderer_.GetActiveCamera()->SetViewAngle(units::toDegrees(kViewAngle));

  // what is translucent comes last
  addSurface();
  addOverlays();
  tool_.emplace(renderer_);
  setTip(tip_);
  for (const Overlay overlay : kUsualOverlays)
  {
    setVisible(overlay, true);
  }
}

PressView::~PressView() = default;

void PressView::addSurface()
{
  surface_->SetMapper(surfaceMapper_);
  surfaceMapper_->SetScalarModeToUsePointFieldData();
  surfaceMapper_->UseLookupTableScalarRangeOn();
  surface_->GetProperty()->SetSpecularPower(40.0);
  renderer_.AddActor(surface_);
  dent_.emplace(renderer_, *deform_, surface_->GetProperty());
  surfaceMapper_->SetLookupTable(dent_->surfaceColors());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sectionFace(deform_->GetOutputPort(), *cut_)->GetOutputPort());
  mapper->ScalarVisibilityOff();
  cap_->SetMapper(mapper);
  cap_->GetProperty()->SetAmbient(0.4); // light comes from above, and it may stand upright
  cap_->VisibilityOff();
  renderer_.AddActor(cap_);
  setColor(color_);
}

void PressView::addOverlays()
{
  const auto put = [this](Overlay overlay, std::unique_ptr<OverlayProps> props)
  { overlays_[indexOf(overlay)] = std::move(props); };
  put(Overlay::ForceArrow, std::make_unique<ForceArrow>(renderer_));
  put(
    Overlay::ContactCircle, std::make_unique<SurfaceCircle>(renderer_, SurfaceCircle::Of::Contact));
  put(Overlay::ExtentCircle, std::make_unique<SurfaceCircle>(renderer_, SurfaceCircle::Of::Extent));
  put(Overlay::IsoLines, std::make_unique<IsoLines>(renderer_));
  put(Overlay::ControlNet, std::make_unique<ControlNet>(renderer_));
  put(Overlay::Ghost, std::make_unique<Ghost>(renderer_, *deform_));
  auto readings = std::make_unique<Readings>(renderer_);
  readings_ = readings.get();
  put(Overlay::Readings, std::move(readings));
}

void PressView::setSurface(vtkPolyData* surface, bool isClosed)
{
  isClosed_ = isClosed;
  setLook(look_);
  map_.reset();
  rest_->ShallowCopy(surface);
  colorSurface();
  deform_->SetInputDataObject(rest_);
  surfaceMapper_->SetInputConnection(deform_->GetOutputPort());
  diagonal_ = surface->GetLength();
  show(Sample{});
}

void PressView::setColor(const appearance::Color& color)
{
  color_ = color;
  ++version_;
  appearance::setColor(*surface_->GetProperty(), color);
  appearance::setColor(*cap_->GetProperty(), color);
  dent_->setBase(color);
}

void PressView::setLook(const BodyLook& look)
{
  constexpr double kTranslucent = 0.4;
  vtkProperty& property = *surface_->GetProperty();
  look_ = look;
  tool_->setLook(look.tool);
  property.SetEdgeVisibility(look.hasEdges);
  property.SetEdgeColor(kEdges.data());
  property.SetOpacity(look.isTranslucent ? kTranslucent : 1.0);
  cap_->GetProperty()->SetOpacity(property.GetOpacity());
  cap_->SetVisibility(isClosed_ && look.isCut);
  property.SetBackfaceCulling(isClosed_ && !look.isCut);
  renderer_.GetActiveCamera()->GetDirectionOfProjection(cutAlong_.data());
  cut_->SetNormal(cutAlong_.data());
  cut_->SetOrigin(surfaceMapper_->GetInput() ? surfaceMapper_->GetCenter() : cut_->GetOrigin());
  cut(*surfaceMapper_);
  cut(*dent_->mapper());
}

void PressView::cut(vtkMapper& mapper)
{
  mapper.RemoveAllClippingPlanes();
  look_.isCut ? mapper.AddClippingPlane(cut_) : void();
}

void PressView::setMap(const SurfaceMap* map)
{
  if (map_)
  {
    rest_->GetPointData()->RemoveArray(map_->values->GetName());
    map_.reset();
  }
  if (map != nullptr)
  {
    map_ = *map;
    rest_->GetPointData()->AddArray(map_->values);
  }
  rest_->Modified();
  colorSurface();
}

void PressView::colorSurface()
{
  vtkProperty& property = *surface_->GetProperty();
  property.SetSpecular(map_ ? 0.05 : kWet);
  property.SetAmbient(map_ ? 0.4 : 0.0); // near the colors of the bar
  property.SetDiffuse(map_ ? 0.75 : 1.0);
  surfaceMapper_->SetScalarVisibility(map_.has_value());
  if (map_)
  {
    surfaceMapper_->SelectColorArray(map_->values->GetName());
  }
}

void PressView::setTip(const Tip& tip)
{
  tip_ = tip;
  ++version_;
  tool_->setTip(tip);
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
  visible_[indexOf(overlay)] = visible;
}

void PressView::setVisible(const std::vector<Overlay>& overlays)
{
  visible_.fill(false);
  for (const Overlay overlay : overlays)
  {
    setVisible(overlay, true);
  }
}

bool PressView::isVisible(Overlay overlay) const
{
  return visible_[indexOf(overlay)];
}

Press PressView::drawnPress(const Sample& sample, const std::vector<OrganLoad>& beside) const
{
  return pressOf(
    sample, tip_, [this](double depth) { return extentRadius(depth); }, style_, beside);
}

std::vector<OrganLoad> PressView::loadsOf(const Sample& sample) const
{
  return palp::loadsOf(drawnSample(sample, left_), style_);
}

void PressView::show(const Sample& sample)
{
  const Sample dented = drawnSample(sample, left_);
  left_ = sample.contact.touching() ? sample : left_;
  deform_->SetPress(drawnPress(dented, beside_));
  deform_->SetGeneratePatch(dented.contact.touching());
  deform_->Update();
  const OverlayState state{ sample, tip_, deform_->GetPress().extentRadius, *deform_ };
  tool_->place(sample.pose);
  placeCut(sample.contact);
  placeDent(state);
  const bool isPushed = isVisible(Overlay::ForceArrow) && sample.contact.touching();
  above_ = std::max(ToolProps::heightOf(tip_),
    isPushed ? ForceArrow::lengthOf(sample.response.force, diagonal_) : 0.0);
  readings_->setKeys({ .arrow = isPushed,
    .contactCircle = isVisible(Overlay::ContactCircle),
    .extentCircle = isVisible(Overlay::ExtentCircle),
    .isoLines = isVisible(Overlay::IsoLines),
    .validity = isVisible(Overlay::ValidityColors) ? dent_->rule(state) : std::string{} });
  for (std::size_t i = 0; i < kOverlayCount; ++i)
  {
    if (overlays_[i])
    {
      visible_[i] && sample.contact.touching() ? overlays_[i]->show(state) : overlays_[i]->hide();
    }
  }
}

// along the normal, so that the profile of the dent is seen
void PressView::placeCut(const Contact& contact)
{
  const Eigen::Vector3d aside = cutAlong_ - cutAlong_.dot(contact.normal) * contact.normal;
  if (contact.touching() && !aside.isZero(1e-3))
  {
    cut_->SetOrigin(contact.center.data());
    cut_->SetNormal(aside.normalized().eval().data());
  }
}

DentColors::By PressView::colors() const
{
  return map_                                ? DentColors::By::Map
    : isVisible(Overlay::ValidityColors)     ? DentColors::By::Validity
    : isVisible(Overlay::PressureColors)     ? DentColors::By::Pressure
    : isVisible(Overlay::DisplacementColors) ? DentColors::By::Displacement
                                             : DentColors::By::Nothing;
}

// the dent is drawn by itself where it is finer than the mesh or has colors; two that meet are one
void PressView::placeDent(const OverlayState& state)
{
  const DentColors::By by = colors();
  const bool touches = state.sample.contact.touching();
  const Dent& dent = deform_->GetDent();
  const bool apart = (touches || !dent.deepened().empty()) && !dent.meetsOther() &&
    by != DentColors::By::Map &&
    (by != DentColors::By::Nothing || deform_->GetUsedPatchLevel() > 0);
  surfaceMapper_->SetHideDent(apart);
  if (apart && touches)
  {
    dent_->show(state, by, deepestBeside_);
  }
  else
  {
    dent_->hide();
  }
  if (map_)
  {
    dent_->showLegend(*map_);
  }
}

// with what is around
vtkBoundingBox PressView::whole()
{
  vtkBoundingBox box(surfaceMapper_->GetBounds());
  box.AddBox(around_);
  return box;
}

void PressView::lookAtSurface()
{
  lookFrom({ -0.35, -1.0, 0.75 }, Eigen::Vector3d::UnitZ());
}

void PressView::lookFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& up)
{
  vtkCamera& camera = *renderer_.GetActiveCamera();
  camera.SetFocalPoint(0.0, 0.0, 0.0);
  camera.SetPosition(eye.data());
  camera.SetViewUp(up.data());
  double bounds[6];
  whole().GetBounds(bounds);
  renderer_.ResetCamera(bounds);
  const int* size = renderer_.GetSize();
  const bool isNarrow = PictureRoom{ .width = 1.0 * size[0], .height = 1.0 * size[1] }.isNarrow();
  isNarrow && !around_.IsValid() ? fillPicture(renderer_, *rest_) : void();
}

void PressView::lookAtWhole(const Eigen::Vector3d& position, const Eigen::Vector3d& normal)
{
  constexpr double kObliquity = 40.0_deg;
  // a place on top is seen from the front, any other from above
  const bool onTop = std::abs(normal.z()) > 0.7;
  const Eigen::Vector3d up = onTop ? normal : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d aside = onTop ? Eigen::Vector3d(-Eigen::Vector3d::UnitY()) : up;
  const Eigen::Vector3d side = (aside - aside.dot(normal) * normal).normalized();
  const Eigen::Vector3d towards = std::cos(kObliquity) * normal + std::sin(kObliquity) * side;

  const vtkBoundingBox box = whole();
  Eigen::Vector3d middle;
  box.GetCenter(middle.data());
  const double extent = around_.IsValid() ? box.GetDiagonalLength() : diagonal_;
  const Eigen::Vector3d focus = 0.6 * middle + 0.4 * position;
  const double spread = std::tan(0.5 * kViewAngle);
  // tool and arrow may be larger than the surface, and are nearer
  const Eigen::Vector3d top = position + above_ * normal - focus;
  const double nearer = top.dot(towards);
  const double across = (top - nearer * towards).norm();
  const double away = std::max(0.45 * extent / spread, nearer + 1.2 * across / spread);
  const Eigen::Vector3d eye = focus + away * towards;
  vtkCamera& camera = *renderer_.GetActiveCamera();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(up.data());
  camera.SetWindowCenter(0.15, 0.0); // the legend has the right side
  renderer_.ResetCameraClippingRange();
}

} // namespace palp
