#include "calibration/study/surface_fit.h"

#include "haptics/error.h"
#include "tests/calibration/indentation_case.h"

namespace palp::fem
{
namespace
{

using namespace units::literals;

class AnyTool : public testing::TestWithParam<bool>
{
protected:
  static Case study()
  {
    Case result = paperCase();
    if (GetParam())
    {
      result.tip = cappedCone();
      result.elementSize = 0.5_mm;
    }
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(SurfaceFit, AnyTool, testing::Values(false, true));

TEST_P(AnyTool, FittedCurveIsWithinThreePercentOfTheDepthAndThePapersIsNot)
{
  const Case what = study();
  double worstPaper = 0.0;
  for (const IndentationStep& step : completed(what).steps)
  {
    const SurfaceProfile curve = fitSurface(step, what.tip);
    const auto fitted =
      surfaceError(step, curve.outer, [&](double radius) { return curve.sinkAt(radius); });
    EXPECT_LE(fitted.rms, 0.03 * step.depth) << step.depth;

    const double extent = extentRadius(step.profile, what.threshold);
    const auto paper = surfaceError(step, curve.outer,
      [&](double radius)
      { return paperSink(what.tip, step.depth, step.contactRadius, extent, radius); });
    EXPECT_GT(paper.rms, 2.0 * fitted.rms) << step.depth;
    worstPaper = std::max(worstPaper, paper.rms / step.depth);
  }
  EXPECT_GT(worstPaper, 0.03);
}

constexpr SurfaceProfile kCurve{ .inner = 5.0_mm,
  .outer = 40.0_mm,
  .sink = 4.0_mm,
  .slope = 0.6,
  .control = { 1.0_mm, 2.0_mm } };

// C1 at both ends: no step and no corner towards the tool and towards the rest surface
TEST(SurfaceProfile, JoinsToolAndRestSurfaceSmoothly)
{
  const double h = 1e-8;
  EXPECT_NEAR(kCurve.sinkAt(kCurve.inner + h), kCurve.sink, 1e-7);
  EXPECT_NEAR((kCurve.sinkAt(kCurve.inner + h) - kCurve.sink) / h, -kCurve.slope, 1e-5);
  EXPECT_NEAR(kCurve.sinkAt(kCurve.outer - h), 0.0, 1e-12);
  EXPECT_NEAR(kCurve.sinkAt(kCurve.outer - h) / h, 0.0, 1e-5);
  EXPECT_EQ(kCurve.sinkAt(kCurve.outer), 0.0);
  EXPECT_EQ(kCurve.sinkAt(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

// a surface that is such a curve is found again
TEST(SurfaceFit, RecoversItsOwnCurve)
{
  IndentationStep pressed{ .depth = 5.0_mm, .contactRadius = 5.0_mm };
  const Tip tip = SphereTip{ 10.0_mm };
  SurfaceProfile exact = kCurve;
  exact.sink = pressed.depth - tipHeight(tip, exact.inner);
  exact.slope = tipSlope(tip, exact.inner);
  for (double radius = 0.0; radius < 40.0001_mm; radius += 0.5_mm)
  {
    const double sink =
      radius < exact.inner ? pressed.depth - tipHeight(tip, radius) : exact.sinkAt(radius);
    pressed.profile.push_back({ radius, 0.0, -sink });
  }
  const SurfaceProfile found = fitSurface(pressed, tip);
  EXPECT_NEAR(found.control[0], exact.control[0], 1e-9);
  EXPECT_NEAR(found.control[1], exact.control[1], 1e-9);
}

TEST(SurfaceFit, RefusesASurfaceWithTooFewPoints)
{
  const IndentationStep pressed{ .depth = 1.0_mm, .contactRadius = 3.0_mm, .profile = { {}, {} } };
  EXPECT_THROW((void)fitSurface(pressed, SphereTip{ 10.0_mm }), Error);
}

} // namespace
} // namespace palp::fem
