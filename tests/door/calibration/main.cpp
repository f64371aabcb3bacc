// R_d at a depth between two rows of the table that the argument names.
#include "calibration/tables/extent_table.h"

#include <cstdio>

int main(int, char** arguments)
{
  const palp::ExtentTable table = palp::ExtentTable::read(arguments[1]);
  const double radius = table.extentRadius(5.25e-3) * 1e3;
  std::printf("R_d = %.3f mm\n", radius);
  return radius > 18.3835 && radius < 19.9339 ? 0 : 1; // its rows at 5 and 5.5 mm
}
