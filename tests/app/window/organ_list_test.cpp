#include "app/graphs/chart_panel.h"
#include "app/organs/organ_list.h"
#include "app/shell/theme.h"
#include "haptics/units.h"
#include "tests/app/window/window_rig.h"

#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLineEdit>
#include <QStyleOptionComboBox>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>
#include <gtest/gtest.h>
#include <vtkPlot.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::WindowTest;

// a ball between the eye and the liver, in the middle of the picture
ScenePlan liverBehindBall()
{
  setenv("PALP_DATA", PALP_SHARE, 1);
  const SceneBody liver = loadBody({ { .bundled = "liver" } });
  Eigen::Vector3d middle;
  liver.display->GetCenter(middle.data());
  ScenePlan plan;
  plan.meshes = { { .bundled = "liver" },
    { .bundled = "sphere_30",
      .origin = middle + 0.1 * Eigen::Vector3d(-0.35, -1.0, 0.75).normalized() } };
  plan.organs = { { .name = "liver" },
    { .name = "ball", .role = OrganRole::Through, .color = { 20, 200, 20 } } };
  plan.organs[0].press.tissue.young = 6.0_kPa;
  plan.organs[1].press.tissue.young = 30.0_kPa;
  return plan;
}

class OrganListTest : public WindowTest
{
protected:
  OrganListTest()
    : WindowTest(liverBehindBall())
  {
  }

  // of its text
  [[nodiscard]] static QRect roomIn(const QComboBox& box)
  {
    QStyleOptionComboBox option;
    option.initFrom(&box);
    return box.style()->subControlRect(
      QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box);
  }

  // on a small screen, too
  void expectNamesAreSeen() const
  {
    const auto* rows = part<QTreeWidget>("organRows");
    const auto widthOf = [rows](const QString& text)
    { return rows->fontMetrics().horizontalAdvance(text); };
    EXPECT_GE(rows->columnWidth(2), widthOf("gallbladder") + 6);
    EXPECT_LE(rows->header()->length(), rows->viewport()->width()) << "the last column is cut";
    EXPECT_GE(roomIn(*part<QComboBox>("organRole0")).width(), widthOf("Pressed"));
    // a name that is too long ends in dots, which are low
    const QRect room = roomIn(*part<QComboBox>("organTissue0"));
    const QImage tissue = part<QComboBox>("organTissue0")->grab().toImage();
    const int ground = qGray(tissue.pixel(room.left() + 1, room.center().y()));
    int ink = 0;
    for (int y = room.center().y() - 3; y < room.center().y() + 2; ++y)
    {
      for (int x = room.right() - 6; x <= room.right(); ++x)
      {
        ink += std::abs(qGray(tissue.pixel(x, y)) - ground) > 60 ? 1 : 0;
      }
    }
    EXPECT_EQ(ink, 0) << "the name of the tissue is cut";
  }

  template <typename Widget>
  [[nodiscard]] Widget* part(const char* name) const
  {
    auto* found = window_->findChild<Widget*>(name);
    EXPECT_NE(found, nullptr) << name;
    return found;
  }

  void choose(const char* name, const QString& text) const
  {
    part<QComboBox>(name)->setCurrentText(text);
  }

  void click(const char* button) const
  {
    QTest::mouseClick(part<QToolButton>(button), Qt::LeftButton);
  }

  // its name
  void clickOrgan(int place) const
  {
    auto* rows = part<QTreeWidget>("organRows");
    const QRect row = rows->visualItemRect(rows->topLevelItem(place));
    QTest::mouseClick(rows->viewport(), Qt::LeftButton, {},
      { rows->columnViewportPosition(2) + 5, row.center().y() });
  }

  [[nodiscard]] OrganRole role(std::size_t organ) const
  {
    return session_->organs()[organ].role;
  }

  [[nodiscard]] QImage picture() const
  {
    waitForFrames(); // also with smooth edges
    return canvas_->grabFramebuffer();
  }

  // share of the pixels that another picture has otherwise
  [[nodiscard]] static double difference(const QImage& one, const QImage& other)
  {
    int changed = 0;
    for (int y = 0; y < one.height(); ++y)
    {
      for (int x = 0; x < one.width(); ++x)
      {
        const QColor a = one.pixelColor(x, y);
        const QColor b = other.pixelColor(x, y);
        changed += std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) > 20 ? 1 : 0;
      }
    }
    return static_cast<double>(changed) / (one.width() * one.height());
  }

  // which organ a press in the middle of the picture is of
  [[nodiscard]] std::string pressedOrgan()
  {
    press(60);
    const int organ = session_->newest().organ;
    release();
    EXPECT_TRUE(waitForLift());
    return session_->recording().organName(organ);
  }
};

