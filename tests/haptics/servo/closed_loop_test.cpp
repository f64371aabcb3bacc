#include "haptics/surface/edges.h"
#include "haptics/units.h"
#include "tests/haptics/servo/work_over.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

using Random = std::mt19937;

double within(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

// an ellipsoid of 50, 35 and 25 mm by so many cells a side, each point moved at random
test::Mesh bumpyEllipsoid(int cells, double bumps)
{
  Random random(11);
  test::Mesh mesh = test::ball(1.0, cells);
  for (Vector3d& point : mesh.first)
  {
    point = point.cwiseProduct(Vector3d(50.0_mm, 35.0_mm, 25.0_mm)) +
      bumps *
        Vector3d(within(random, -1.0, 1.0), within(random, -1.0, 1.0), within(random, -1.0, 1.0));
  }
  return mesh;
}

// What a press, a slide and a lift at a random place give, over the most that was in them; 0 where
// the tool gets stuck in the body or does not come free.
double gainOfLoop(const Scene& scene, Random& random)
{
  const Surface& surface = *scene.surface;
  const auto triangle =
    std::uniform_int_distribution<std::size_t>(0, surface.triangles().size() - 1)(random);
  const Triangle& corners = surface.triangles()[triangle];
  const auto corner = [&](std::size_t k) -> const Vector3d&
  { return surface.points()[static_cast<std::size_t>(corners[k])]; };
  const Vector3d place = (corner(0) + corner(1) + corner(2)) / 3.0;
  const Vector3d normal = unitNormal(surface.points(), corners);
  const Vector3d way(
    within(random, -1.0, 1.0), within(random, -1.0, 1.0), within(random, -1.0, 1.0));
  const double depth = within(random, 1.0_mm, 5.0_mm);
  const Vector3d aside =
    within(random, 3.0_mm, 12.0_mm) * (way - way.dot(normal) * normal).normalized();
  const Vector3d ends[] = { place + 3.0_mm * normal, place - depth * normal,
    place - depth * normal + aside, place + aside + 25.0_mm * normal };
  double work = 0.0;
  double most = 0.0;
  double deepest = 0.0;
  const auto stepAt = [&](const Vector3d& apex) { return step(scene, { apex, -normal }); };
  for (int leg = 0; leg < 3; ++leg)
  {
    constexpr int kSteps = 800;
    const Vector3d move = (ends[leg + 1] - ends[leg]) / kSteps;
    for (int i = 0; i < kSteps; ++i)
    {
      const Sample sample = stepAt(ends[leg] + (i + 0.5) * move);
      work -= sample.force.dot(move);
      most = std::max(most, work);
      deepest = std::max(deepest, sample.contact.depth);
    }
  }
  const bool isFree = stepAt(ends[0]).force.isZero(0.0) && stepAt(ends[3]).force.isZero(0.0);
  return isFree && deepest < 12.0_mm && most > 0.0 ? std::abs(work) / most : 0.0;
}

// of so many loops on a bumpy ellipsoid, in order, without those that got stuck
std::vector<double> gainsOf(const Tip& tip, LawMode mode, int loops, int cells, double bumps)
{
  Scene scene;
  scene.surface = std::make_shared<const Surface>(test::makeSurface(bumpyEllipsoid(cells, bumps)));
  scene.law = ForceLaw(tip, makeMaterial(50.0_kPa, 0.45), { .mode = mode });
  scene.forceLimit = 1e6;
  Random random(7);
  std::vector<double> gains;
  for (int i = 0; i < loops; ++i)
  {
    gains.push_back(gainOfLoop(scene, random));
  }
  std::ranges::sort(gains);
  std::erase(gains, 0.0);
  EXPECT_GT(static_cast<double>(gains.size()), 0.6 * loops);
  return gains;
}

class ClosedLoop : public testing::TestWithParam<LawMode>
{
};

// on facets up to six times as wide as the contact, too
TEST_P(ClosedLoop, GivesNoEnergyOnACoarseBody)
{
  for (const auto& [cells, bumps, radius] : { std::tuple(5, 1.5_mm, 10.0_mm),
         { 9, 0.5_mm, 10.0_mm }, { 20, 0.1_mm, 10.0_mm }, { 5, 1.5_mm, 4.0_mm } })
  {
    const std::vector<double> gains = gainsOf(SphereTip{ radius }, GetParam(), 100, cells, bumps);
    EXPECT_LT(gains[gains.size() / 2], 2e-4) << cells;
    EXPECT_LT(gains.back(), 1e-3) << cells;
  }
}

class SharpTool : public ClosedLoop
{
};

// pushed out of the body the nearest way, they would gain up to seven times what was in them
TEST_P(SharpTool, GainsNoEnergy)
{
  // where a law asks for more than the depth, one depth stands for the integral over it
  const bool isExact = GetParam() == LawMode::Exact;
  for (const Tip& tip : { Tip{ ConeTip{ 30.0_deg, 10.0_mm } }, Tip{ ConeTip{ 60.0_deg, 10.0_mm } },
         Tip{ TruncatedConeTip{ 45.0_deg, 2.0_mm, 8.0_mm } }, Tip{ PunchTip{ 5.0_mm } } })
  {
    for (const auto& [cells, bumps] : { std::pair(9, 0.5_mm), { 20, 0.1_mm } })
    {
      const std::vector<double> gains = gainsOf(tip, GetParam(), 50, cells, bumps);
      EXPECT_LT(gains[gains.size() / 2], isExact ? 5e-5 : 1e-3) << tip.index() << ' ' << cells;
      EXPECT_LT(gains.back(), isExact ? 1e-3 : 2e-3) << tip.index() << ' ' << cells;
    }
  }
}

const auto bothLaws = testing::Values(LawMode::Exact, LawMode::Corrected);
const auto lawName = [](const auto& mode)
{ return mode.param == LawMode::Exact ? "exact" : "corrected"; };
INSTANTIATE_TEST_SUITE_P(Laws, ClosedLoop, bothLaws, lawName);
INSTANTIATE_TEST_SUITE_P(Laws, SharpTool, bothLaws, lawName);

} // namespace
} // namespace palp
