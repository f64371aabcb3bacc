#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/units.h"
#include "tests/app/window/play_rig.h"

#include <QElapsedTimer>
#include <QMenu>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using ReviewTest = test::PlayBarTest;

TEST_F(ReviewTest, ShowsARecordingAgainWhileTheToolRests)
{
  record();
  const std::vector<Sample> samples = session_->recording().samples;
  trigger("reviewAction");
  key(Qt::Key_Space);
  EXPECT_TRUE(bar()->isVisible());
  EXPECT_TRUE(label("playedWhat").contains("not live"));
  const auto first =
    std::ranges::find_if(samples, [](const Sample& sample) { return sample.contact.touching(); });
  const double begin = std::prev(first)->time;
  double deepest = 0.0;
  for (int part = 1; part < 10; ++part)
  {
    const int ms = part * slider()->maximum() / 10;
    slider()->setValue(ms);
    const Sample& known = *std::ranges::min_element(
      samples, {}, [&](const Sample& sample) { return std::abs(sample.time - begin - 1e-3 * ms); });
    if (!known.contact.touching())
    {
      continue;
    }
    const double depth = units::toMillimeters(known.contact.depth);
    const QString force = QString::number(known.response.force, 'f', 2) + " N";
    EXPECT_TRUE(QTest::qWaitFor([&] { return readings().contains(force); }, kPatience)) << part;
    EXPECT_NEAR(depthShown(), depth, 0.051) << part;
    EXPECT_FALSE(session_->newest().contact.touching()) << "live";
    deepest = std::max(deepest, depth);
  }
  EXPECT_GT(deepest, 3.5);
  EXPECT_TRUE(label("rendered").contains("0.00 N")) << "the device, live";
}

TEST_F(ReviewTest, PlaysARecordingAsFastAsAskedToItsEnd)
{
  record();
  trigger("reviewAction");
  setSpeed(0.1);
  QElapsedTimer waited;
  const auto goesOn = [&] // to the next hundredth that it tells
  {
    const double told = time();
    EXPECT_TRUE(QTest::qWaitFor([&] { return time() > told; }, kPatience));
    return 1e-3 * static_cast<double>(waited.elapsed());
  };
  waited.start();
  constexpr std::size_t kHalf = 10;       // hundredths
  std::array<double, 2> late{ 1e9, 1e9 }; // [s] the least of each half: pictures may take long
  for (std::size_t i = 0; i < 2 * kHalf; ++i)
  {
    const double now = goesOn();
    late[i / kHalf] = std::min(late[i / kHalf], now - time() / 0.1);
  }
  EXPECT_NEAR(late[1], late[0], 0.1) << "in a second";
  setSpeed(4.0);
  const double length = 1e-3 * slider()->maximum();
  const auto* play = window_->findChild<QAction*>("playAction");
  EXPECT_TRUE(QTest::qWaitFor([&] { return play->iconText() == "Play"; }, kPatience));
  EXPECT_NEAR(time(), length, 0.006);
}

TEST_F(ReviewTest, EscapeAndAPressEndTheReview)
{
  record();
  trigger("reviewAction");
  key(Qt::Key_Space); // it would play past the press where pictures take long
  slider()->setValue(slider()->maximum() / 2);
  EXPECT_TRUE(QTest::qWaitFor([this] { return depthShown() > 0.5; }, kPatience));
  key(Qt::Key_Escape);
  EXPECT_TRUE(waitForNoBar());
  EXPECT_TRUE(QTest::qWaitFor([this] { return !label("force").startsWith("Force"); }, kPatience))
    << "live again";

  trigger("reviewAction");
  EXPECT_TRUE(bar()->isVisible());
  const QSize canvas = canvas_->size();
  press(100);
  EXPECT_EQ(canvas_->size(), canvas) << "the surface stays under the pointer";
  EXPECT_TRUE(label("playedWhat").contains("Live"));
  EXPECT_TRUE(waitForDepthShown(6.0)); // 1 mm, and 0.05 mm for each pixel
  release();
  EXPECT_TRUE(waitForNoBar());
}

// with its own body and tool; then the present ones are back
TEST_F(ReviewTest, ShowsAnEarlierRecordingAsItWas)
{
  record();
  ASSERT_TRUE(window_->openFile(PALP_SHARE "/meshes/sphere_50.vtp"));
  window_->findChild<QComboBox*>("kind")->setCurrentText("Cone");
  ASSERT_EQ(session_->earlier().size(), 1U);
  auto* takes = window_->findChild<QMenu*>("earlierTakes");
  Q_EMIT takes->aboutToShow();
  ASSERT_EQ(takes->actions().size(), 1);
  EXPECT_TRUE(takes->actions().front()->text().contains("block_50.vtp, sphere:10mm"))
    << takes->actions().front()->text().toStdString();
  takes->actions().front()->trigger();
  key(Qt::Key_Space);

  const Session::Take& take = session_->earlier().front();
  const Sample deepest = *take.recording.deepest();
  const auto first = std::ranges::find_if(
    take.recording.samples, [](const Sample& sample) { return sample.contact.touching(); });
  slider()->setValue(static_cast<int>(1e3 * (deepest.time - std::prev(first)->time)));
  EXPECT_TRUE(waitForDepthShown(units::toMillimeters(deepest.contact.depth)));
  const QString picture = QString::fromStdString((folder_.path() / "a.png").string());
  EXPECT_TRUE(window_->saveFigure(picture, { .width = 300, .height = 200 }, {}));
  window_->findChild<QComboBox*>("kind")->setCurrentText("Flat punch");
  EXPECT_TRUE(waitForNoBar()) << "another tool is live";
  EXPECT_EQ(session_->body().name, "sphere_50.vtp");
  press(60);
  EXPECT_TRUE(session_->newest().contact.touching());
  release();
}

TEST_F(ReviewTest, AReviewPausesThePathWhichThenGoesOn)
{
  usePath();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return session_->newest().contact.depth > 2.0_mm; }, kPatience));
  const auto loops = [this]
  {
    for (const auto* button : bar()->findChildren<QToolButton*>())
    {
      if (button->text() == "Loop")
      {
        return button->isChecked();
      }
    }
    return false;
  };
  key(Qt::Key_L);
  EXPECT_TRUE(loops());
  trigger("reviewAction");
  EXPECT_FALSE(loops()) << "each has its own";
  waitForRest();
  const double at = session_->scripted()->reached();
  EXPECT_TRUE(label("playedWhat").contains("not live"));
  const std::size_t recorded = session_->recording().samples.size();
  EXPECT_TRUE(QTest::qWaitFor(
    [&] { return session_->recording().samples.size() > recorded + 20; }, kPatience))
    << "of the contact that it rests in";
  EXPECT_EQ(session_->scripted()->reached(), at);
  key(Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor([this] { return label("playedWhat").contains("Path"); }, kPatience));
  EXPECT_NEAR(time(), at, 0.0051);
  EXPECT_TRUE(loops());
  key(Qt::Key_Space);
  EXPECT_TRUE(QTest::qWaitFor([&] { return session_->scripted()->reached() > at; }, kPatience));
}

} // namespace
} // namespace palp
