#include "app/draw/draw_charts.h"

#include "app/draw/offscreen.h"
#include "app/plots/chart_job.h"
#include "app/program/progress_line.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <vtkGenericOpenGLRenderWindow.h>

namespace palp
{

void drawCharts(const std::filesystem::path& folder)
{
  const std::filesystem::path file = folder / kChartJob;
  const auto job = unpackChartJob(readText(file, "a charts.job"));
  if (!job)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": of another build of palp; save the curves from the window again");
  }
  const ProgressLine progress("drawing");
  const ChartSheet& sheet = job->sheet;
  const OffscreenContext context;
  const auto window = context.makeWindow(sheet.size.width, sheet.size.height);
  window->SetMultiSamples(sheet.ending == ".png" ? 8 : 0);
  window->SetDPI(sheet.dpi);
  showPlots(*window, job->plots);
  window->Render();
  for (const auto& plot : job->plots)
  {
    plot->chart().SpaceTicks();
  }
  writePlots(job->plots, *window, folder / (kChartsMade + sheet.ending));
}

} // namespace palp
