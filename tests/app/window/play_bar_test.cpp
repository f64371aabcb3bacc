#include "haptics/devices/simulated/scripted_device.h"
#include "tests/app/window/play_rig.h"

#include <QAbstractButton>
#include <QLineEdit>
#include <QPushButton>

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::PlayBarTest;

TEST_F(PlayBarTest, IsThereOnlyWhereSomethingIsToBePlayed)
{
  const int height = canvas_->height();
  EXPECT_FALSE(bar()->isVisible());
  EXPECT_FALSE(window_->findChild<QAction*>("playAction")->isEnabled());
  trigger("reviewAction");
  EXPECT_TRUE(said().contains("press first")) << said().toStdString();
  EXPECT_FALSE(bar()->isVisible());

  usePath();
  EXPECT_TRUE(bar()->isVisible());
  session_->useDevice(parseDevice("mouse"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return canvas_->height() == height; }, kPatience));
  EXPECT_FALSE(bar()->isVisible());
}

TEST_F(PlayBarTest, NamesItsControlsAndSaysWhatTheyDo)
{
  usePath();
  for (const auto* control : bar()->findChildren<QWidget*>())
  {
    const bool isControl = control->isVisible() && control->focusPolicy() != Qt::NoFocus;
    const auto* button = qobject_cast<const QAbstractButton*>(control);
    EXPECT_TRUE(!isControl || !control->toolTip().isEmpty()) << control->objectName().toStdString();
    EXPECT_TRUE(
      !isControl || !control->accessibleName().isEmpty() || (button && !button->text().isEmpty()))
      << control->objectName().toStdString();
  }
}

TEST_F(PlayBarTest, FitsAScreenOf1024Columns)
{
  usePath();
  window_->resize(1024, 700);
  EXPECT_TRUE(QTest::qWaitFor([this] { return window_->width() <= 1024; }, kPatience));
  const auto isWhole = [this]
  {
    const auto children = bar()->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
    return std::ranges::all_of(children,
      [](const QWidget* child)
      { return !child->isVisible() || child->parentWidget()->rect().contains(child->geometry()); });
  };
  EXPECT_TRUE(QTest::qWaitFor(isWhole, kPatience));
  EXPECT_GE(slider()->width(), 200);
  EXPECT_FALSE(bar()->findChild<QWidget*>("qt_toolbar_ext_button")->isVisible());

  session_->useDevice(parseDevice("mouse"));
  record();
  trigger("reviewAction");
  EXPECT_TRUE(QTest::qWaitFor(isWhole, kPatience));
  EXPECT_GE(slider()->width(), 200);
  EXPECT_FALSE(bar()->findChild<QWidget*>("qt_toolbar_ext_button")->isVisible());
}

TEST_F(PlayBarTest, PausesAPathAndGoesOnAtTheSpeedAskedFor)
{
  usePath();
  EXPECT_EQ(slider()->maximum(), 3000);
  key(Qt::Key_Space);
  waitForRest();
  const Sample rest = session_->newest();
  const double at = session_->scripted()->reached();
  waitFor([](const Sample&) { return true; });
  EXPECT_EQ(session_->newest().pose.apex, rest.pose.apex);
  EXPECT_NEAR(time(), at, 0.0051);
  EXPECT_TRUE(label("playedTime").contains("/ 3.00 s")) << label("playedTime").toStdString();

  slider()->setValue(0);
  setSpeed(0.1);
  key(Qt::Key_Space);
  waitFor([](const Sample& sample) { return sample.contact.touching(); });
  const Sample slow = session_->newest();
  EXPECT_NEAR(slow.pose.velocity.z(), -0.6e-3, 1e-9); // a tenth of 6 mm/s
  waitFor([&](const Sample& sample) { return sample.time > slow.time + 1.0; });
  const Sample later = session_->newest(); // one place and one time, read together
  const double speed = (later.pose.apex.z() - slow.pose.apex.z()) / (later.time - slow.time);
  EXPECT_NEAR(speed, -0.6e-3, 0.005e-3);
}

