// palp-draw: palp with pictures, off screen. palp-draw --figure FOLDER: a figure that the window
// saves, see figure_job.h.

#include "app/commands/program.h"
#include "app/draw/draw_figure.h"
#include "app/draw/offscreen_renderer.h"

#include <iostream>
#include <string_view>

namespace
{

int drawFigure(const char* folder)
{
  try
  {
    palp::drawFigure(folder);
    return 0;
  }
  catch (const palp::Error& error)
  {
    std::cerr << "palp: " << error.what() << '\n';
    return palp::exitCode(error.code());
  }
  catch (const std::exception& error)
  {
    std::cerr << "palp: the figure cannot be drawn (" << error.what() << "); take a smaller one\n";
    return 1;
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc == 3 && std::string_view(argv[1]) == "--figure")
  {
    return drawFigure(argv[2]);
  }
  const palp::OffscreenRenderer pictures;
  return palp::runProgram(argc, argv, { .pictures = &pictures });
}
