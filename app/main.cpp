// palp: the commands alone; pictures and the window are its siblings'.

#include "app/commands/program.h"

int main(int argc, char** argv)
{
  return palp::runProgram(argc, argv, {});
}
