#pragma once

#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QSlider>
#include <QToolBar>

#include <cmath>
#include <fstream>

namespace palp::test
{

/// The window of a block whose upper face is z = 0, with a hand on the bar that plays.
class PlayBarTest : public WindowTest
{
protected:
  PlayBarTest()
  {
    EXPECT_TRUE(window_->openFile(PALP_SHARE "/meshes/block_50.vtp"));
  }

  // a ball goes 6 mm into it in a second, rests, and comes up
  void usePath(const char* rows = "0,0,0,0\n1,0,0,-6\n2,0,0,-6\n3,0,0,4\n")
  {
    const std::string file = (folder_.path() / "path.csv").string();
    std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n" << rows;
    session_->useDevice(parseDevice("path:" + file));
    EXPECT_TRUE(QTest::qWaitFor([this] { return bar()->isVisible(); }, kPatience));
  }

  [[nodiscard]] QToolBar* bar() const
  {
    return window_->findChild<QToolBar*>("playBar");
  }
  [[nodiscard]] QSlider* slider() const
  {
    return window_->findChild<QSlider*>("playSlider");
  }
  [[nodiscard]] QString label(const char* name) const
  {
    return window_->findChild<QLabel*>(name)->text();
  }
  void key(Qt::Key key) const
  {
    QTest::keyClick(canvas_, key);
  }
  void trigger(const char* action) const
  {
    window_->findChild<QAction*>(action)->trigger();
  }
  void setSpeed(double speed) const
  {
    auto* box = window_->findChild<QComboBox*>("playSpeed");
    box->setCurrentIndex(box->findData(speed));
  }
  [[nodiscard]] double time() const
  {
    return label("playedTime").trimmed().section(' ', 0, 0).toDouble();
  }
  [[nodiscard]] double depthShown() const
  {
    return label("force").section("depth ", 1).section(' ', 0, 0).toDouble();
  }
  [[nodiscard]] bool waitForDepthShown(double mm) const
  {
    return QTest::qWaitFor([&] { return std::abs(depthShown() - mm) < 0.06; }, kPatience);
  }

  [[nodiscard]] bool waitForNoBar() const
  {
    return QTest::qWaitFor([this] { return !bar()->isVisible(); }, kPatience);
  }

  // a press of 4 mm by the mouse
  void record()
  {
    press(60);
    release();
    EXPECT_TRUE(waitForLift());
    waitForPresses(1);
    ASSERT_NE(session_->recording().deepest(), nullptr);
  }
};

} // namespace palp::test
