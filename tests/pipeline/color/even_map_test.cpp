#include "pipeline/color/even_map.h"

#include "pipeline/view/appearance.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vtkLookupTable.h>

namespace palp::color
{
namespace
{

// sRGB to CIELAB by the ratios of the standards: chromaticities of the primaries, not the matrix
Lab labByPrimaries(const Rgb& rgb)
{
  std::array<double, 3> light{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    light[i] = rgb[i] > 0.04045 ? std::pow((rgb[i] + 0.055) / 1.055, 2.4) : rgb[i] / 12.92;
  }
  // ITU-R BT.709 primaries x, y; their luminances for a D65 white
  constexpr std::array<std::array<double, 3>, 3> kPrimaries{ { { 0.64, 0.33, 0.2126729 },
    { 0.30, 0.60, 0.7151522 }, { 0.15, 0.06, 0.0721750 } } };
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto& [px, py, luminance] = kPrimaries[i];
    const double of = luminance * light[i];
    x += of * px / py;
    y += of;
    z += of * (1.0 - px - py) / py;
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double fy = f(y);
  return { 116.0 * fy - 16.0, 500.0 * (f(x / 0.95047) - fy), 200.0 * (fy - f(z / 1.08883)) };
}

double distance(const Lab& a, const Lab& b)
{
  return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b);
}

// published: Lindbloom's calculator for sRGB, D65
TEST(Lab, IsThatOfTheStandards)
{
  const std::array<std::pair<Rgb, Lab>, 5> known{ { { { 1.0, 1.0, 1.0 }, { 100.0, 0.0, 0.0 } },
    { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } }, { { 1.0, 0.0, 0.0 }, { 53.24, 80.09, 67.20 } },
    { { 0.0, 1.0, 0.0 }, { 87.73, -86.18, 83.18 } },
    { { 0.0, 0.0, 1.0 }, { 32.30, 79.19, -107.86 } } } };
  for (const auto& [rgb, lab] : known)
  {
    EXPECT_LT(distance(labOf(rgb), lab), 0.05) << rgb[0] << rgb[1] << rgb[2];
    EXPECT_LT(distance(labByPrimaries(rgb), lab), 0.1);
  }
  for (const Rgb& rgb : { Rgb{ 0.55, 0.20, 0.16 }, Rgb{ 0.01, 0.02, 0.03 }, Rgb{ 0.9, 0.8, 0.2 } })
  {
    const Rgb back = rgbOf(labOf(rgb));
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(back[i], rgb[i], 1e-5);
    }
  }
}

// what is drawn: the table, whose colors are bytes
TEST(EvenMap, HasEvenStepsToTheEyeFromTheTissueOn)
{
  const auto table = appearance::evenMapOn(appearance::kLiver);
  const auto labAt = [&](int i)
  {
    double rgba[4];
    table->GetTableValue(i, rgba);
    return labByPrimaries({ rgba[0], rgba[1], rgba[2] });
  };
  EXPECT_LT(distance(labAt(0), labByPrimaries(appearance::kLiver)), 0.5);
  const int last = static_cast<int>(table->GetNumberOfTableValues()) - 1;
  constexpr int kSteps = 15;
  const int step = last / kSteps;
  const double all = labAt(step * kSteps).lightness - labAt(0).lightness;
  EXPECT_GT(all, 50.0); // of 100: seen in gray, too
  const double far = distance(labAt(step * kSteps), labAt(0));
  for (int i = 0; i < kSteps; ++i)
  {
    const Lab from = labAt(i * step);
    const Lab to = labAt((i + 1) * step);
    EXPECT_NEAR(to.lightness - from.lightness, all / kSteps, 0.1 * all / kSteps) << i;
    EXPECT_NEAR(distance(from, to), far / kSteps, 0.15 * far / kSteps) << i;
  }
}

} // namespace
} // namespace palp::color
