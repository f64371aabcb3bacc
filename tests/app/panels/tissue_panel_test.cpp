#include "app/panels/tissue_panel.h"

#include "app/press/calibration.h"
#include "app/panels/panel_boxes.h"
#include "app/input/tip_spec.h"
#include "app/panels/tool_panel.h"
#include "haptics/error.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/app/application.h"
#include "tests/support/process.h"

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>

#include <clocale>
#include <cmath>
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

  [[nodiscard]] QuantityBox& box(const char* name) const
  {
    return *panel_->findChild<QuantityBox*>(name);
  }
  [[nodiscard]] QLabel& reason(const std::string& name) const
  {
    return *panel_->findChild<QLabel*>(QString::fromStdString(name + "Reason"));
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
    QTest::keyClick(&box(name), Qt::Key_Delete);
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

struct Entry
{
  const char* field;
  const char* text;
  double si = std::nan(""); // refused
};

class TypedTexts
  : public TissuePanelTest
  , public ::testing::WithParamInterface<const char*>
{
protected:
  TypedTexts()
  {
    std::setlocale(LC_ALL, GetParam());
    QLocale::setDefault(QLocale(GetParam()));
    use(sceneOf(SphereTip{ 10.0_mm }));
  }
  ~TypedTexts() override
  {
    std::setlocale(LC_ALL, "C");
    QLocale::setDefault(QLocale::c());
  }
};
INSTANTIATE_TEST_SUITE_P(Locales, TypedTexts, ::testing::Values("C", "de_DE.UTF-8"));

TEST_P(TypedTexts, AreTakenAsWrittenOrRefusedInWords)
{
  const Entry entries[]{ { "young", "5MPa", 5e6 }, { "young", "5 MPa", 5e6 },
    { "young", "12", 12e3 }, { "young", "12.5", 12.5e3 }, { "young", "1e3", 1e6 },
    { "young", "12,5" }, { "young", "50000000" }, { "young", "0" }, { "young", "abc" },
    { "young", "" }, { "young", "-5" }, { "young", "5mm" }, { "young", "nan" },
    { "radius", "1cm", 0.01 }, { "radius", "250um", 250e-6 }, { "radius", "12.5", 0.0125 },
    { "radius", "12,5" }, { "radius", "1.000,5" }, { "radius", "0" }, { "radius", "abc" },
    { "radius", "1e300m" }, { "radius", "5 kPa" }, { "poisson", "0.45", 0.45 },
    { "poisson", "0", 0.0 }, { "poisson", "0.7" }, { "poisson", "0,45" }, { "poisson", "0.3Pa" },
    { "damping", "500", 500.0 }, { "damping", "5 N·s/m", 5.0 }, { "damping", "2N*s/m", 2.0 },
    { "damping", "-1" }, { "damping", "1e9" }, { "halfAngle", "60", 60.0_deg },
    { "halfAngle", "1rad", 1.0 }, { "halfAngle", "30°", 30.0_deg }, { "halfAngle", "95" },
    { "halfAngle", "0" }, { "flatRadius", "4", 4.0_mm }, { "flatRadius", "0.1cm", 1.0_mm },
    { "flatRadius", "2000" }, { "tipRadius", "0.5", 0.5_mm }, { "tipRadius", "2000" } };
  for (const Entry& entry : entries)
  {
    const std::string field = entry.field;
    list("kind").setCurrentIndex(field == "tipRadius" ? BluntCone
        : field == "flatRadius"                       ? TruncatedCone
                                                      : Cone);
    const double before = box(entry.field).si();
    const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
    type(entry.field, entry.text);
    const bool taken = std::isfinite(entry.si);
    EXPECT_EQ(reason(field).isVisible(), !taken) << field << ": " << entry.text;
    if (taken)
    {
      EXPECT_NEAR(box(entry.field).si(), entry.si, 1e-12 * entry.si) << field << ": " << entry.text;
      EXPECT_EQ(changes.count(), before == box(entry.field).si() ? 0 : 1) << entry.text;
    }
    else
    {
      EXPECT_EQ(box(entry.field).si(), before) << field << ": " << entry.text;
      EXPECT_EQ(box(entry.field).text(), entry.text) << "stays to be mended";
      EXPECT_EQ(changes.count(), 0) << field << ": " << entry.text;
    }
  }
  // a change elsewhere takes nothing away
  type("young", "77");
  panel_->setScene(sceneOf(panel_->law().tip(), panel_->law().material()));
  EXPECT_EQ(box("tipRadius").text(), "2000");
  EXPECT_EQ(box("young").text(), "77 kPa");
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
  type("radius", "5");
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

  QTest::keyClicks(&field, "2mm");
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_TRUE(reason("coatings").isVisible());
  EXPECT_EQ(field.text(), "2mm");
  EXPECT_FALSE(reason("coatings").text().contains("--")) << reason("coatings").text().toStdString();
  EXPECT_TRUE(panel_->law().settings().coatings.empty());
}

TEST_F(TissuePanelTest, TheWheelChangesOnlyWhatWasClicked)
{
  QuantityBox& radius = box("radius");
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
  EXPECT_EQ(radius.si(), 10.0_mm);
  radius.setFocus();
  turn();
  EXPECT_NEAR(radius.si(), 11.0_mm, 1e-15);
}

} // namespace
} // namespace palp