TEST_F(PlayBarTest, ScrubsAPathWithPictureAndReadings)
{
  usePath();
  key(Qt::Key_Space);
  // depth at each time, by the path
  for (const auto& [ms, depth] :
    { std::pair(500, 3.0), { 1500, 6.0 }, { 100, 0.6 }, { 2300, 3.0 }, { 1000, 6.0 } })
  {
    slider()->setValue(ms);
    EXPECT_TRUE(waitForDepthShown(depth)) << ms << ": " << label("force").toStdString();
    EXPECT_TRUE(readings().contains(QString::number(depth, 'f', 1))) << readings().toStdString();
    EXPECT_NEAR(time(), 1e-3 * ms, 0.0051);
  }
  key(Qt::Key_Comma);
  key(Qt::Key_Comma);
  EXPECT_TRUE(QTest::qWaitFor(
    [this] { return std::abs(session_->scripted()->reached() - 0.98) < 1e-9; }, kPatience));
  key(Qt::Key_Period);
  EXPECT_TRUE(QTest::qWaitFor(
    [this] { return std::abs(session_->scripted()->reached() - 0.99) < 1e-9; }, kPatience));
}

TEST_F(PlayBarTest, AClickOnTheSliderGoesThereAndHoldsItUntilTheButtonIsUp)
{
  usePath();
  const QPoint there(slider()->width() / 3, slider()->height() / 2);
  QTest::mousePress(slider(), Qt::LeftButton, {}, there);
  EXPECT_NEAR(slider()->value(), 1000, 60);
  const double at = 1e-3 * slider()->value();
  waitFor([](const Sample&) { return true; });
  EXPECT_NEAR(session_->scripted()->reached(), at, 2e-3); // a tick may pass before it holds
  EXPECT_NEAR(1e-3 * slider()->value(), at, 1e-9);
  QTest::mouseRelease(slider(), Qt::LeftButton, {}, there);
  EXPECT_TRUE(
    QTest::qWaitFor([&] { return session_->scripted()->reached() > at + 0.1; }, kPatience));
}

TEST_F(PlayBarTest, StopsAtTheEndBeginsAnewAndLoops)
{
  usePath("0,0,0,4\n0.5,0,0,-4\n");
  const ScriptedDevice* device = session_->scripted();
  EXPECT_TRUE(QTest::qWaitFor([&] { return device->reached() == 0.5; }, kPatience));
  const auto* play = window_->findChild<QAction*>("playAction");
  EXPECT_TRUE(QTest::qWaitFor([&] { return play->iconText() == "Play"; }, kPatience));
  EXPECT_EQ(time(), 0.5);
  key(Qt::Key_Space);
  EXPECT_TRUE(QTest::qWaitFor([&] { return device->reached() < 0.4; }, kPatience));
  key(Qt::Key_L);
  for (int loop = 0; loop < 3; ++loop)
  {
    EXPECT_TRUE(QTest::qWaitFor([&] { return device->reached() > 0.4; }, kPatience));
    EXPECT_TRUE(QTest::qWaitFor([&] { return device->reached() < 0.3; }, kPatience));
  }
  EXPECT_EQ(play->iconText(), "Pause");
}

// while the bar is there, and they have no use of their own for it
TEST_F(PlayBarTest, APathThatCannotBeReadIsToldAndEndsNothing)
{
  press(60);
  release();
  waitForPresses(1);
  const auto file = folder_.path() / "table.csv";
  std::ofstream(file) << "x,y\n1,2\n";
  window_->openFiles({ QString::fromStdString(file.string()) });
  EXPECT_TRUE(said().contains("is not a number")) << said().toStdString();
  EXPECT_TRUE(session_->earlier().empty());
  EXPECT_TRUE(session_->recording().isTouched());
}

TEST_F(PlayBarTest, LeavesSpaceToWhatHasTheFocus)
{
  usePath();
  int pressed = 0;
  auto* button = window_->findChild<QPushButton*>("pressButton");
  QObject::connect(button, &QPushButton::clicked, [&] { ++pressed; });
  button->setFocus();
  QTest::keyClick(button, Qt::Key_Space);
  EXPECT_EQ(pressed, 1);
  EXPECT_EQ(window_->findChild<QAction*>("playAction")->iconText(), "Pause") << "it plays on";
  auto* place = window_->findChild<QLineEdit*>("pressPlace");
  place->setFocus();
  QTest::keyClicks(place, "1.5, 2");
  EXPECT_EQ(place->text(), "1.5, 2");
}

} // namespace
} // namespace palp
