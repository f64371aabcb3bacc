// palp-draw: palp with pictures, off screen. palp-draw --figure FOLDER or --charts FOLDER: what the
// window saves, see figure_job.h and chart_job.h.

#include "app/commands/program.h"
#include "app/draw/draw_charts.h"
#include "app/draw/draw_figure.h"
#include "app/draw/offscreen_renderer.h"

#include <iostream>
#include <string_view>

namespace
{

int drawSaved(std::string_view what, const char* folder)
{
  try
  {
    what == "--figure" ? palp::drawFigure(folder) : palp::drawCharts(folder);
    return 0;
  }
  catch (const palp::Error& error)
  {
    std::cerr << "palp: " << error.what() << '\n';
    return palp::exitCode(error.code());
  }
  catch (const std::exception& error)
  {
    std::cerr << "palp: it cannot be drawn (" << error.what() << "); take a smaller size\n";
    return 1;
  }
}

} // namespace

int main(int argc, char** argv)
{
  const std::string_view what = argc == 3 ? argv[1] : "";
  if (what == "--figure" || what == "--charts")
  {
    return drawSaved(what, argv[2]);
  }
  const palp::OffscreenRenderer pictures;
  return palp::runProgram(argc, argv, { .pictures = &pictures });
}
