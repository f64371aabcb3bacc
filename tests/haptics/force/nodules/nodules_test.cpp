#include "haptics/force/nodules/nodules.h"

#include "haptics/error.h"
#include "haptics/numerics/quadrature.h"
#include "tests/haptics/force/nodules/nodule_cases.h"
#include "tests/haptics/force/tips.h"
#include "tests/support/allocation_guard.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr Nodule kShallow{ 4.0_mm, 4.0_mm, 8.0 };
constexpr Nodule kSoft{ 6.0_mm, 12.0_mm, 0.2 };

test::NoduleCase layerUnder(const Tip& tip, double thickness = 40.0_mm)
{
  return { .tip = tip, .poisson = 0.45, .thickness = thickness, .deepest = 10.0_mm };
}

// tool over a stiff nodule at x = 0 and a soft one at x = 15 mm, both in the plane of the tool
struct TwoNodules
{
  explicit TwoNodules(const Tip& tip)
    : which(layerUnder(tip))
    , law(which.law())
    , nodules(which.press(), std::array{ kShallow, kSoft })
  {
  }

  [[nodiscard]] Nodules::Answer at(double x, double depth) const
  {
    return nodules(depth, std::array{ x * x, (x - 15.0_mm) * (x - 15.0_mm) });
  }

  [[nodiscard]] double normal(double x, double depth) const
  {
    ContactGeometry place = which.place();
    place.depth = depth;
    return law(place).force + at(x, depth).response.force;
  }

  [[nodiscard]] double lateral(double x, double depth) const
  {
    const Nodules::Answer answer = at(x, depth);
    return answer.repulsion[0] * x + answer.repulsion[1] * (x - 15.0_mm);
  }

  test::NoduleCase which;
  ForceLaw law;
  Nodules nodules;
};

// Int w dV of the strain energy between the field and its rate, which is 1 by virtual work
double integralOfWeight(const HomogeneousPress& press, double deepest)
{
  const std::size_t last = press.knots().size() - 1;
  const double a = press.knots()[last].radius;
  const double nu = press.poissonRatio();
  std::vector<PressStrain> strains(last + 1);
  // r = a (1 + x^3) and z = a y^3 gather points at the edge of the contact, where strain is
  // infinite
  const double farR = std::isfinite(press.thickness()) ? 3.0 * press.thickness() : 300.0 * a;
  const Quadrature inner = gaussLegendre(60, -1.0, 0.0);
  const Quadrature outer = gaussLegendre(100, 0.0, std::cbrt(farR / a - 1.0));
  const Quadrature down = gaussLegendre(100, 0.0, std::cbrt(deepest / a));
  double sum = 0.0;
  const auto add = [&](const Quadrature& across)
  {
    for (std::size_t i = 0; i < across.nodes.size(); ++i)
    {
      for (std::size_t j = 0; j < down.nodes.size(); ++j)
      {
        const double x = across.nodes[i];
        const double y = down.nodes[j];
        const double r = a * (1.0 + x * x * x);
        press.strainAt(r, a * y * y * y, strains);
        const auto& [total, rate] = strains[last];
        sum += across.weights[i] * 3.0 * a * x * x * down.weights[j] * 3.0 * a * y * y * 2.0 *
          std::numbers::pi * r *
          (total.trace() * rate.trace() / (3.0 * (1.0 - 2.0 * nu)) +
            deviatoricProduct(total, rate) / (1.0 + nu));
      }
    }
  };
  add(inner);
  add(outer);
  return press.knots()[last].stiffness * sum;
}

class AnyTipOverNodules : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(Nodules, AnyTipOverNodules, ::testing::ValuesIn(test::allTips()));

