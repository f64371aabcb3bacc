#include "app/draw/draw_figure.h"

#include "app/draw/offscreen.h"
#include "app/folder/export_folder.h"
#include "app/plots/figure_job.h"
#include "app/press/calibration.h"
#include "app/program/progress_line.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace palp
{
namespace
{

void lookFrom(vtkRenderer& renderer, const CameraPlace& place)
{
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetPosition(place.position.data());
  camera.SetFocalPoint(place.focus.data());
  camera.SetViewUp(place.up.data());
  renderer.ResetCameraClippingRange();
}

using Seconds = std::chrono::duration<double>;
using Clock = std::chrono::steady_clock;

// how long a large figure will take, by a small one; 0: not long
Seconds expected(ImageSize size, const std::function<void(ImageSize, const char*)>& draw)
{
  constexpr int kSmaller = 4; // each side
  constexpr int kLong = 1000; // pixels
  if (std::min(size.width, size.height) < kLong)
  {
    return Seconds(0.0);
  }
  const auto begin = Clock::now();
  draw({ .width = size.width / kSmaller, .height = size.height / kSmaller }, "small.png");
  return kSmaller * kSmaller * Seconds(Clock::now() - begin);
}

// OpenGL does not tell how far it is
std::jthread tellTime(ProgressLine& progress, Seconds all)
{
  return std::jthread(
    [&progress, all, begin = Clock::now()](const std::stop_token& finished)
    {
      constexpr double kMost = 0.99; // before it is done
      constexpr auto kOften = std::chrono::milliseconds(100);
      while (all.count() > 0.0 && !finished.stop_requested())
      {
        progress(std::min(kMost, Seconds(Clock::now() - begin) / all));
        std::this_thread::sleep_for(kOften);
      }
    });
}

} // namespace

void drawFigure(const std::filesystem::path& folder)
{
  const std::filesystem::path file = folder / kFigureJob;
  const auto job = unpackFigureJob(readText(file, "a figure.job"));
  if (!job)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": of another build of palp; save the figure from the window again");
  }
  const ExportFolder made = readExport(folder);
  const ScenePlan& plan = made.plan;
  const SceneBody body = loadBodies(plan);
  Recording recording;
  recording.files = body.files;
  recording.organs = plan.organs;
  recording.scene.law = plan.press.tissue.law();
  setTissues(recording.scene, plan.organs);
  checkInputs(made, plan, recording);
  const Calibration calibration = loadCalibration(plan.press, recording.scene);

  const OffscreenContext context;
  const auto draw = [&](ImageSize size, const char* name)
  {
    const auto window = context.makeWindow(size.width, size.height);
    writeFigure(
      *window, momentOf(body, recording, calibration, job->sample, job->map ? &*job->map : nullptr),
      job->look, [&](PressView&, vtkRenderer& renderer) { lookFrom(renderer, job->camera); },
      folder / name);
  };
  ProgressLine progress("drawing");
  const std::jthread clock = tellTime(progress, expected(job->size, draw));
  draw(job->size, kFigureMade);
}

} // namespace palp
