#include "app/panels/tissue_panel.h"

#include "app/panels/tool_panel.h"
#include "haptics/error.h"
#include "tests/app/panels/panel_rig.h"

#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QWheelEvent>

#include <clocale>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using enum ToolPanel::Kind;

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
      EXPECT_TRUE(reason(field).text().contains("still in use: "))
        << reason(field).text().toStdString();
      EXPECT_EQ(changes.count(), 0) << field << ": " << entry.text;
    }
  }
  // a change elsewhere takes nothing away
  type("young", "77");
  panel_->setScene(sceneOf(panel_->law().tip(), panel_->law().material()));
  EXPECT_EQ(box("tipRadius").text(), "2000");
  EXPECT_EQ(box("young").text(), "77 kPa");
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
  EXPECT_EQ(settings.constitution, ConstitutiveModel::NeoHookean);
  EXPECT_EQ(settings.base, Base::Unset);
  EXPECT_NE(settings.largeStrain, nullptr);

  list("material").setCurrentText("Linear");
  list("base").setCurrentText("Slip");
  settings = panel_->law().settings();
  EXPECT_EQ(settings.constitution, ConstitutiveModel::Linear);
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
  type("radius", "500");
  list("law").setCurrentIndex(2);
  EXPECT_THROW((void)panel_->law(), Error);
  panel_->setScene(sceneOf(SphereTip{ 500.0_mm })); // as the window does where it is refused
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

TEST_F(TissuePanelTest, TheCorrectedLawTakesRelaxationAndFriction)
{
  auto& relaxation = *panel_->findChild<QLineEdit*>("relaxation");
  auto& friction = *panel_->findChild<QLineEdit*>("friction");
  EXPECT_FALSE(relaxation.isEnabled() || friction.isEnabled());
  list("law").setCurrentIndex(2);
  const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
  QTest::keyClicks(&relaxation, "0.3:50ms, 0.2:1s");
  QTest::keyClick(&relaxation, Qt::Key_Return);
  QTest::keyClicks(&friction, "0.25");
  QTest::keyClick(&friction, Qt::Key_Return);
  EXPECT_EQ(changes.count(), 2);
  const ForceLaw law = panel_->law();
  ASSERT_EQ(law.settings().relaxation.all().size(), 2U);
  EXPECT_DOUBLE_EQ(law.settings().relaxation.all()[0].time, 0.05);
  EXPECT_DOUBLE_EQ(law.settings().friction, 0.25);

  // what a scene says is shown; what another law does not know is seen, but not in use
  Scene scene = sceneOf(SphereTip{ 10.0_mm });
  scene.law = law;
  panel_->setScene(scene);
  EXPECT_EQ(relaxation.text(), "0.3:0.05s,0.2:1s");
  list("law").setCurrentIndex(0);
  EXPECT_TRUE(panel_->law().settings().relaxation.empty());
  EXPECT_EQ(panel_->law().settings().friction, 0.0);
  EXPECT_EQ(relaxation.text(), "0.3:0.05s,0.2:1s");

  list("law").setCurrentIndex(2);
  for (const auto& [field, text] : { std::pair(&relaxation, "0.7:50ms,0.4:1s"),
         { &relaxation, "0.3" }, { &friction, "-1" }, { &friction, "much" } })
  {
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_FALSE(reason(field->objectName().toStdString()).text().isEmpty()) << text;
    EXPECT_DOUBLE_EQ(panel_->law().settings().friction, 0.25) << text;
    EXPECT_EQ(panel_->law().settings().relaxation.all().size(), 2U) << text;
  }
}

// choosing another law leaves nothing out in silence
TEST_F(TissuePanelTest, TellsWhatTheBodyHasInside)
{
  const auto& inside = *panel_->findChild<QLabel*>("inside");
  EXPECT_FALSE(inside.isVisible());
  panel_->setInside("2 nodules");
  EXPECT_TRUE(inside.isVisible());
  EXPECT_EQ(inside.text(), "2 nodules: only Corrected without coatings feels it");
  list("law").setCurrentIndex(2);
  EXPECT_EQ(inside.text(), "2 nodules");
  list("law").setCurrentIndex(1);
  EXPECT_NE(inside.text(), "2 nodules");
  panel_->setInside({});
  EXPECT_FALSE(inside.isVisible());
}

TEST_F(TissuePanelTest, AMeasuredTissueSetsItsModulusAndAnotherOneIsCustom)
{
  QComboBox& tissues = list("tissue");
  EXPECT_EQ(tissues.currentText(), "Custom"); // the paper's 50 kPa
  const QSignalSpy changes(panel_.get(), &TissuePanel::tissueChanged);
  tissues.setCurrentText("Hepatocellular carcinoma");
  EXPECT_EQ(changes.count(), 1);
  EXPECT_NEAR(panel_->law().material().youngModulus, 51.45_kPa, 1e-9);
  EXPECT_EQ(panel_->law().material().poissonRatio, 0.49);
  EXPECT_EQ(box("young").text(), "51.45 kPa");
  for (const QString& part : { QString("36.49 to 66.41 kPa"), QString("10.1177/8756479317733713") })
  {
    EXPECT_TRUE(tissues.toolTip().contains(part)) << tissues.toolTip().toStdString();
    EXPECT_TRUE(tissues.currentData(Qt::ToolTipRole).toString().contains(part));
  }

  type("young", "40");
  EXPECT_EQ(tissues.currentText(), "Custom");
  EXPECT_EQ(changes.count(), 2);
  type("young", "51.45");
  EXPECT_EQ(tissues.currentText(), "Hepatocellular carcinoma");
  type("poisson", "0.45");
  EXPECT_EQ(tissues.currentText(), "Custom");

  panel_->setScene(sceneOf(SphereTip{ 10.0_mm }, { 6.63_kPa, 0.49 }));
  EXPECT_EQ(tissues.currentText(), "Healthy liver");
}

TEST_F(TissuePanelTest, TheWheelChangesOnlyWhatWasClicked)
{
  QuantityBox& radius = box("radius");
  const auto turn = [&]
  {
    const QPointF position = radius.rect().center();
    QWheelEvent event(position, radius.mapToGlobal(position.toPoint()), {}, { 0, 120 },
      Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
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