TEST_P(AnyTipOverNodules, StrainEnergyAddsUpToTheWorkOfTheTool)
{
  for (const auto base : { Base::Bonded, Base::Slip })
  {
    test::NoduleCase which = layerUnder(GetParam());
    which.deepest = 3.0_mm;
    LawSettings settings = which.law().settings();
    settings.base = base;
    const HomogeneousPress layer(
      ForceLaw(which.tip, which.law().material(), settings), which.place(), which.deepest);
    EXPECT_NEAR(integralOfWeight(layer, 40.0_mm), 1.0, 0.01);
  }
  const HomogeneousPress halfSpace(layerUnder(GetParam()).law(), {}, 3.0_mm);
  const double a = halfSpace.knots().back().radius;
  EXPECT_NEAR(integralOfWeight(halfSpace, 300.0 * a), 1.0, 0.01);
}

TEST_P(AnyTipOverNodules, ForcesAreTheSlopesOfTheEnergy)
{
  const TwoNodules body(GetParam());
  constexpr double h = 1e-7;
  for (const double x : { -12.0_mm, -1.0_mm, 0.0_mm, 3.0_mm, 7.5_mm, 14.0_mm, 30.0_mm })
  {
    for (const double depth : { 0.05_mm, 0.7_mm, 2.0_mm, 5.0_mm, 8.05_mm, 9.0_mm, 12.0_mm })
    {
      const auto energy = [&](double dx, double dz)
      { return body.at(x + dx, depth + dz).response.energy; };
      const Nodules::Answer answer = body.at(x, depth);
      EXPECT_NEAR(answer.response.force, (energy(0.0, h) - energy(0.0, -h)) / (2.0 * h), 2e-6);
      EXPECT_NEAR(body.lateral(x, depth), -(energy(h, 0.0) - energy(-h, 0.0)) / (2.0 * h), 2e-6);
      EXPECT_NEAR(answer.response.stiffness,
        (body.at(x, depth + h).response.force - body.at(x, depth - h).response.force) / (2.0 * h),
        1e-2);
    }
  }
}

// down beside the nodules, across them at depth, up, back in the air
TEST_P(AnyTipOverNodules, NoLoopOfPressDragAndLiftGivesEnergy)
{
  const TwoNodules body(GetParam());
  constexpr int kSteps = 4000;
  const auto alongDepth = [&](double x, double deep)
  {
    double work = 0.0;
    for (int i = 0; i < kSteps; ++i)
    {
      work += body.normal(x, (i + 0.5) * deep / kSteps) * deep / kSteps;
    }
    return work;
  };
  const auto alongSurface = [&](double from, double to, double deep)
  {
    double work = 0.0;
    for (int i = 0; i < kSteps; ++i)
    {
      work -= body.lateral(from + (i + 0.5) * (to - from) / kSteps, deep) * (to - from) / kSteps;
    }
    return work;
  };
  for (const double deep : { 2.0_mm, 5.0_mm })
  {
    for (const double to : { 0.0_mm, 13.0_mm })
    {
      const double pressed = alongDepth(-20.0_mm, deep);
      const double loop = pressed + alongSurface(-20.0_mm, to, deep) - alongDepth(to, deep);
      EXPECT_LT(std::abs(loop), 1e-4 * pressed);
    }
  }
}

TEST_P(AnyTipOverNodules, AMicrometerNeverChangesTheForceByMoreThanItsStiffness)
{
  const TwoNodules body(GetParam());
  for (double x = -10.0_mm; x < 20.0_mm; x += 0.37_mm)
  {
    for (double depth = 0.01_mm; depth < 13.0_mm; depth *= 1.3)
    {
      ContactGeometry place = body.which.place();
      place.depth = depth;
      const double stiffness = body.law(place).stiffness + body.at(x, depth).response.stiffness;
      const double bound = 1.05 * stiffness * 1.0_um + 1e-6;
      const double force = body.normal(x, depth);
      EXPECT_LT(std::abs(body.normal(x, depth + 1.0_um) - force), bound) << x << ' ' << depth;
      EXPECT_LT(std::abs(body.normal(x + 1.0_um, depth) - force), bound) << x << ' ' << depth;
    }
  }
}

