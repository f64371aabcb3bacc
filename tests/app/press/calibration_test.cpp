#include "app/press/calibration.h"

#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/force/tips.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

Calibration load(const Tip& tip, const PressOptions& options = {}, double poisson = 0.33)
{
  return loadCalibration(options, ForceLaw(tip, Material{ 50.0_kPa, poisson }));
}

TEST(LoadCalibration, ThePapersToolsUseItsTwentyRows)
{
  const Calibration sphere = load(SphereTip{ 10.0_mm });
  EXPECT_EQ(sphere.extents.rows().size(), 20U);
  EXPECT_EQ(sphere.note, "");
  EXPECT_EQ(load(ConeTip{ 45.0_deg, 10.0_mm }).extents.rows().size(), 20U);
}

// one shape at every size: all lengths and the threshold doubled double R_d
TEST(LoadCalibration, ASphereOfAnotherSizeIsTheSameShape)
{
  PressOptions small;
  small.dent.threshold = 0.35_mm;
  PressOptions large;
  large.dent.threshold = 0.7_mm;
  const auto a = load(SphereTip{ 7.0_mm }, small).extents;
  const auto b = load(SphereTip{ 14.0_mm }, large).extents;
  for (const double depth : { 1.0_mm, 3.0_mm, 6.5_mm })
  {
    EXPECT_NEAR(b.extentRadius(2.0 * depth), 2.0 * a.extentRadius(depth), 0.1_mm);
  }
}

// a lobe that bends by 4.7 mm of 6 is dented by the rest
TEST(LoadCalibration, TheExtentIsOfTheDentWithoutWhatABodyGivesWay)
{
  const Calibration calibration = load(SphereTip{ 10.0_mm });
  Sample sample;
  sample.contact.depth = 6.0_mm;
  sample.localDepth = 1.3_mm;
  EXPECT_NEAR(calibration.extentRadius(sample), calibration.extents.extentRadius(1.3_mm), 1.0_um);
  sample.localDepth = 6.0_mm;
  EXPECT_NEAR(calibration.extentRadius(sample), calibration.extents.extentRadius(6.0_mm), 1.0_um);
}

// a bonded base holds the surface, and a smaller threshold reaches further
TEST(LoadCalibration, LayerAndThresholdActAsTheyMust)
{
  PressOptions thin;
  thin.dent.layer = 20.0_mm;
  PressOptions fine;
  fine.dent.threshold = 0.2_mm;
  const double depth = 5.0_mm;
  const double usual = load(SphereTip{ 8.0_mm }).extents.extentRadius(depth);
  EXPECT_LT(load(SphereTip{ 8.0_mm }, thin).extents.extentRadius(depth), 0.9 * usual);
  EXPECT_GT(load(SphereTip{ 8.0_mm }, fine).extents.extentRadius(depth), 1.1 * usual);
}

TEST(LoadCalibration, SaysThatATableIsOfAnotherTool)
{
  const auto ofTable = [](const char* name, const Tip& tip)
  {
    PressOptions options;
    options.dent.table = dataFile(std::string("tables/") + name + ".csv");
    return load(tip, options);
  };
  EXPECT_EQ(ofTable("sphere_r6_h30", SphereTip{ 6.0_mm }).note, "");
  EXPECT_EQ(ofTable("cone45_r6_h30", ConeTip{ 45.0_deg, 6.0_mm }).note, "");
  EXPECT_EQ(ofTable("cone45_r6_h30", BluntConeTip{ 45.0_deg, 0.3_mm, 6.0_mm }).note, "");
  for (const auto& [name, tip] :
    { std::pair<const char*, Tip>("sphere_r6_h30", SphereTip{ 9.0_mm }),
      { "cone45_r6_h30", SphereTip{ 6.0_mm } }, { "cone45_r6_h30", ConeTip{ 40.0_deg, 6.0_mm } },
      { "cone45_r6_h30", ConeTip{ 45.0_deg, 9.0_mm } }, { "sphere_r6_h30", PunchTip{ 6.0_mm } } })
  {
    const Calibration calibration = ofTable(name, tip);
    EXPECT_NE(calibration.note.find("of another tool"), std::string::npos) << name;
    EXPECT_FALSE(calibration.covers(1.0_mm));
    EXPECT_FALSE(calibration.young);
  }
}