TEST_F(OrganListTest, NamesTheOrgansOnAnyScreen)
{
  choose("organTissue0", "Hepatocellular carcinoma");
  for (const QSize size : { QSize(1008, 720), QSize(1424, 812) })
  {
    window_->resize(size);
    QTest::qWait(300);
    expectNamesAreSeen();
  }
}

TEST_F(OrganListTest, AnEyeIsSeenInTheDarkToo)
{
  for (const Theme theme : { Theme::Dark, Theme::Light })
  {
    setTheme(theme);
    QTest::qWait(100);
    const QImage eye = part<QToolButton>("organEye1")->grab().toImage();
    int darkest = 255;
    int lightest = 0;
    for (int y = 0; y < eye.height(); ++y)
    {
      for (int x = 0; x < eye.width(); ++x)
      {
        darkest = std::min(darkest, qGray(eye.pixel(x, y)));
        lightest = std::max(lightest, qGray(eye.pixel(x, y)));
      }
    }
    EXPECT_GT(lightest - darkest, 100) << (theme == Theme::Dark ? "dark" : "light");
  }
  setTheme(Theme::System);
}

TEST_F(OrganListTest, TheMousePressesWhatIsFeltBehindWhatIsSeenThrough)
{
  EXPECT_EQ(pressedOrgan(), "liver");
  choose("organRole1", "Pressed");
  ASSERT_EQ(role(1), OrganRole::Press);
  EXPECT_EQ(pressedOrgan(), "ball");
  const auto& presses = session_->presses().presses();
  ASSERT_TRUE(QTest::qWaitFor([&] { return presses.size() == 2; }, kPatience));
  EXPECT_EQ(presses[0].organ, "liver");
  EXPECT_EQ(presses[1].organ, "ball");
  EXPECT_EQ(presses[1].law.material().youngModulus, 30.0_kPa);
  EXPECT_EQ(part<QAbstractSpinBox>("young")->text(), "30 kPa") << "of what was pressed";
  const auto* rows = part<QTreeWidget>("pressRows");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rows->topLevelItemCount() == 2; }, kPatience));
  EXPECT_EQ(rows->topLevelItem(1)->text(rows->columnCount() - 1), "ball");
  EXPECT_FALSE(rows->isColumnHidden(rows->columnCount() - 1));

  clickOrgan(0);
  EXPECT_EQ(part<QAbstractSpinBox>("young")->text(), "6 kPa");
  EXPECT_EQ(pressedOrgan(), "ball") << "again";
  EXPECT_EQ(part<QAbstractSpinBox>("young")->text(), "30 kPa");
  EXPECT_EQ(window_->findChild<OrganList*>()->chosen(), 1U);
}

TEST_F(OrganListTest, TheEyeHidesAnOrganAndUndoBringsItBack)
{
  const QImage before = picture();
  click("organEye1");
  EXPECT_EQ(role(1), OrganRole::Hide);
  EXPECT_GT(difference(picture(), before), 0.01) << "the ball is a tenth of the picture wide";
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(role(1), OrganRole::Through);
  EXPECT_LT(difference(picture(), before), 0.001);
  click("organEye1");
  click("organEye1");
  EXPECT_EQ(role(1), OrganRole::Through) << "as it was before it was hidden";
  EXPECT_TRUE(session_->earlier().empty()) << "nothing that is felt has changed";
}

TEST_F(OrganListTest, OneOrganAtLeastStaysPressed)
{
  click("organEye0");
  EXPECT_EQ(role(0), OrganRole::Press);
  EXPECT_EQ(part<QComboBox>("organRole0")->currentText(), "Pressed");
  EXPECT_NE(said().indexOf("no organ would be felt"), -1) << said().toStdString();
}

