// Force of a sphere of 10 mm, 5 mm deep: Hertz, 4/3 E/(1 - nu^2) sqrt(R) d^1.5.
#include "haptics/force/force_law.h"

#include <cmath>
#include <cstdio>

int main()
{
  const palp::ForceLaw law(palp::SphereTip{ .radius = 10e-3 }, palp::makeMaterial(50e3, 0.33));
  const double force = law({ .depth = 5e-3 }).force;
  std::printf("%.6f N\n", force);
  return std::abs(force - 2.645071) < 1e-5 ? 0 : 1;
}
