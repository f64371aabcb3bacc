// palp-draw: palp with pictures, off screen.

#include "app/commands/program.h"
#include "app/draw/offscreen_renderer.h"

int main(int argc, char** argv)
{
  const palp::OffscreenRenderer pictures;
  return palp::runProgram(argc, argv, { .pictures = &pictures });
}