TEST_F(OrganListTest, EachOrganHasATissueWhichThePanelShowsAndEdits)
{
  choose("organRole1", "Pressed");
  clickOrgan(1);
  EXPECT_EQ(part<QAbstractSpinBox>("young")->text(), "30 kPa");
  type("young", "12");
  EXPECT_EQ(session_->organs()[1].press.tissue.young, 12.0_kPa);
  EXPECT_EQ(session_->organs()[0].press.tissue.young, 6.0_kPa);
  EXPECT_EQ(session_->recording().scene.others.at(0).law.material().youngModulus, 12.0_kPa);
  type("radius", "5");
  for (const OrganPlan& organ : session_->organs())
  {
    EXPECT_EQ(baseRadius(organ.press.tissue.tip), 5.0_mm) << "the tool is that of all";
  }
  const std::vector<TissuePreset> tissues = shippedTissues();
  const TissuePreset& hcc = tissueNamed("hcc", tissues, "tissue");
  choose("organTissue0", QString::fromStdString(hcc.title));
  EXPECT_EQ(session_->organs()[0].press.tissue.young, hcc.material.youngModulus);
  EXPECT_EQ(session_->recording().scene.law.material().youngModulus, hcc.material.youngModulus);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NE(session_->organs()[0].press.tissue.young, hcc.material.youngModulus);
}

TEST_F(OrganListTest, TheModelInTheChartIsThatOfTheOrganInThePanel)
{
  choose("organRole1", "Pressed");
  const auto model = [this]
  {
    const auto* canvas = window_->findChild<QVTKOpenGLNativeWidget*>("depthChart");
    vtkPalpChart* chart = qobject_cast<ChartPanel*>(canvas->parentWidget())->charts().at(0);
    vtkTable* curve = chart->GetPlot(0)->GetInput();
    return curve->GetValue(curve->GetNumberOfRows() - 1, 1).ToDouble(); // [N] at the deepest
  };
  clickOrgan(1);
  type("young", "60");
  const double stiff = model();
  clickOrgan(0); // of 6 kPa
  EXPECT_NEAR(model(), 0.1 * stiff, 0.01 * stiff);
  clickOrgan(1);
  EXPECT_NEAR(model(), stiff, 0.01 * stiff);
}

TEST_F(OrganListTest, AnotherBodyTakesTheirPlace)
{
  EXPECT_EQ(pressedOrgan(), "liver");
  click("organEye1");
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_30.vtp"));
  EXPECT_TRUE(session_->organs().empty());
  EXPECT_FALSE(part<OrganList>("organs")->isVisible());
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(pressedOrgan(), "");
  ASSERT_EQ(session_->earlier().size(), 1U);
  EXPECT_EQ(session_->earlier()[0].recording.organs.size(), 2U);
}

// tops of blocks of 100 x 100 mm at 0 and, beside it, at 8 mm; a ball reaches into the lower one
ScenePlan steppedBlocks()
{
  ScenePlan plan;
  plan.meshes = { { .bundled = "block_50" },
    { .bundled = "block_50", .origin = { 100.001_mm, 0.0, 8.0_mm } },
    { .bundled = "sphere_30", .origin = { -20.0_mm, 0.0, 20.0_mm } } };
  plan.organs = { { .name = "low" }, { .name = "high" }, { .name = "ball" } };
  return plan;
}

class MetOrganTest : public WindowTest
{
protected:
  MetOrganTest()
    : WindowTest(steppedBlocks())
  {
  }

  void pressAt(const char* place) const
  {
    auto* field = window_->findChild<QLineEdit*>("pressPlace");
    field->selectAll();
    QTest::keyClicks(field, place);
    QTest::keyClick(field, Qt::Key_Return);
  }
};

// a ball of R = 10 mm is as wide as its radius where it passes the wall at x = 50 mm
TEST_F(MetOrganTest, APressThatMeetsAnotherOrganIsTold)
{
  pressAt("45, 0, 0, 2 mm");
  waitForPresses(1);
  EXPECT_TRUE(QTest::qWaitFor([this]
    { return said().contains("is on low, but the tool meets high first and presses that"); },
    kPatience))
    << said().toStdString();
  EXPECT_EQ(session_->presses().presses()[0].organ, "high");
  pressAt("30, 30, 0, 2 mm");
  EXPECT_EQ(said(), "");
  waitForPresses(2);
  EXPECT_EQ(session_->presses().presses()[1].organ, "low");
}

TEST_F(MetOrganTest, APlaceWithinAnotherIsRefused)
{
  pressAt("-20, 0, 0, 2 mm");
  EXPECT_TRUE(said().contains("is on low, but a tool comes to it through ball only"))
    << said().toStdString();
  pressAt("30, 30, 0, 2 mm");
  EXPECT_EQ(said(), "") << "mended";
  waitForPresses(1);
  EXPECT_EQ(session_->presses().presses()[0].organ, "low");
}

} // namespace
} // namespace palp
