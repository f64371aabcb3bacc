#include "app/draw/offscreen_renderer.h"

#include "app/draw/movie_file.h"
#include "app/draw/offscreen.h"
#include "app/plots/movie.h"
#include "app/plots/press_figure.h"
#include "app/plots/press_plots.h"
#include "app/press/export.h"
#include "app/program/progress_line.h"
#include "haptics/error.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/surface_point.h"
#include "haptics/units.h"
#include "pipeline/charts/force_charts.h"
#include "pipeline/charts/plot_files.h"
#include "pipeline/view/press_view.h"

#include <vtkCamera.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

constexpr ImageSize kChart{ .width = 1000, .height = 600 };

// where the camera looks: the deepest place, or where the tool came closest
SurfacePoint subject(const Recording& recording, const Sample& shown)
{
  if (shown.contact.touching())
  {
    return { shown.contact.center, shown.contact.normal };
  }
  const Surface& surface = *organOf(recording.scene, shown.organ).surface;
  const ClosestPoint nearest =
    findClosestPoint(surface, shown.pose.apex, std::numeric_limits<double>::infinity());
  return surfacePoint(surface, nearest.triangle, nearest.point);
}

// the organ that was pressed deepest; 0: the only body
int pressedOrgan(const Recording& recording)
{
  const Sample* deepest = recording.deepest();
  return deepest ? deepest->organ : 0;
}

FigureLook lookOf(const ScenePlan& plan)
{
  return { .hasAxes = true,
    .hasScaleBar = true,
    .overlays =
      plan.overlays.value_or(std::vector<Overlay>(kUsualOverlays.begin(), kUsualOverlays.end())) };
}

void drawScene(const OffscreenContext& context, const SceneBody& body, const Recording& recording,
  const Calibration& calibration, const ScenePlan& plan, const std::filesystem::path& file)
{
  const auto window = context.makeWindow(plan.size.width, plan.size.height);
  const Sample* deepest = recording.deepest();
  const Sample& shown = deepest ? *deepest : recording.samples.back();
  const SurfacePoint point = subject(recording, shown);
  writeFigure(
    *window, momentOf(body, recording, calibration, shown), lookOf(plan),
    [&](PressView& view, vtkRenderer&) { view.lookAtWhole(point.position, point.normal); }, file);
}

void drawMovie(const OffscreenContext& context, const SceneBody& body, const Recording& recording,
  const Calibration& calibration, const ScenePlan& plan, MovieKind kind,
  const std::filesystem::path& directory)
{
  const auto window = context.makeWindow(plan.size.width, plan.size.height);
  const Sample* deepest = recording.deepest();
  const Sample& shown = deepest ? *deepest : recording.samples.back();
  const SurfacePoint point = subject(recording, shown);
  const auto frames = movieFrames(kind, recording.samples, shown);
  MovieFile movie(*window, directory / kMovieNames[static_cast<std::size_t>(kind)], kMovieRate);
  ProgressLine progress("pictures of the " + kMovieNames[static_cast<std::size_t>(kind)]);
  const auto look = [&](PressView& view, vtkRenderer& renderer)
  {
    view.lookAtWhole(point.position, point.normal);
    if (plan.camera)
    {
      vtkCamera& camera = *renderer.GetActiveCamera();
      camera.SetPosition(plan.camera->position.data());
      camera.SetFocalPoint(plan.camera->focus.data());
      camera.SetViewUp(plan.camera->up.data());
      renderer.ResetCameraClippingRange();
    }
  };
  drawFigure(*window, momentOf(body, recording, calibration, shown), lookOf(plan), look,
    [&](PressView& view, OtherHand& other, Surroundings& around, vtkRenderer& renderer)
    {
      double turn = 0.0;
      int organ = shown.organ;
      for (std::size_t i = 0; i < frames.size(); ++i)
      {
        const Sample& sample = *frames[i].sample;
        const PressMoment moment = momentOf(body, recording, calibration, sample);
        std::exchange(organ, sample.organ) == sample.organ
          ? other.show(sample, moment.second)
          : showMoment(view, other, around, moment);
        renderer.GetActiveCamera()->Azimuth(units::toDegrees(frames[i].turn - turn));
        renderer.ResetCameraClippingRange();
        turn = frames[i].turn;
        movie.add();
        progress(i + 1, frames.size());
      }
    });
  movie.finish();
}

template <typename Add>
void drawChart(const OffscreenContext& context, const std::filesystem::path& file, Add add)
{
  const auto window = context.makeWindow(kChart.width, kChart.height);
  vtkNew<vtkContextView> view;
  view->SetRenderWindow(window);
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  add(*view->GetScene());
  writePng(*window, file);
}

void drawForce(const OffscreenContext& context, const Recording& recording, const ScenePlan& plan,
  const std::filesystem::path& directory)
{
  const double start = recording.samples.front().time;
  ForceCharts charts(recording.samples.back().time - start);
  charts.setLaw(organOf(recording.scene, pressedOrgan(recording)).law);
  charts.setSent(plan.chain);
  for (Sample sample : recording.samples)
  {
    sample.time -= start; // a clock may have counted from long ago
    charts.add(sample);
  }
  charts.refresh();
  if (plan.has(PlotKind::ForceOverTime))
  {
    drawChart(context, directory / "force_time.png",
      [&](vtkContextScene& scene) { charts.addForceOverTime(scene); });
  }
  if (plan.has(PlotKind::ForceOverDepth))
  {
    drawChart(context, directory / "force_depth.png",
      [&](vtkContextScene& scene) { charts.addForceOverDepth(scene); });
  }
}

