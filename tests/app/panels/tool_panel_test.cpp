#include "app/panels/tool_panel.h"

#include "app/input/tip_text.h"
#include "app/press/calibration.h"
#include "haptics/error.h"
#include "tests/app/dialog_closer.h"
#include "tests/app/panels/panel_rig.h"

#include <QLineEdit>
#include <QSignalSpy>

#include <gtest/gtest.h>
#include <map>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using enum ToolPanel::Kind;

struct Typed
{
  ToolPanel::Kind shape;
  std::map<std::string, const char*> fields; // all that the shape has
  Tip tip;
};

std::ostream& operator<<(std::ostream& out, const Typed& typed)
{
  return out << describeTip(typed.tip);
}

class EveryShape
  : public TissuePanelTest
  , public ::testing::WithParamInterface<Typed>
{
};
INSTANTIATE_TEST_SUITE_P(Tool, EveryShape,
  ::testing::Values(Typed{ Sphere, { { "radius", "7.5" } }, SphereTip{ 7.5_mm } },
    Typed{ Cone, { { "radius", "8" }, { "halfAngle", "30" } }, ConeTip{ 30.0_deg, 8.0_mm } },
    Typed{ Punch, { { "radius", "5" } }, PunchTip{ 5.0_mm } },
    Typed{ TruncatedCone, { { "radius", "12" }, { "halfAngle", "60" }, { "flatRadius", "2.5" } },
      TruncatedConeTip{ 60.0_deg, 2.5_mm, 12.0_mm } },
    Typed{ BluntCone, { { "radius", "9" }, { "halfAngle", "40" }, { "tipRadius", "1.25" } },
      BluntConeTip{ 40.0_deg, 1.25_mm, 9.0_mm } },
    Typed{ Paraboloid, { { "radius", "6" } }, ParaboloidTip{ 6.0_mm } }));

TEST_P(EveryShape, IsWhatItsFieldsSayAndHasNoOthers)
{
  list("kind").setCurrentIndex(GetParam().shape);
  std::set<std::string> names;
  for (const auto& [name, number] : GetParam().fields)
  {
    names.insert(name);
    type(name.c_str(), number);
  }
  EXPECT_EQ(fieldsShown(), names);
  expectSame(panel_->law().tip(), GetParam().tip);
}

TEST_P(EveryShape, IsShownAsItIsInUse)
{
  panel_->setScene(sceneOf(GetParam().tip));
  EXPECT_EQ(list("kind").currentIndex(), GetParam().shape);
  for (const auto& [name, number] : GetParam().fields)
  {
    EXPECT_TRUE(box(name.c_str()).text().startsWith(QString(number) + ' ')) << name;
  }
  expectSame(panel_->law().tip(), GetParam().tip);
}

// whatever is typed, in whatever order, what is in use is a tool with an R_d
TEST_P(EveryShape, IsNeverLeftWithoutATool)
{
  list("kind").setCurrentIndex(GetParam().shape);
  const std::map<std::string, std::pair<const char*, const char*>> ends{
    { "radius", { "0.1", "1000" } }, { "halfAngle", { "1", "89" } },
    { "flatRadius", { "0.001", "999" } }, { "tipRadius", { "0.001", "57000" } }
  };
  const char* const names[]{ "radius", "halfAngle", "flatRadius", "tipRadius" };
  for (int turn = 0; turn < 4; ++turn)
  {
    for (unsigned combination = 0; combination < 16; ++combination)
    {
      for (int i = 0; i < 4; ++i)
      {
        const auto field = static_cast<unsigned>(i + turn) % 4;
        const auto& [low, high] = ends.at(names[field]);
        if (GetParam().fields.contains(names[field]))
        {
          type(names[field], (combination >> field & 1U) != 0 ? high : low);
        }
      }
      EXPECT_NO_THROW((void)loadCalibration({}, panel_->law())) << turn << ", " << combination;
    }
  }
}

TEST_F(TissuePanelTest, RefusesABaseThatIsNarrowerThanItsFlat)
{
  list("kind").setCurrentIndex(TruncatedCone);
  type("flatRadius", "4");
  type("radius", "3");
  EXPECT_EQ(box("radius").text(), "3");
  EXPECT_TRUE(reason("radius").text().contains("flat")) << reason("radius").text().toStdString();
  expectSame(panel_->law().tip(), TruncatedConeTip{ 45.0_deg, 4.0_mm, 10.0_mm });
}

// a flat that was never meant for this base
TEST_F(TissuePanelTest, FitsTheFlatOfAnotherShapeAndSaysSo)
{
  type("radius", "1");
  list("kind").setCurrentIndex(TruncatedCone);
  expectSame(panel_->law().tip(), TruncatedConeTip{ 45.0_deg, 0.5_mm, 1.0_mm });
  EXPECT_FALSE(reason("flatRadius").text().isEmpty());
}

TEST_F(TissuePanelTest, AnotherShapeForgetsNothingThatWasTyped)
{
  list("kind").setCurrentIndex(TruncatedCone);
  type("flatRadius", "4");
  list("kind").setCurrentIndex(Punch);
  type("radius", "3");
  type("radius", "11");
  list("kind").setCurrentIndex(TruncatedCone);
  expectSame(panel_->law().tip(), TruncatedConeTip{ 45.0_deg, 4.0_mm, 11.0_mm });
}

TEST_F(TissuePanelTest, TakesAProfileFromAFile)
{
  tool().askForProfile(write("needle.csv", "radius_mm,height_mm\n0,0\n2,1\n6,5\n"));
  EXPECT_EQ(fieldsShown(), std::set<std::string>{ "profile" });
  EXPECT_EQ(panel_->findChild<QLineEdit*>("profile")->text(), "needle.csv");
  const ForceLaw law = panel_->law();
  EXPECT_NEAR(baseRadius(law.tip()), 6.0_mm, 1e-12);
  EXPECT_NEAR(tipHeight(law.tip(), 1.0_mm), 0.5_mm, 1e-12);
  EXPECT_NEAR(tipHeight(law.tip(), 4.0_mm), 3.0_mm, 1e-12);

  panel_->setScene(sceneOf(law.tip()));
  list("kind").setCurrentIndex(Sphere);
  expectSame(panel_->law().tip(), SphereTip{ 6.0_mm });
  list("kind").setCurrentIndex(FromFile); // the one that was in use
  expectSame(panel_->law().tip(), law.tip());
}

TEST_F(TissuePanelTest, RefusesAFileThatIsNoProfile)
{
  tool().askForProfile(write("hollow.csv", "radius_mm,height_mm\n0,0\n2,5\n6,5.5\n"));
  try
  {
    (void)panel_->law();
    FAIL() << "taken";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("hollow.csv"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("convex"), std::string::npos) << error.what();
  }
  panel_->setScene(sceneOf(SphereTip{ 10.0_mm }));
  expectSame(panel_->law().tip(), SphereTip{ 10.0_mm });
  EXPECT_EQ(fieldsShown(), std::set<std::string>{ "radius" });
}

TEST_F(TissuePanelTest, KeepsTheToolWhereNoFileIsChosen)
{
  const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
  const test::DialogCloser closer;
  list("kind").setCurrentIndex(FromFile);
  EXPECT_GT(closer.count(), 0);
  EXPECT_EQ(list("kind").currentIndex(), Sphere);
  EXPECT_EQ(changes.count(), 0);
}

} // namespace
} // namespace palp