// of a tool that another's R_d stands in for; the contact by the laws of Hertz and Sneddon
TEST(LoadCalibration, NoStandInEndsWithinTheContact)
{
  std::vector<Tip> tips = test::allTips();
  for (const double angle : { 5.0_deg, 80.0_deg })
  {
    tips.emplace_back(ConeTip{ angle, 12.0_mm });
  }
  tips.emplace_back(PunchTip{ 1.0_mm });
  for (const Tip& tip : tips)
  {
    PressOptions other;
    other.dent.table = dataFile("tables/cone45_r6_h30.csv");
    for (const PressOptions& options : { PressOptions{}, other })
    {
      for (const LawMode mode : { LawMode::Paper, LawMode::Corrected })
      {
        const ForceLaw law(tip, Material{ 50.0_kPa, 0.45 }, { .mode = mode });
        const Calibration calibration = loadCalibration(options, law);
        if (calibration.reach > 0.0)
        {
          continue; // its own: 0 where nothing sinks by the threshold
        }
        const double radius = baseRadius(tip);
        for (double depth = 0.02 * radius; depth < 2.0 * radius; depth += 0.013 * radius)
        {
          const double extent = calibration.extents.extentRadius(depth);
          EXPECT_GE(extent, law({ .depth = depth }).contactRadius) << tip.index() << ' ' << depth;
          EXPECT_GE(extent, flatRadius(tip)) << tip.index() << ' ' << depth;
        }
      }
    }
  }
}

TEST(LoadCalibration, SaysWhatStandsInForWhat)
{
  EXPECT_EQ(load(SphereTip{ 8.0_mm }).note, "");
  PressOptions thick;
  thick.dent.layer = 1.0;
  EXPECT_NE(load(SphereTip{ 8.0_mm }, thick).note.find("clamped"), std::string::npos);
  EXPECT_FALSE(load(SphereTip{ 8.0_mm }, thick).covers(1.0_mm));
  EXPECT_NE(load(SphereTip{ 8.0_mm }, {}, 0.5).note.find("clamped"), std::string::npos);
  EXPECT_NE(load(PunchTip{ 8.0_mm }).note.find("sphere"), std::string::npos);
  EXPECT_NE(load(ConeTip{ 30.0_deg, 10.0_mm }).note.find("cone"), std::string::npos);
  const Calibration sphere = load(SphereTip{ 8.0_mm });
  EXPECT_TRUE(sphere.covers(8.0_mm));
  EXPECT_FALSE(sphere.covers(8.1_mm));
  EXPECT_FALSE(load(PunchTip{ 8.0_mm }).covers(1.0_mm));
}

// the tip of the tables' cones has a radius of 0.3 mm
TEST(LoadCalibration, SaysThatABluntConeHasATableOfAnother)
{
  EXPECT_EQ(load(BluntConeTip{ 45.0_deg, 0.3_mm, 10.0_mm }).note, "");
  const Calibration blunt = load(BluntConeTip{ 45.0_deg, 2.0_mm, 10.0_mm });
  EXPECT_NE(blunt.note.find("nearest cone"), std::string::npos);
  EXPECT_FALSE(blunt.covers(1.0_mm));
}

TEST(LoadCalibration, SaysWhereAFittedSurfaceIsOfAnotherBody)
{
  PressOptions options;
  options.dent.surface = DentSurface::Fitted;
  const Calibration same = load(SphereTip{ 10.0_mm }, options);
  EXPECT_EQ(same.note, "");
  EXPECT_TRUE(same.covers(10.0_mm));
  EXPECT_FALSE(same.covers(10.1_mm));
  const Calibration softer = load(SphereTip{ 8.0_mm }, options, 0.45);
  EXPECT_NE(softer.note.find("3 %"), std::string::npos);
  EXPECT_FALSE(softer.covers(1.0_mm));
  options.dent.layer = 20.0_mm;
  EXPECT_NE(load(SphereTip{ 8.0_mm }, options).note.find("3 %"), std::string::npos);
}

