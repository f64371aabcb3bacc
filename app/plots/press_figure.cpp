#include "app/plots/press_figure.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/press/review.h"
#include "haptics/units.h"
#include "pipeline/charts/plot_files.h"
#include "pipeline/figure/orientation.h"
#include "pipeline/figure/realism.h"
#include "pipeline/figure/scale_bar.h"
#include "pipeline/view/appearance.h"

#include <algorithm>
#include <cmath>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace palp
{
namespace
{

// a sample takes 8 bytes of color and depth
int samplesOf(double pixels)
{
  constexpr double kMost = 48e6; // samples
  return pixels * 8.0 <= kMost ? 8 : pixels * 4.0 <= kMost ? 4 : 0;
}

// pens have their width in pixels
void widenLines(vtkRenderer& renderer, double scale)
{
  vtkActorCollection& actors = *renderer.GetActors();
  actors.InitTraversal();
  while (vtkActor* actor = actors.GetNextActor())
  {
    vtkProperty& property = *actor->GetProperty();
    property.SetLineWidth(static_cast<float>(scale * property.GetLineWidth()));
  }
}

void addCaption(vtkRenderer& renderer, const std::string& caption, double scale)
{
  constexpr double kMargin = 16.0; // [pixels]
  vtkNew<vtkTextActor> text;
  text->SetInput(caption.c_str());
  appearance::setFont(*text->GetTextProperty(), 14);
  text->GetTextProperty()->SetVerticalJustificationToTop();
  text->SetPosition(kMargin * scale, renderer.GetSize()[1] - kMargin * scale);
  renderer.AddActor2D(text);
}

} // namespace

std::vector<Balls::Ball> ballsOf(std::span<const PlacedNodule> nodules)
{
  std::vector<Balls::Ball> balls;
  for (const PlacedNodule& nodule : nodules)
  {
    balls.push_back({ nodule.center, nodule.radius, appearance::kUnknown });
  }
  return balls;
}

PressMoment momentOf(const SceneBody& body, const Recording& recording,
  const Calibration& calibration, const Sample& sample, const SurfaceMap* map, bool isQuick)
{
  const auto colorOf = [](const OrganPlan& organ)
  {
    return appearance::Color{ organ.color[0] / 255.0, organ.color[1] / 255.0,
      organ.color[2] / 255.0 };
  };
  const std::vector<OrganPlan>& organs = recording.organs;
  const SceneBody& pressed = body.felt(organs, sample.organ);
  PressMoment moment{ pressed, organOf(recording.scene, sample.organ).law,
    organOf(calibration, sample.organ), sample, map };
  moment.second =
    recording.second ? nearestSample(recording.second->samples, sample.time) : nullptr;
  moment.drawn = isQuick && map == nullptr ? pressed.coarse.Get() : nullptr;
  for (std::size_t i = 0; i < organs.size(); ++i)
  {
    const SceneBody& organ = body.organs[i];
    if (&organ == &pressed)
    {
      moment.color = colorOf(organs[i]);
    }
    else if (organs[i].role != OrganRole::Hide)
    {
      moment.around.push_back({ .surface = isQuick && organ.coarse ? organ.coarse : organ.display,
        .color = colorOf(organs[i]),
        .isTranslucent = organs[i].role == OrganRole::Through,
        .isClosed = organ.haptic->closed() });
    }
  }
  return moment;
}

void prepareView(PressView& view, Surroundings& around, const PressMoment& moment)
{
  around.show(moment.around);
  view.setAround(around.box());
  view.setColor(moment.color);
  vtkPolyData* drawn = moment.drawn != nullptr ? moment.drawn : moment.body.display.Get();
  if (!view.shows(*drawn))
  {
    view.setSurface(drawn, moment.body.haptic && moment.body.haptic->closed());
  }
  view.setTip(moment.law.tip());
  view.setExtents(moment.calibration.extents);
  view.setStyle(moment.calibration.style);
  view.setLaw(moment.law);
  view.setMap(moment.map);
}

void showMoment(PressView& view, OtherHand& other, Surroundings& around, const PressMoment& moment)
{
  prepareView(view, around, moment);
  other.show(moment.sample, moment.second);
}

bool isPatient(const SceneBody& body)
{
  return spaceOf(body.files) == "LPS";
}

std::string toolAndTissue(const ForceLaw& law)
{
  const Material& tissue = law.material();
  return describeTip(law.tip()) +
    ", E = " + appearance::fixedText(units::toKilopascals(tissue.youngModulus), 1) +
    " kPa, \u03bd = " + appearance::fixedText(tissue.poissonRatio, 2) + ", " +
    describeLaw(law.settings());
}

std::string captionOf(const PressMoment& moment)
{
  const std::string ofMap = moment.map != nullptr ? moment.map->origin : "";
  const std::string press = toolAndTissue(moment.law) + "\ndepth " +
    appearance::fixedText(units::toMillimeters(moment.sample.contact.depth), 2) + " mm, force " +
    appearance::fixedText(moment.sample.response.force, 2) + " N";
  return moment.body.name + ", " +
    (ofMap.empty()                         ? press
        : moment.sample.contact.touching() ? ofMap + "\npressed by " + press
                                           : ofMap);
}

int dpiOf(ImageSize size)
{
  constexpr ImageSize kUsual{}; // whose letters are those of a screen
  const double area = static_cast<double>(size.width) * size.height / kUsual.width / kUsual.height;
  return static_cast<int>(std::lround(appearance::kDpi * std::max(1.0, std::sqrt(area))));
}

void drawFigure(vtkRenderWindow& window, const PressMoment& moment, const FigureLook& figure,
  const ViewUse& look, const FigureUse& use)
{
  const ImageSize size{ .width = window.GetSize()[0], .height = window.GetSize()[1] };
  const int samples = // occlusion brings a filter of its own
    figure.isRealistic ? 0 : samplesOf(static_cast<double>(size.width) * size.height);
  const int dpi = dpiOf(size);
  const double scale = dpi / appearance::kDpi;
  window.SetMultiSamples(samples);
  window.SetDPI(dpi);
  vtkNew<vtkRenderer> renderer;
  window.AddRenderer(renderer);
  PressView view(*renderer);
  OtherHand other(*renderer, view);
  Orientation orientation(*renderer);
  orientation.setPatient(isPatient(moment.body));
  orientation.setVisible(figure.hasAxes);
  ScaleBar bar(*renderer);
  bar.setVisible(figure.hasScaleBar);
  if (const Contact& contact = moment.sample.contact; contact.touching())
  {
    bar.setPlace(contact.center);
  }
  view.setVisible(figure.overlays);
  view.setColorBar(figure.hasColorBar);
  renderer->SetUseFXAA(samples == 0 && !figure.isRealistic);
  widenLines(*renderer, scale);
  Surroundings around(*renderer);
  showMoment(view, other, around, moment);
  look(view, *renderer);
  view.setLook(figure.body);
  Balls nodules(*renderer);
  nodules.show(
    figure.body.isTranslucent ? ballsOf(moment.body.shownNodules()) : std::vector<Balls::Ball>{});
  moment.second != nullptr ? other.show(moment.sample, moment.second) : void();
  Realism realism(*renderer);
  if (figure.isRealistic)
  {
    realism.turnOn(moment.body.display->GetLength());
  }
  if (figure.hasCaption)
  {
    addCaption(*renderer, captionOf(moment), scale);
  }
  if (figure.isTransparent)
  {
    renderer->GradientBackgroundOff();
    renderer->SetBackground(0.0, 0.0, 0.0);
    renderer->SetBackgroundAlpha(0.0);
  }
  use(view, other, around, *renderer);
  window.RemoveRenderer(renderer);
}

void writeFigure(vtkRenderWindow& window, const PressMoment& moment, const FigureLook& figure,
  const ViewUse& look, const std::filesystem::path& file)
{
  drawFigure(window, moment, figure, look,
    [&](PressView&, OtherHand&, Surroundings&, vtkRenderer&)
    { writePng(window, file, figure.isTransparent ? Backdrop::Transparent : Backdrop::Opaque); });
}

} // namespace palp
