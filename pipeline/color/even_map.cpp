#include "pipeline/color/even_map.h"

#include <cmath>

namespace palp::color
{

Rgb evenMap(const Rgb& zero, double share) noexcept
{
  // about the brightest yellow that a screen has
  constexpr Lab kEnd{ .lightness = 92.0, .a = -14.0, .b = 78.0 };
  const Lab begin = labOf(zero);
  return share <= 0.0 ? zero
                      : rgbOf({ .lightness = std::lerp(begin.lightness, kEnd.lightness, share),
                          .a = std::lerp(begin.a, kEnd.a, share),
                          .b = std::lerp(begin.b, kEnd.b, share) });
}

} // namespace palp::color
