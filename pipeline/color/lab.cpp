#include "pipeline/color/lab.h"

#include <algorithm>
#include <cmath>

namespace palp::color
{
namespace
{

constexpr std::array<double, 3> kWhite{ 0.95047, 1.0, 1.08883 }; // D65, of Y = 1
constexpr double kCorner = 6.0 / 29.0;

// the curve of a channel
double toLinear(double channel) noexcept
{
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

double fromLinear(double light) noexcept
{
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

// the cube root, straight near black
double compress(double share) noexcept
{
  return share > kCorner * kCorner * kCorner ? std::cbrt(share)
                                             : share / (3.0 * kCorner * kCorner) + 4.0 / 29.0;
}

double expand(double root) noexcept
{
  return root > kCorner ? root * root * root : 3.0 * kCorner * kCorner * (root - 4.0 / 29.0);
}

} // namespace

Lab labOf(const Rgb& rgb) noexcept
{
  const double r = toLinear(rgb[0]);
  const double g = toLinear(rgb[1]);
  const double b = toLinear(rgb[2]);
  const double x = compress((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / kWhite[0]);
  const double y = compress((0.2126729 * r + 0.7151522 * g + 0.0721750 * b) / kWhite[1]);
  const double z = compress((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / kWhite[2]);
  return { .lightness = 116.0 * y - 16.0, .a = 500.0 * (x - y), .b = 200.0 * (y - z) };
}

Rgb rgbOf(const Lab& lab) noexcept
{
  const double root = (lab.lightness + 16.0) / 116.0;
  const double x = kWhite[0] * expand(root + lab.a / 500.0);
  const double y = kWhite[1] * expand(root);
  const double z = kWhite[2] * expand(root - lab.b / 200.0);
  const auto channel = [](double light) { return std::clamp(fromLinear(light), 0.0, 1.0); };
  return { channel(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
    channel(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
    channel(0.0556434 * x - 0.2040259 * y + 1.0572252 * z) };
}

} // namespace palp::color
