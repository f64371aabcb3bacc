#include "app/organs/support_panel.h"
#include "calibration/tables/organ_table.h"
#include "data/shapes.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"
#include "tests/app/supports/slabs.h"
#include "tests/app/window/window_rig.h"
#include "tests/support/obj_file.h"

#include <QComboBox>
#include <QDockWidget>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::WindowTest;

// a block of 64 x 64 x 20 mm, seen as a window shows what is opened, and a brush
class Supports : public WindowTest
{
protected:
  Supports()
  {
    const Mesh box = makeBox({ 64.0_mm, 64.0_mm, 20.0_mm }, 5.0_mm);
    test::writeObj(folder_.path() / "block.obj", box.points, box.triangles);
    EXPECT_TRUE(window_->openFile(path("block.obj")));
    window_->findChild<QAction*>("supportsAction")->trigger();
    panel_ = window_->findChild<SupportPanel*>();
    EXPECT_TRUE(QTest::qWaitFor([this] { return panel_->isVisible(); }, kPatience));
    waitForFrames();
  }

  [[nodiscard]] QString path(const char* name) const
  {
    return QString::fromStdString((folder_.path() / name).string());
  }

  [[nodiscard]] QPushButton* button(const char* name) const
  {
    return panel_->findChild<QPushButton*>(name);
  }

  // holds the button down along a way through the middle of the picture
  void stroke(SupportPanel::Brush brush)
  {
    panel_->findChild<QComboBox*>("supportBrush")->setCurrentIndex(brush);
    button("paintSupports")->setChecked(true);
    const QPoint middle = canvas_->rect().center();
    QTest::mouseMove(canvas_, middle - QPoint(30, 0));
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle - QPoint(30, 0));
    for (int x = -20; x <= 30; x += 10)
    {
      QTest::mouseMove(canvas_, middle + QPoint(x, 0));
    }
    QTest::mouseRelease(canvas_, Qt::LeftButton, {}, middle + QPoint(30, 0));
    waitForFrames();
  }

  // pixels of the picture that are of the paint's colors
  [[nodiscard]] int painted(SupportPanel::Brush kind)
  {
    waitForFrames();
    const QImage image = canvas_->grabFramebuffer();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        const QColor color = image.pixelColor(x, y);
        const bool isBlue = color.blue() > 90 && color.blue() > 3 * color.red();
        const bool isYellow = color.green() > 110 && color.red() > 130 &&
          color.red() > 2 * color.blue() && color.green() * 4 > color.red() * 3;
        count += (kind == SupportPanel::Bonded ? isBlue : isYellow) ? 1 : 0;
      }
    }
    return count;
  }

  [[nodiscard]] QString legend() const
  {
    return panel_->findChild<QLabel*>("supportLegend")->text();
  }

  SupportPanel* panel_ = nullptr;
};

// a hand that is as fast as pictures are slow is told of at few places of its way
TEST_F(Supports, AFastStrokeLeavesNoGap)
{
  type("brushRadius", "3");
  button("paintSupports")->setChecked(true);
  const QPoint middle = canvas_->rect().center();
  const QPoint half(60, 0);
  QTest::mousePress(canvas_, Qt::LeftButton, {}, middle - half);
  QTest::mouseMove(canvas_, middle + half);
  QTest::mouseRelease(canvas_, Qt::LeftButton, {}, middle + half);
  (void)painted(SupportPanel::Bonded);
  button("paintSupports")->setChecked(false);
  canvas_->setFocus();
  const QImage image = canvas_->grabFramebuffer();
  int bare = 0;
  for (int x = middle.x() - half.x(); x <= middle.x() + half.x(); ++x)
  {
    const QColor color = image.pixelColor(x, middle.y() - 8);
    bare += color.blue() > 90 && color.blue() > 3 * color.red() ? 0 : 1;
  }
  EXPECT_LE(bare, 30) << "but for the tool's outline";
}

TEST_F(Supports, APaintedPlaceIsSeenErasedAndTakenBack)
{
  const int none = painted(SupportPanel::Bonded);
  ASSERT_LT(none, 50);
  stroke(SupportPanel::Bonded);
  EXPECT_FALSE(session_->newest().contact.touching()) << "the brush is no tool";
  const int bonded = painted(SupportPanel::Bonded);
  EXPECT_GT(bonded, none + 1000);
  EXPECT_EQ(painted(SupportPanel::Sliding), 0);
  stroke(SupportPanel::Sliding);
  EXPECT_LT(painted(SupportPanel::Bonded), bonded / 10) << "painted over";
  const int sliding = painted(SupportPanel::Sliding);
  EXPECT_GT(sliding, bonded / 2);
  type("brushRadius", "4");
  stroke(SupportPanel::Erase);
  EXPECT_LT(painted(SupportPanel::Sliding), 9 * sliding / 10);
  EXPECT_GT(painted(SupportPanel::Sliding), sliding / 10) << "a thinner brush leaves the border";
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NEAR(painted(SupportPanel::Sliding), sliding, sliding / 50);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NEAR(painted(SupportPanel::Bonded), bonded, bonded / 50);
  button("clearSupports")->click();
  EXPECT_LE(painted(SupportPanel::Bonded), none);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_NEAR(painted(SupportPanel::Bonded), bonded, bonded / 50);
  window_->findChild<QDockWidget*>("Supports")->close();
  EXPECT_LE(painted(SupportPanel::Bonded), none) << "its panel shows it";
}

