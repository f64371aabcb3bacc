// palp-draw: palp with pictures, off screen.

#include "app/draw/draw_pictures.h"
#include "app/commands/program.h"

int main(int argc, char** argv)
{
  const palp::DrawPictures pictures;
  return palp::runProgram(argc, argv, { .pictures = &pictures });
}
