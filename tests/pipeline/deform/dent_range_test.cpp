#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/pipeline/deform/presser.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace palp::test
{
namespace
{

struct NamedTip
{
  std::string name;
  Tip tip;
  bool isFitted = false; // to finite elements of this shape
};

std::vector<NamedTip> everyTip()
{
  std::vector<Profile::Point> egg;
  for (const double r : { 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0 })
  {
    egg.push_back({ r * 1.0_mm, (0.08 * r * r + 0.002 * r * r * r * r) * 1.0_mm });
  }
  const std::vector<Profile::Point> kinks{ { 0.0, 0.0 }, { 1.0_mm, 0.2_mm }, { 2.0_mm, 0.6_mm },
    { 3.0_mm, 2.0_mm }, { 4.0_mm, 6.0_mm } };
  return { { "sphere_10", SphereTip{ 10.0_mm }, true }, { "sphere_4", SphereTip{ 4.0_mm }, true },
    { "cone_45", ConeTip{ 45.0_deg, 10.0_mm }, true }, { "cone_60", ConeTip{ 60.0_deg, 6.0_mm } },
    { "punch", PunchTip{ 5.0_mm } }, { "truncated", TruncatedConeTip{ 45.0_deg, 3.0_mm, 8.0_mm } },
    { "blunt", BluntConeTip{ 45.0_deg, 2.0_mm, 10.0_mm }, true },
    { "paraboloid", ParaboloidTip{ 8.0_mm } },
    { "profile", ProfileTip{ std::make_shared<const Profile>(egg) } },
    { "kinks", ProfileTip{ std::make_shared<const Profile>(kinks) } } };
}

// A tool, a body, a law and a picture.
struct RangeCase
{
  NamedTip tip;
  std::string body;
  std::string law;
  std::string surface;
  double tilt = 0.0; // [rad]
};

std::string nameOf(const RangeCase& with)
{
  const std::string lean =
    with.tilt > 0.0 ? "_" + std::to_string(std::lround(with.tilt / 1.0_deg)) : "";
  return with.tip.name + "_" + with.body + "_" + with.law + "_" + with.surface + lean;
}

void PrintTo(const RangeCase& with, std::ostream* out)
{
  *out << nameOf(with);
}

void addCases(std::vector<RangeCase>& all, const std::vector<std::string>& bodies,
  const std::vector<std::string>& laws, const std::vector<double>& tilts)
{
  for (const NamedTip& tip : everyTip())
  {
    for (const std::string& body : bodies)
    {
      for (const std::string& law : laws)
      {
        for (const double tilt : tilts)
        {
          all.push_back({ tip, body, law, "paper", tilt });
          if (tip.isFitted)
          {
            all.push_back({ tip, body, law, "fitted", tilt });
          }
        }
      }
    }
  }
}

void expectSound(const Findings& findings)
{
  const auto record = [](const char* what, double value)
  { ::testing::Test::RecordProperty(what, std::to_string(value)); };
  record("inside_um", findings.inside.value / 1.0_um);
  record("rise_um", findings.rise.value / 1.0_um);
  record("jump_um", findings.jump.value / 1.0_um);
  record("wall", findings.wall.value);
  EXPECT_LE(findings.inside.value, 1.0_um) << findings.inside.where;
  EXPECT_LE(findings.rise.value, 2.0_um) << findings.rise.where;
  EXPECT_LE(findings.jump.value, 20.0_um) << findings.jump.where;
  EXPECT_LE(findings.wall.value, 1.3) << findings.wall.where;
}

// first, last, step:  of the depth [-] of the base radius
void pressDeeper(const RangeCase& with, double first, double last, double step)
{
  Presser presser(bodyOf(with.body), with.tip.tip, with.law, with.surface, with.tilt);
  Findings findings;
  for (double fraction = first; fraction < last + 0.5 * step; fraction += step)
  {
    presser.press(fraction * baseRadius(with.tip.tip), 0.0, findings);
  }
  expectSound(findings);
}

// By steps of 0.02 mm at three depths.
void slide(const RangeCase& with, int steps)
{
  Findings findings;
  for (const double fraction : { 0.4, 0.9, 1.5 })
  {
    Presser presser(bodyOf(with.body), with.tip.tip, with.law, with.surface, with.tilt);
    for (int i = 0; i <= steps; ++i)
    {
      presser.press(fraction * baseRadius(with.tip.tip), 0.02_mm * i, findings);
    }
  }
  expectSound(findings);
}

std::vector<RangeCase> rangeCases()
{
  std::vector<RangeCase> all;
#ifdef PALP_SLOW // every tool, body, law and picture
  addCases(all, { "block", "oblique", "rough", "ball", "ridge", "liver", "coarse" },
    { "paper", "exact", "corrected" }, { 0.0 });
  addCases(all, { "block", "ball" }, { "paper" }, { 5.0_deg, 10.0_deg, 20.0_deg, 35.0_deg });
#else
  addCases(all, { "block", "oblique", "rough", "ball", "ridge" }, { "paper" }, { 0.0 });
  addCases(all, { "block" }, { "paper" }, { 10.0_deg, 20.0_deg });
#endif
  return all;
}

#ifdef PALP_SLOW
constexpr double kStep = 0.01;
constexpr int kSlides = 200;
#else
constexpr double kStep = 0.05;
constexpr int kSlides = 6;
#endif

class DentRange : public ::testing::TestWithParam<RangeCase>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, DentRange, ::testing::ValuesIn(rangeCases()),
  [](const auto& with) { return nameOf(with.param); });

TEST_P(DentRange, PressingDeeper)
{
  pressDeeper(GetParam(), 0.02, 2.0, kStep);
}

// up to where a table begins
TEST_P(DentRange, FirstTouch)
{
  pressDeeper(GetParam(), 0.002, 0.06, 0.2 * kStep);
}

TEST_P(DentRange, Sliding)
{
  slide(GetParam(), kSlides);
}

// through the edge of a thin plate, where the contact's normal turns past the side of the tool
TEST(DentSlide, AToolThroughAnEdgeLeavesNoPointInIt)
{
  for (const double lean : { -0.1, -0.3 })
  {
    for (const double beside : { 44.0_mm, 46.0_mm, 48.0_mm })
    {
      PressedBody plate = pressedBody("plate", makeBox({ 100.0_mm, 100.0_mm, 8.0_mm }, 2.0_mm),
        { beside, 0.2_mm, 0.0 }, { lean, 0.02, 1.0 });
      for (const Tip& tip : { Tip(ConeTip{ 40.0_deg, 8.0_mm }), Tip(ConeTip{ 60.0_deg, 8.0_mm }),
             Tip(TruncatedConeTip{ 40.0_deg, 2.0_mm, 8.0_mm }), Tip(PunchTip{ 4.0_mm }) })
      {
        Presser presser(plate, tip, "paper", "paper");
        bool isThrough = false; // the apex came out: no contact is left
        for (int i = 1; i <= 80 && !isThrough; ++i)
        {
          Findings findings;
          presser.press(0.1_mm * i, 0.0, findings);
          isThrough = !presser.last()->contact.touching();
          EXPECT_TRUE(isThrough || findings.inside.value <= 1.0_um)
            << tip.index() << " " << beside << " " << findings.inside.value
            << findings.inside.where;
        }
      }
    }
  }
}

// as long as no flank stands along it the surface goes the way of the contact
TEST(DrawnNormal, LeavesTwelveDegreesToAFlank)
{
  const Eigen::Vector3d axis = Eigen::Vector3d(0.2, -0.5, -1.0).normalized();
  const Eigen::Vector3d across = axis.unitOrthogonal();
  for (const double flank : { 20.0_deg, 45.0_deg, 70.0_deg })
  {
    const Tip tip = ConeTip{ flank, 8.0_mm };
    for (double tilt = 0.0; tilt < 170.0_deg; tilt += 0.5_deg)
    {
      const Eigen::Vector3d normal = std::sin(tilt) * across - std::cos(tilt) * axis;
      const Eigen::Vector3d drawn = drawnNormal(normal, axis, tip);
      const double expected = std::min(tilt, flank - 12.0_deg);
      EXPECT_NEAR(
        (drawn - (std::sin(expected) * across - std::cos(expected) * axis)).norm(), 0.0, 1e-12);
    }
  }
}

// where a tool that leans by 35 degrees: goes through the plane beside the line from its nose to
// the nearest point, has its shaft between two directions, reaches its rim on the low side, or has
// the edge of a flat along a direction
TEST(LeaningTool, DrawsTheSurfaceByItsOwnSteps)
{
  struct Range
  {
    const char* tip;
    const char* body;
    const char* surface;
    double first, last, step;
  };
  const std::vector<NamedTip> tips = everyTip();
  for (const Range& range : { Range{ "kinks", "block", "paper", 1.68, 1.72, 0.01 },
         Range{ "kinks", "ball", "paper", 1.74, 1.78, 0.01 },
         Range{ "cone_45", "ball", "paper", 1.41, 1.425, 0.005 },
         Range{ "blunt", "block", "fitted", 0.37, 0.41, 0.01 },
         Range{ "punch", "block", "paper", 0.028, 0.034, 0.002 } })
  {
    SCOPED_TRACE(range.tip);
    const auto tip = std::ranges::find(tips, range.tip, &NamedTip::name);
    pressDeeper(
      { *tip, range.body, "paper", range.surface, 35.0_deg }, range.first, range.last, range.step);
  }
}

// how far a place outside the contact comes up again, over the whole range of depth [m]
double mostRaised(const Tip& tip, double tilt)
{
  PressedBody block = pressedBody(
    "fine", makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, 1.0_mm), { 0.3_mm, 0.2_mm, 0.0 }, { 0, 0, 1 });
  Presser presser(block, tip, "paper", "fitted", tilt);
  Findings findings;
  std::vector<double> deepest(block.surface.count());
  double raised = 0.0;
  for (double fraction = 0.02; fraction < 2.0; fraction += 0.05)
  {
    presser.press(fraction * baseRadius(tip), 0.0, findings);
    for (std::size_t i = 0; i < deepest.size(); ++i)
    {
      const double sink = DentedSurface::at(block.surface.displacement, i).norm();
      if (block.surface.zone[i] != static_cast<unsigned char>(Zone::Contact))
      {
        raised = std::max(raised, deepest[i] - sink);
        deepest[i] = std::max(deepest[i], sink);
      }
    }
  }
  return raised;
}

