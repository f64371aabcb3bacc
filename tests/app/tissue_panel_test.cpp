#include "app/tissue_panel.h"

#include "app/calibration.h"
#include "app/tip_spec.h"
#include "app/tool_panel.h"
#include "haptics/error.h"
#include "haptics/force/profile.h"
#include "haptics/units.h"
#include "tests/app/application.h"
#include "tests/support/process.h"

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace palp
{
namespace
{

using namespace units::literals;

using enum ToolPanel::Kind;

const char* const kFields[]{ "radius", "halfAngle", "flatRadius", "tipRadius", "profile" };

Scene sceneOf(const Tip& tip, const Material& material = { 50.0_kPa, 0.33 })
{
  Scene scene;
  scene.law = ForceLaw(tip, material);
  return scene;
}

// the same surface of revolution, of the same kind
void expectSame(const Tip& found, const Tip& expected)
{
  ASSERT_EQ(found.index(), expected.index());
  EXPECT_NEAR(baseRadius(found), baseRadius(expected), 1e-12);
  EXPECT_NEAR(flatRadius(found), flatRadius(expected), 1e-12);
  for (const double share : { 0.01, 0.1, 0.3, 0.6, 0.9, 1.0 })
  {
    const double radius = share * baseRadius(expected);
    EXPECT_NEAR(tipHeight(found, radius), tipHeight(expected, radius), 1e-12) << share;
  }
}

class TissuePanelTest : public ::testing::Test
{
protected:
  TissuePanelTest()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    test::application();
    use(sceneOf(SphereTip{ 10.0_mm }));
  }

  void use(const Scene& scene, const LawOptions& options = {})
  {
    panel_ = std::make_unique<TissuePanel>(scene, options);
    panel_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(panel_.get()));
  }

  [[nodiscard]] QDoubleSpinBox& box(const char* name) const
  {
    return *panel_->findChild<QDoubleSpinBox*>(name);
  }
  [[nodiscard]] QComboBox& list(const char* name) const
  {
    return *panel_->findChild<QComboBox*>(name);
  }
  [[nodiscard]] ToolPanel& tool() const
  {
    return *panel_->findChild<ToolPanel*>();
  }

  void type(const char* name, const char* number) const
  {
    box(name).selectAll();
    QTest::keyClicks(&box(name), number);
    QTest::keyClick(&box(name), Qt::Key_Return);
  }

  [[nodiscard]] std::set<std::string> fieldsShown() const
  {
    std::set<std::string> shown;
    for (const char* name : kFields)
    {
      if (panel_->findChild<QWidget*>(name)->isVisible())
      {
        shown.insert(name);
      }
    }
    return shown;
  }

  [[nodiscard]] QString write(const char* name, const char* text) const
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file) << text;
    return QString::fromStdString(file.string());
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<TissuePanel> panel_;
};

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
    EXPECT_NEAR(box(name.c_str()).value(), std::atof(number), 1e-9) << name;
  }
  expectSame(panel_->law().tip(), GetParam().tip);
}

// whatever is typed, in whatever order, makes a tool with an R_d
TEST_P(EveryShape, HasNoCombinationThatIsRefused)
{
  list("kind").setCurrentIndex(GetParam().shape);
  const char* const names[]{ "radius", "halfAngle", "flatRadius", "tipRadius" };
  for (int turn = 0; turn < 4; ++turn)
  {
    for (int combination = 0; combination < 16; ++combination)
    {
      for (int i = 0; i < 4; ++i)
      {
        const int field = (i + turn) % 4;
        QDoubleSpinBox& chosen = box(names[field]);
        chosen.setValue((combination >> field & 1) != 0 ? chosen.maximum() : chosen.minimum());
      }
      EXPECT_NO_THROW((void)loadCalibration({}, panel_->law())) << turn << ", " << combination;
    }
  }
}

TEST_F(TissuePanelTest, AFlatAndACapStayNarrowerThanTheBase)
{
  list("kind").setCurrentIndex(TruncatedCone);
  type("flatRadius", "4");
  type("radius", "3");
  EXPECT_LT(box("flatRadius").value(), 3.0);
  EXPECT_GT(box("flatRadius").value(), 2.9);

  // the cap meets the flank at rho cos(alpha), which is half of rho at 60 degrees
  list("kind").setCurrentIndex(BluntCone);
  type("halfAngle", "60");
  type("tipRadius", "5.9");
  expectSame(panel_->law().tip(), BluntConeTip{ 60.0_deg, 5.9_mm, 3.0_mm });
  type("halfAngle", "30");
  const double meets = box("tipRadius").value() * 0.8660254;
  EXPECT_LT(meets, 3.0);
  EXPECT_GT(meets, 2.9);
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

TEST_F(TissuePanelTest, WhatNobodyTypesStaysExact)
{
  const double radius = 7.00012e-3; // [m], more digits than a field shows
  use(sceneOf(SphereTip{ radius }, { 12345.6789, 0.33333333 }));
  type("damping", "3");
  const ForceLaw law = panel_->law();
  EXPECT_EQ(std::get<SphereTip>(law.tip()).radius, radius);
  EXPECT_EQ(law.material().youngModulus, 12345.6789);
  EXPECT_EQ(law.material().poissonRatio, 0.33333333);
  EXPECT_EQ(panel_->damping(), 3.0);
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
  bool asked = false;
  QTimer closer;
  QObject::connect(&closer, &QTimer::timeout,
    [&]
    {
      if (auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget()))
      {
        asked = true;
        dialog->reject();
      }
    });
  closer.start(100);
  list("kind").setCurrentIndex(FromFile);
  EXPECT_TRUE(asked);
  EXPECT_EQ(list("kind").currentIndex(), Sphere);
  EXPECT_EQ(changes.count(), 0);
}