// and what is typed beside
TEST_F(Supports, IsPaintedByTheKeyboardAloneAndTyped)
{
  button("paintSupports")->setChecked(true);
  canvas_->setFocus();
  const QString before = legend();
  QTest::keyClick(canvas_, Qt::Key_Right);
  QTest::keyClick(canvas_, Qt::Key_PageDown);
  EXPECT_NE(legend(), before);
  EXPECT_GT(painted(SupportPanel::Bonded), 500);
  button("clearSupports")->click();
  EXPECT_EQ(legend(), before);
  button("paintSupports")->setChecked(false);
  auto* others = panel_->findChild<QLineEdit*>("otherSupports");
  QTest::keyClicks(others, "sliding:direction:0,0,-1:10deg");
  QTest::keyClick(others, Qt::Key_Return);
  EXPECT_TRUE(legend().contains("41.0 cm")) << legend().toStdString();
  others->selectAll();
  QTest::keyClicks(others, "sliding:nowhere");
  QTest::keyClick(others, Qt::Key_Return);
  EXPECT_TRUE(said().contains("sliding:nowhere")) << said().toStdString();
}

// a slab of 40 x 40 x 10 mm on another label, which is read from its image behind the window;
// voxels of 2 mm, so the surface is smooth by about one of them where they meet
TEST_F(Supports, ALabelThatItRestsOnIsSeen)
{
  test::writeSlabs(folder_.path() / "slabs.nrrd", 20, 10);
  std::ofstream(folder_.path() / "slab.json")
    << R"({"palp_scene": 1, "meshes": [{"file": "slabs.nrrd", "label": "3"}]})";
  ASSERT_TRUE(window_->openFiles({ path("slab.json") })) << said().toStdString();
  auto* others = panel_->findChild<QLineEdit*>("otherSupports");
  QTest::keyClicks(others, "bonded:label:7");
  QTest::keyClick(others, Qt::Key_Return);
  const auto area = [this]
  { return QRegularExpression("[0-9.]+(?= cm)").match(legend()).captured().toDouble(); };
  EXPECT_TRUE(QTest::qWaitFor([&] { return area() > 0.0; }, kPatience));
  EXPECT_NEAR(area(), 16.0, 3.0) << legend().toStdString();
  QTest::keyClicks(others, " bonded:label:9");
  QTest::keyClick(others, Qt::Key_Return);
  EXPECT_TRUE(QTest::qWaitFor([this] { return said().contains("9"); }, kPatience));
  EXPECT_GT(area(), 10.0) << "as before";
}

// painted, solved by the program behind the window, felt, and shown again with its file
TEST_F(Supports, WhatIsPaintedIsSolvedAndComesBackWithTheOrganFile)
{
  EXPECT_FALSE(window_->solveOrgan(path("nothing.organ")));
  EXPECT_TRUE(said().contains("rests on nothing")) << said().toStdString();
  stroke(SupportPanel::Bonded);
  const int seen = painted(SupportPanel::Bonded);
  const QString told = legend();
  type("supportCell", "6");
  QTimer::singleShot(10 * kPatience, window_.get(), [] { FAIL() << "no end of the solution"; });
  ASSERT_TRUE(window_->solveOrgan(path("block.organ"))) << said().toStdString();
  ASSERT_NE(session_->recording().scene.series, nullptr);
  const OrganTable table = readOrganTable(path("block.organ").toStdString());
  EXPECT_TRUE(table.supports.starts_with("bonded:points:block_bonded.csv")) << table.supports;
  EXPECT_EQ(table.cell, 6.0_mm);
  const NumberTable points =
    NumberTable::readFinite(path("block_bonded.csv").toStdString(), "x_mm,y_mm,z_mm");
  EXPECT_GT(points.rows.size(), 20U);
  for (const auto& [values, line] : points.rows)
  {
    EXPECT_LT(std::abs(values[0]), 32.1);
    EXPECT_LT(std::abs(values[1]), 32.1);
    const bool isOnAFace = std::abs(values[2]) < 0.02 || std::abs(values[2] + 20.0) < 0.02 ||
      std::abs(std::abs(values[0]) - 32.0) < 0.02 || std::abs(std::abs(values[1]) - 32.0) < 0.02;
    EXPECT_TRUE(isOnAFace) << line;
  }
  EXPECT_NEAR(painted(SupportPanel::Bonded), seen, seen / 10) << "but for the tool over it";
  EXPECT_EQ(legend(), told);

  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  EXPECT_NE(legend(), told) << "of another body";
  ASSERT_TRUE(window_->openFile(path("block.obj")));
  ASSERT_TRUE(window_->openFiles({ path("block.organ") }));
  EXPECT_EQ(legend(), told);
  EXPECT_EQ(session_->body().sources.front().supports.size(), 1U);
}

} // namespace
} // namespace palp