TEST(Nodules, AStiffOnePushesTheToolAsideAndASoftOneDrawsIt)
{
  const test::NoduleCase which = layerUnder(SphereTip{ 10.0_mm });
  const HomogeneousPress press = which.press();
  const Nodules stiff(press, std::array{ kShallow });
  const Nodules soft(press, std::array{ kSoft });
  for (const double lateral : { 1.0_mm, 5.0_mm, 10.0_mm })
  {
    EXPECT_GT(stiff(4.0_mm, std::array{ lateral * lateral }).repulsion[0], 0.0);
    EXPECT_LT(soft(4.0_mm, std::array{ lateral * lateral }).repulsion[0], 0.0);
  }
}

TEST(Nodules, OneOfTheTissuesOwnStiffnessAndOneFarAwayAddNothing)
{
  const test::NoduleCase which = layerUnder(SphereTip{ 10.0_mm });
  const HomogeneousPress press = which.press();
  const Nodules same(press, std::array{ Nodule{ 4.0_mm, 4.0_mm, 1.0 } });
  const double force = press.knots().back().force;
  EXPECT_NEAR(same(5.0_mm, std::array{ 0.0 }).response.force, 0.0, 1e-12);
  const Nodules stiff(press, std::array{ kShallow });
  EXPECT_NEAR(stiff(5.0_mm, std::array{ 0.01 }).response.force, 0.0, 1e-4 * force);
  EXPECT_EQ(stiff(0.0, std::array{ 0.0 }).response.force, 0.0);
  EXPECT_EQ(stiff(-1.0, std::array{ 0.0 }).response.force, 0.0);
  EXPECT_EQ(stiff(kEndless, std::array{ 0.0 }).response.force, 0.0);
}

// large strain of the law scales what the nodule adds
TEST(Nodules, AddTheirShareToTheForceOfTheLaw)
{
  const test::NoduleCase which = layerUnder(SphereTip{ 10.0_mm });
  LawSettings settings = which.law().settings();
  const ForceLaw twice(which.tip, { 100.0_kPa, 0.45 }, settings);
  const HomogeneousPress other(twice, which.place(), which.deepest);
  const auto at = [](const HomogeneousPress& press)
  { return Nodules(press, std::array{ kShallow })(5.0_mm, std::array{ 0.0 }).response.force; };
  EXPECT_NEAR(at(other), 2.0 * at(which.press()), 1e-9);
}

TEST(Nodules, AreEvaluatedWithoutAllocation)
{
  const TwoNodules body(SphereTip{ 10.0_mm });
  const test::AllocationGuard guard;
  const double force = body.at(1.0_mm, 3.0_mm).response.force;
  EXPECT_EQ(guard.count(), 0);
  EXPECT_GT(force, 0.0);
}

void expectRefused(const std::function<void()>& make, const std::string& words)
{
  try
  {
    make();
    FAIL() << "not refused: " << words;
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Nodules, WhatCannotBeIsRefused)
{
  for (const double bad : { 0.0, -1.0, 0.1, 51.0, kEndless, std::nan("") })
  {
    expectRefused([&] { (void)checkedNodule({ 4.0_mm, 4.0_mm, bad }); }, "ratio");
  }
  expectRefused([] { (void)checkedNodule({ 0.0, 4.0_mm, 5.0 }); }, "radius");
  expectRefused([] { (void)checkedNodule({ 4.0_mm, -1.0_mm, 5.0 }); }, "below the surface");
  const test::NoduleCase which = layerUnder(SphereTip{ 10.0_mm }, 10.0_mm);
  const HomogeneousPress press = which.press();
  expectRefused([&] { Nodules(press, std::array{ kShallow, kSoft }); }, "base of the body");
  expectRefused(
    [&] { Nodules(press, std::vector<Nodule>(Nodules::kMost + 1, kShallow)); }, "at most 32");
  expectRefused([&] { HomogeneousPress(ForceLaw(which.tip, which.law().material()), {}, 1.0_mm); },
    "corrected law");
  const std::array places{ Eigen::Vector3d(0.0, 0.0, 8.0_mm), Eigen::Vector3d(0.0, 0.0, 15.0_mm) };
  expectRefused(
    [&] {
      checkApart(std::array{ kShallow, kShallow }, places);
    },
    "nodules 1 and 2 overlap");
}

} // namespace
} // namespace palp