TEST_F(TissuePanelTest, SaysOnceThatSomethingChanged)
{
  list("kind").setCurrentIndex(TruncatedCone);
  const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
  type("radius", "1"); // takes the flat of 2 mm with it
  EXPECT_EQ(changes.count(), 1);
  panel_->setScene(sceneOf(PunchTip{ 4.0_mm }));
  EXPECT_EQ(changes.count(), 1);
}

TEST_F(TissuePanelTest, EnablesWhatActsInTheLaw)
{
  for (const auto& [mode, acts] : { std::pair(1, false), { 2, true }, { 0, false } })
  {
    list("law").setCurrentIndex(mode);
    EXPECT_EQ(list("base").isEnabled(), acts) << mode;
    EXPECT_EQ(list("material").isEnabled(), acts) << mode;
    EXPECT_EQ(static_cast<int>(panel_->law().settings().mode), mode);
  }
}

TEST_F(TissuePanelTest, TheCorrectedLawTakesItsTableOnlyForNeoHookeanTissue)
{
  list("law").setCurrentIndex(2);
  LawSettings settings = panel_->law().settings();
  EXPECT_EQ(settings.constitution, Constitution::NeoHookean);
  EXPECT_EQ(settings.base, Base::Bonded);
  EXPECT_NE(settings.largeStrain, nullptr);

  list("material").setCurrentText("Linear");
  list("base").setCurrentText("Slip");
  settings = panel_->law().settings();
  EXPECT_EQ(settings.constitution, Constitution::Linear);
  EXPECT_EQ(settings.base, Base::Slip);
  EXPECT_EQ(settings.largeStrain, nullptr);
}

TEST_F(TissuePanelTest, TheCorrectedLawTakesCoatings)
{
  auto& field = *panel_->findChild<QLineEdit*>("coatings");
  EXPECT_FALSE(field.isEnabled());
  list("law").setCurrentIndex(2);
  ASSERT_TRUE(field.isEnabled());
  const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
  QTest::keyClicks(&field, "2mm:80kPa:0.45, 1cm:5kPa:0.48");
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_EQ(changes.count(), 1);
  const ForceLaw law = panel_->law();
  const auto sheets = law.settings().coatings.all();
  ASSERT_EQ(sheets.size(), 2U);
  EXPECT_NEAR(sheets[0].thickness, 2.0_mm, 1e-12);
  EXPECT_NEAR(sheets[1].thickness, 10.0_mm, 1e-12);
  EXPECT_NEAR(sheets[1].material.youngModulus, 5.0_kPa, 1e-9);

  // another law knows none; this one has them again
  Scene scene = sceneOf(SphereTip{ 10.0_mm });
  scene.law = law;
  panel_->setScene(scene);
  list("law").setCurrentIndex(0);
  EXPECT_TRUE(panel_->law().settings().coatings.empty());
  panel_->setScene(sceneOf(SphereTip{ 10.0_mm }));
  list("law").setCurrentIndex(2);
  EXPECT_EQ(panel_->law().settings().coatings.all().size(), 2U);

  // too thin under a larger tool: they can be taken out under any law
  list("law").setCurrentIndex(0);
  type("radius", "100");
  list("law").setCurrentIndex(2);
  EXPECT_THROW((void)panel_->law(), Error);
  panel_->setScene(sceneOf(SphereTip{ 100.0_mm })); // as the window does where it is refused
  ASSERT_TRUE(field.isEnabled());
  field.selectAll();
  QTest::keyClick(&field, Qt::Key_Delete);
  QTest::keyClick(&field, Qt::Key_Return);
  list("law").setCurrentIndex(2);
  EXPECT_TRUE(panel_->law().settings().coatings.empty());

  field.setText("2mm");
  EXPECT_THROW((void)panel_->law(), Error);
}

TEST_F(TissuePanelTest, TheWheelChangesOnlyWhatWasClicked)
{
  QDoubleSpinBox& radius = box("radius");
  const auto turn = [&]
  {
    const QPointF place = radius.rect().center();
    QWheelEvent event(place, radius.mapToGlobal(place.toPoint()), {}, { 0, 120 }, Qt::NoButton,
      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&radius, &event);
  };
  QApplication::setActiveWindow(panel_.get());
  box("young").setFocus();
  turn();
  EXPECT_EQ(radius.value(), 10.0);
  radius.setFocus();
  turn();
  EXPECT_GT(radius.value(), 10.0);
}

} // namespace
} // namespace palp