TEST(FittedDent, NoPlaceComesUpAsAToolThatLeansSinks)
{
  for (const Tip& tip : { Tip(SphereTip{ 10.0_mm }), Tip(ConeTip{ 45.0_deg, 10.0_mm }),
         Tip(ConeTip{ 45.0_deg, 6.0_mm }), Tip(BluntConeTip{ 45.0_deg, 2.0_mm, 10.0_mm }),
         Tip(BluntConeTip{ 45.0_deg, 4.0_mm, 10.0_mm }) })
  {
    for (const double tilt : { 20.0_deg, 30.0_deg })
    {
      EXPECT_LE(mostRaised(tip, tilt), 1.0_um) << tip.index() << " " << tilt / 1.0_deg;
    }
  }
}

// a point of a rough surface, above the fit of it, comes under the rim of the tool
TEST(DentSlide, APointThatStandsOutMovesOnUnderTheRim)
{
  Presser presser(bodyOf("rough"), BluntConeTip{ 45.0_deg, 2.0_mm, 10.0_mm }, "paper", "paper");
  Findings findings;
  for (int i = 0; i <= 30; ++i)
  {
    presser.press(15.0_mm, 1.2_mm + 0.005_mm * i, findings);
  }
  expectSound(findings);
}

// towards the edge of a block, where the way out turns from the face to its side
TEST(DentSlide, AConeCrossesAnEdgeByItsOwnSteps)
{
  PressedBody block = pressedBody(
    "edge", makeBox({ 60.0_mm, 60.0_mm, 30.0_mm }, 2.0_mm), { 0.3_mm, 0.2_mm, 0.0 }, { 0, 0, 1 });
  Findings findings;
  double most = 0.0; // [m] that a point moves in one step
  double turn = 0.0; // of the way down
  for (const double depth : { 2.0_mm, 4.0_mm })
  {
    Presser presser(block, ConeTip{ 40.0_deg, 8.0_mm }, "paper", "paper");
    std::vector<float> before;
    const double first = 30.1_mm - depth;
    const double last = first + 1.5_mm;
    for (int i = 0; first + 0.02_mm * i <= last; ++i)
    {
      presser.press(depth, first + 0.02_mm * i, findings);
      const std::vector<float>& now = block.surface.displacement;
      for (std::size_t k = 0; k < before.size(); k += 3)
      {
        const Eigen::Vector3f step(
          now[k] - before[k], now[k + 1] - before[k + 1], now[k + 2] - before[k + 2]);
        most = std::max<double>(most, step.norm());
      }
      before = now;
      turn = std::max(turn, (presser.last()->contact.normal - Eigen::Vector3d::UnitZ()).norm());
      EXPECT_TRUE(presser.last()->contact.touching()) << depth << " " << i;
    }
  }
  RecordProperty("most_mm", std::to_string(most / 1.0_mm));
  RecordProperty("turn", std::to_string(turn));
  EXPECT_LE(most, 1.0_mm);
  EXPECT_GE(turn, 0.3); // or no edge was crossed
  expectSound(findings);
}

} // namespace
} // namespace palp::test