Plots deepestSection(
  const SceneBody& body, const Recording& recording, const Calibration& calibration)
{
  const Sample* deepest = recording.deepest();
  if (!deepest)
  {
    return {};
  }
  vtkNew<vtkPalpDeformFilter> press;
  const Calibration& organ = organOf(calibration, deepest->organ);
  const SceneBody& pressed = body.felt(recording.organs, deepest->organ);
  press->SetInputData(pressed.display);
  press->GeneratePatchOn();
  press->SetPress(pressOf(*deepest, recording.scene.law.tip(), organ));
  press->Update();
  return sectionOf(*press, organ, pressed.shownNodules());
}

// first, as the band is about it; elements take sheets that are too thin or too stiff for the law
void addCoatedLaw(std::vector<NamedLaw>& laws, const fem::Case& study)
{
  if (study.coatings.empty())
  {
    return;
  }
  try
  {
    const LawSettings settings{ .mode = LawMode::Corrected, .coatings = study.coatings };
    laws.insert(laws.begin(),
      { "corrected, linear", ForceLaw(study.tip, study.material, settings),
        { .thickness = study.height } });
  }
  catch (const Error&)
  {
  }
}

} // namespace

void OffscreenRenderer::drawPress(const SceneBody& body, const Recording& recording,
  const Calibration* calibration, const ScenePlan& plan,
  const std::filesystem::path& directory) const
{
  const OffscreenContext context;
  if (plan.picture)
  {
    drawScene(context, body, recording, *calibration, plan, directory / "press.png");
  }
  for (const MovieKind kind : plan.movies)
  {
    drawMovie(context, body, recording, *calibration, plan, kind, directory);
  }
  drawForce(context, recording, plan, directory);
  const auto draw = [&](PlotKind plot, const char* name, const std::function<Plots()>& make)
  {
    const Plots plots = plan.has(plot) ? make() : Plots{};
    if (plots.empty())
    {
      return;
    }
    const auto window =
      context.makeWindow(kChart.width, kChart.height * (plots.size() > 1 ? 3 : 2) / 2);
    showPlots(*window, plots);
    for (const std::string& ending : plan.plotFiles)
    {
      writePlots(plots, *window, directory / (name + ("." + ending)));
    }
  };
  const int organ = pressedOrgan(recording);
  const Calibration* organs = calibration ? &organOf(*calibration, organ) : nullptr;
  draw(PlotKind::Comparison, "comparison",
    [&]
    {
      std::vector<Sample> press = recording.samples;
      std::erase_if(press, [organ](const Sample& sample) { return sample.organ != organ; });
      return forceComparison(organOf(recording.scene, organ), press, organs, plan.references);
    });
  if (calibration)
  {
    draw(
      PlotKind::Section, "section", [&] { return deepestSection(body, recording, *calibration); });
    draw(PlotKind::Extent, "extent", [&] { return extentComparison(*organs); });
  }
}

void OffscreenRenderer::drawCalibration(const fem::Case& study,
  const std::vector<fem::IndentationStep>& steps, const std::filesystem::path& directory) const
{
  if (steps.size() < 2)
  {
    return; // a curve needs two points
  }
  const OffscreenContext context;
  const auto draw = [&](const char* name, Plot& plot)
  { drawChart(context, directory / name, [&](vtkContextScene& scene) { plot.addTo(scene); }); };

  std::vector<ExtentTable::Extent> rows;
  ReferenceCurve force{
    .name = "elements, " + std::string(fem::name(study.energy)), .x = {}, .y = {}
  };
  Plot profiles("surface at each depth", "distance from the axis [mm]", "height [mm]");
  for (const fem::IndentationStep& step : steps)
  {
    rows.push_back({ .depth = step.depth,
      .extentRadius = fem::extentRadius(step.profile, study.threshold),
      .force = step.force,
      .contactRadius = step.contactRadius });
    force.x.push_back(step.depth);
    force.y.push_back(step.force);
    std::vector<double> radiusMm;
    std::vector<double> heightMm;
    for (const fem::IndentationStep::Point& point : step.profile)
    {
      radiusMm.push_back(units::toMillimeters(point.radius + point.ur));
      heightMm.push_back(units::toMillimeters(point.uz));
    }
    profiles.addLine({}, radiusMm, heightMm, appearance::kMeasured, 1.5F);
  }
  // the paper's cone is sharp
  const auto* blunt = std::get_if<BluntConeTip>(&study.tip);
  const Tip papers = blunt != nullptr
    ? Tip{ ConeTip{ .halfAngle = blunt->halfAngle, .baseRadius = blunt->baseRadius } }
    : study.tip;
  const std::string of = study.coatings.empty() ? "" : ", without coatings";
  std::vector<NamedLaw> laws{ { (blunt != nullptr ? "paper, sharp" : "paper") + of,
                                ForceLaw(papers, study.material) },
    { "exact half-space" + of,
      ForceLaw(study.tip, study.material, LawSettings{ .mode = LawMode::Exact }) } };
  addCoatedLaw(laws, study);
  draw("force.png", *forcePlot(laws, steps.back().depth, { force }));
  draw("extent.png", *extentPlot(ExtentTable(rows), {}));
  draw("profiles.png", profiles);
}

} // namespace palp