// each by itself: a body of the size of a liver, a lean of a degree, half of the thickness, an edge
TEST(LoadCalibration, SaysWhereAFittedSurfaceIsOnAnotherPlace)
{
  PressOptions options;
  options.dent.surface = DentSurface::Fitted;
  const Calibration fitted = load(SphereTip{ 10.0_mm }, options);
  const Contact block{ .depth = 5.0_mm, .thickness = 50.0_mm, .edgeDistance = 50.0_mm };
  EXPECT_TRUE(fitted.fits(block));
  const auto changed = [&](auto Contact::*part, double value)
  {
    Contact other = block;
    other.*part = value;
    return other;
  };
  EXPECT_FALSE(fitted.fits(changed(&Contact::surfaceCurvature, 1.0 / 80.0_mm)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::surfaceCurvature, -1.0 / 80.0_mm)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::curvatureSpread, 1.0 / 80.0_mm)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::tilt, 1.0_deg)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::thickness, 25.0_mm)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::thickness, 1.0)));
  EXPECT_FALSE(fitted.fits(changed(&Contact::edgeDistance, 20.0_mm)));
  EXPECT_TRUE(load(SphereTip{ 10.0_mm }).fits(changed(&Contact::tilt, 1.0_deg))) << "not fitted";
  EXPECT_TRUE(fitted.fits(Contact{})) << "apart";
}

TEST(LoadCalibration, KnowsNothingOfCoatedTissueButByItsOwnTable)
{
  LawSettings settings{ .mode = LawMode::Corrected };
  settings.coatings.add({ 2.0_mm, { 200.0_kPa, 0.4 } });
  const ForceLaw law(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.33 }, settings);
  const Calibration shipped = loadCalibration({}, law);
  EXPECT_EQ(shipped.reach, 0.0);
  EXPECT_NE(shipped.note.find("coatings"), std::string::npos);
  EXPECT_FALSE(shipped.young || shipped.elements);

  PressOptions own;
  own.dent.table = dataFile("tables/sphere_r10_h50.csv");
  own.tissue.options.coatings = settings.coatings;
  EXPECT_EQ(loadCalibration(own, law).note, "");
  EXPECT_GT(loadCalibration(own, law).reach, 0.0);
  own.tissue.options.coatings = {};
  own.tissue.options.coatings.add({ 3.0_mm, { 200.0_kPa, 0.4 } });
  EXPECT_EQ(loadCalibration(own, law).reach, 0.0);
}

TEST(LoadCalibration, RefusesALayerForACone)
{
  PressOptions options;
  options.dent.layer = 40.0_mm;
  EXPECT_THROW((void)load(ConeTip{ 45.0_deg, 10.0_mm }, options), Error);
}

TEST(PressOptions, RefusesBadLengths)
{
  for (const char* text : { "-1mm", "40", "0mm", "2000m", "nanmm", "" })
  {
    EXPECT_THROW((void)parseLayer(text), Error) << text;
    EXPECT_THROW((void)parseThreshold(text), Error) << text;
  }
  EXPECT_DOUBLE_EQ(parseLayer("4cm"), 0.04);
  EXPECT_DOUBLE_EQ(parseThreshold("20um"), 20e-6);
}

// the fitted curves of R = 10 mm, half the size
TEST(LoadCalibration, FittedSurfacesScaleWithTheTool)
{
  PressOptions options;
  options.dent.surface = DentSurface::Fitted;
  const auto whole = load(SphereTip{ 10.0_mm }, options).style.fitted;
  const auto more = load(SphereTip{ 12.0_mm }, options).style.fitted;
  ASSERT_TRUE(whole && more);
  EXPECT_NEAR(more->at(6.0_mm)->sinkAt(12.0_mm), 1.2 * whole->at(5.0_mm)->sinkAt(10.0_mm), 1e-9);
}

} // namespace
} // namespace palp
