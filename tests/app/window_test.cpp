#include "app/window.h"

#include "app/device_words.h"
#include "app/ledger.h"
#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QImage>
#include <QLabel>
#include <QSurfaceFormat>
#include <QTest>
#include <QVTKOpenGLNativeWidget.h>

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

/// One application for all tests; a missing display is a failure, not a skip.
QApplication& application()
{
  static int count = 1;
  static char name[] = "window_test";
  static char* words[] = { name, nullptr };
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  static QApplication instance(count, words);
  return instance;
}

class WindowTest : public ::testing::Test
{
protected:
  WindowTest()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
    application();
    session_ = std::make_unique<Session>(ScenePlan{}, silent_);
    window_ = std::make_unique<Window>(*session_, silent_);
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    QApplication::setActiveWindow(window_.get()); // no window manager does it here
    canvas_ = window_->findChild<QVTKOpenGLNativeWidget*>("canvas");
    EXPECT_TRUE(canvas_->isValid()) << "no OpenGL context";
    QTest::qWait(500);
  }

  // the pointer goes down in the middle of the liver and drags, until the tool rests
  void press(int pixelsDown)
  {
    const QPoint middle = canvas_->rect().center();
    QTest::mouseMove(canvas_, middle);
    QTest::qWait(100);
    QTest::mousePress(canvas_, Qt::LeftButton, {}, middle);
    QTest::mouseMove(canvas_, middle + QPoint(0, pixelsDown));
    const auto rests = [this]
    {
      const Sample sample = session_->newest();
      return sample.contact.touching() && sample.pose.velocity.norm() < 1e-5;
    };
    EXPECT_TRUE(QTest::qWaitFor(rests, kPatience));
  }

  void release()
  {
    QTest::mouseRelease(canvas_, Qt::LeftButton);
  }

  // the largest force that any sample so far has
  [[nodiscard]] double peakForce()
  {
    double peak = 0.0;
    for (const Sample& sample : session_->recording().samples)
    {
      peak = std::max(peak, sample.response.force);
    }
    return peak;
  }

  static constexpr int kPatience = 10'000; // [ms], for a machine that does much else

  test::TemporaryFolder folder_;
  Ledger silent_{ false };
  std::unique_ptr<Session> session_;
  std::unique_ptr<Window> window_;
  QVTKOpenGLNativeWidget* canvas_ = nullptr;
};

TEST_F(WindowTest, PressesAsDeepAsTheDrag)
{
  press(100);
  const Contact contact = session_->newest().contact;
  EXPECT_NEAR(contact.depth, 100 * 0.05e-3, 0.3e-3); // the pointer's surface is made of facets
  EXPECT_NEAR(session_->newest().response.force,
    session_->recording().scene.law({ .depth = contact.depth }).force, 1e-9);
  const QString status = window_->findChild<QLabel*>("force")->text();
  EXPECT_TRUE(status.contains("N") && status.contains("mm")) << status.toStdString();
  release();
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return !session_->newest().contact.touching(); }, kPatience));
}

TEST_F(WindowTest, HoveringNeverTouches)
{
  for (const QPoint place : { QPoint(-150, 0), QPoint(120, -30), QPoint(0, 60), QPoint(-60, -60) })
  {
    QTest::mouseMove(canvas_, canvas_->rect().center() + place);
    QTest::qWait(150);
  }
  EXPECT_EQ(peakForce(), 0.0);
}

TEST_F(WindowTest, AStifferTissuePushesBackHarder)
{
  press(100);
  const double soft = session_->newest().response.force;
  window_->findChild<QDoubleSpinBox*>("young")->setValue(100.0);
  EXPECT_TRUE(QTest::qWaitFor([&]
    { return std::abs(session_->newest().response.force - 2.0 * soft) < 0.01 * soft; },
    kPatience));
  release();
}

TEST_F(WindowTest, TakesAnotherTool)
{
  window_->findChild<QComboBox*>("kind")->setCurrentIndex(1);
  EXPECT_TRUE(std::holds_alternative<ConeTip>(session_->recording().scene.law.tip()));
}

TEST_F(WindowTest, TheSimulatedHandYieldsToTheForceUntilItIsStopped)
{
  window_->findChild<QComboBox*>("device")->setCurrentText("hand");
  press(300);
  const Sample felt = session_->newest();
  EXPECT_GT(felt.contact.depth, 0.5e-3);
  EXPECT_LT(felt.contact.depth, 13e-3); // asked for 15 mm
  EXPECT_GT(felt.force.norm(), 0.1) << describe(felt.state) << ": " << describeFlags(felt.flags);

  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return session_->newest().force.norm() == 0.0; }, kPatience));
  EXPECT_FALSE(session_->armed());
  release();
}

TEST_F(WindowTest, NamesTheRulesThatADeepPressBreaks)
{
  press(180); // 9 mm with a tool of 10 mm radius
  const auto* rules = window_->findChild<QLabel*>("rules");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("depth"); }, kPatience))
    << rules->text().toStdString();
  release();
  EXPECT_TRUE(QTest::qWaitFor([&] { return rules->text().contains("no contact"); }, kPatience));
}

TEST_F(WindowTest, SavesAScreenshotOfTheDent)
{
  const QString file = QString::fromStdString((folder_.path() / "shot.png").string());
  press(160);
  ASSERT_TRUE(window_->saveScreenshot(file));
  release();
  const QImage image(file);
  ASSERT_FALSE(image.isNull());
  std::set<QRgb> colors;
  for (int y = 0; y < image.height(); y += 2)
  {
    for (int x = 0; x < image.width(); x += 2)
    {
      colors.insert(image.pixel(x, y));
    }
  }
  EXPECT_GT(colors.size(), 500u);
}

TEST_F(WindowTest, ExportsWhatWasMeasured)
{
  press(100);
  release();
  QTest::qWait(200);
  ASSERT_TRUE(window_->exportData(QString::fromStdString(folder_.path().string())));
  const test::CsvTable samples = test::readCsv(folder_.path() / "samples.csv");
  const auto& force = samples["force_N"];
  ASSERT_GT(force.size(), 500u);
  EXPECT_NEAR(*std::max_element(force.begin(), force.end()), peakForce(), 1e-12);
  EXPECT_GT(peakForce(), 1.0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "deformed.vtp"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "servo.csv"));
}

TEST_F(WindowTest, OpensAnotherSurface)
{
  ASSERT_TRUE(window_->openSurface(PALP_SHARE "/meshes/sphere_50.vtp", "auto"));
  EXPECT_EQ(session_->body().name, "sphere_50.vtp");
  EXPECT_TRUE(window_->windowTitle().contains("sphere_50.vtp"));
  press(100);
  EXPECT_NEAR(session_->newest().contact.depth, 5e-3, 0.3e-3);
  release();
}

} // namespace
} // namespace palp
