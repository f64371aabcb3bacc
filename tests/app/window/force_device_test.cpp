#include "app/session/device_words.h"
#include "tests/app/window/window_rig.h"

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vtkCamera.h>

namespace palp
{
namespace
{

using test::WindowTest;

TEST_F(WindowTest, TheSimulatedHandYieldsToTheForceUntilItIsStopped)
{
  window_->findChild<QComboBox*>("device")->setCurrentText("hand");
  const Sample felt = pressWithForce(300);
  EXPECT_GT(felt.contact.depth, 0.5e-3);
  EXPECT_LT(felt.contact.depth, 14e-3) << describeFlags(felt.flags); // asked for 16 mm
  EXPECT_GT(felt.force.norm(), 0.1) << describe(felt.state) << ": " << describeFlags(felt.flags);

  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_TRUE(
    QTest::qWaitFor([this] { return session_->newest().force.norm() == 0.0; }, kPatience));
  EXPECT_FALSE(session_->armed());
  release();
}

TEST_F(WindowTest, ShowsThatTheHandFeelsLessThanTheLawAsksForAndWhy)
{
  window_->findChild<QComboBox*>("device")->setCurrentText("hand");
  type("young", "1GPa");
  const auto* limits = window_->findChild<QLabel*>("limits");
  bool told = false;
  std::ignore = pressWithForce(100);
  EXPECT_TRUE(QTest::qWaitFor(
    [&] { return told = told || limits->text().contains("stiffness limited"); }, kPatience))
    << limits->text().toStdString();
  const QString force = window_->findChild<QLabel*>("rendered")->text();
  EXPECT_TRUE(force.contains("model") && force.contains("sent")) << force.toStdString();
  release();
}

// an arm that a test plugs in and out, kept beyond the life of the session
struct MadeUpArm
{
  std::atomic<bool> plugged = true;
  std::atomic<bool> homed = false;
  std::atomic<double> depth = -5e-3;     // that it goes to [m]
  std::atomic<double> force = 0.0;       // last told [N]
  Eigen::Vector3d top;                   // of the body [m]
  std::optional<DevicePlacement> placed; // last; read while no servo uses it
  std::atomic<bool> held = false;        // by its clutch, without a button
};

class MadeUpDevice final : public Device
{
public:
  explicit MadeUpDevice(MadeUpArm& arm)
    : arm_(arm)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return {
      .model = "made up", .rendersForce = true, .needsHoming = true, .maxForce = 3.0, .damping = 1.0
    };
  }
  [[nodiscard]] bool place(const DevicePlacement& placement) override
  {
    arm_.placed = placement;
    return true;
  }
  void hold(bool held) noexcept override
  {
    arm_.held = held;
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double) noexcept override
  {
    arm_.force = wrench.force.norm();
    depth_ += std::clamp(arm_.depth - depth_, -1e-4, 1e-4);
    const ToolPose pose{ .apex = arm_.top - depth_ * Eigen::Vector3d::UnitZ() };
    return arm_.plugged ? std::optional(pose) : std::nullopt;
  }
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return { .homed = arm_.homed };
  }

private:
  MadeUpArm& arm_;
  double depth_ = -5e-3; // [m]
};

class DeviceTest : public WindowTest
{
protected:
  DeviceTest()
  {
    const auto points = session_->body().haptic->points();
    arm_.top = *std::max_element(points.begin(), points.end(),
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.z() < b.z(); });
    session_->useDevice({ .name = "made up" }, std::make_unique<MadeUpDevice>(arm_));
  }
  ~DeviceTest() override // before the arm
  {
    window_.reset();
    session_.reset();
  }

  [[nodiscard]] bool waitForState(const char* words)
  {
    return QTest::qWaitFor([&] { return state_->text().contains(words); }, kPatience);
  }
  void arm()
  {
    QTest::mouseClick(armButton_, Qt::LeftButton);
  }
  // a machine that does much else loses ticks, and then the force has to be asked for again
  void armAndPress()
  {
    const auto pushes = [&] { return arm_.force > 0.5; };
    for (int i = 0; i < kAttempts && !pushes(); ++i)
    {
      arm_.depth = -5e-3;
      const auto isShown = [&] // what the device did
      {
        return !session_->newest().contact.touching() &&
          armButton_->isChecked() == session_->armed();
      };
      (void)QTest::qWaitFor(isShown, kPatience / kAttempts);
      if (!session_->armed())
      {
        arm();
      }
      (void)waitForState("force on");
      arm_.depth = 3e-3;
      (void)QTest::qWaitFor(pushes, kPatience / kAttempts);
    }
    EXPECT_TRUE(pushes());
  }
  [[nodiscard]] bool waitForNoForce()
  {
    return QTest::qWaitFor([&] { return arm_.force == 0.0; }, kPatience);
  }

  MadeUpArm arm_;
  QLabel* state_ = window_->findChild<QLabel*>("state");
  QPushButton* armButton_ = window_->findChild<QPushButton*>("arm");
};

TEST_F(DeviceTest, ThatIsPluggedInAgainIsHomedAndArmedAnew)
{
  EXPECT_TRUE(waitForState("needs homing"));
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();

  arm_.plugged = false;
  EXPECT_TRUE(waitForState("plug it in again"));
  EXPECT_TRUE(waitForNoForce());
  EXPECT_TRUE(QTest::qWaitFor([&] { return !armButton_->isChecked(); }, kPatience));
  arm(); // does not help
  QTest::qWait(200);
  EXPECT_TRUE(waitForState("plug it in again"));

  arm_.homed = false;
  arm_.plugged = true;
  EXPECT_TRUE(waitForState("needs homing"));
  arm_.homed = true;
  EXPECT_TRUE(waitForState("was unplugged")) << "ready, and says why there is no force";
  EXPECT_TRUE(QTest::qWaitFor([&] { return !armButton_->isChecked(); }, kPatience));
  EXPECT_EQ(arm_.force, 0.0);
  armAndPress();
}

TEST_F(DeviceTest, OfASecondHandIsToldOfBesideTheFirstAndDisarmedWithIt)
{
  MadeUpArm other;
  other.top = arm_.top + Eigen::Vector3d(30e-3, 0.0, 20e-3); // in the air
  other.homed = true;
  session_->useSecond({ .name = "also made up" }, std::make_unique<MadeUpDevice>(other));
  EXPECT_TRUE(waitForState("1: "));
  EXPECT_TRUE(waitForState("needs homing"));
  EXPECT_TRUE(state_->text().contains("ready, force off")) << state_->text().toStdString();
  arm_.homed = true;
  armAndPress();
  EXPECT_TRUE(QTest::qWaitFor([&] { return state_->text().count("force on") == 2; }, kPatience));
  EXPECT_TRUE(window_->findChild<QLabel*>("rendered")->text().contains("\n2: model 0.00 N"));
  other.plugged = false;
  EXPECT_TRUE(waitForState("plug it in again"));
  EXPECT_TRUE(waitForNoForce());
  EXPECT_FALSE(session_->armed());
  session_->useSecond(std::nullopt);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !state_->text().contains("2: "); }, kPatience));
}

TEST_F(DeviceTest, IsScaledAndHeldInTheWindow)
{
  auto* scale = window_->findChild<QDoubleSpinBox*>("scale");
  EXPECT_FALSE(scale->isVisibleTo(window_.get())) << "of a device without a place";
  session_->useDevice({ .kind = DeviceChoice::Kind::Driver, .name = "made up" },
    std::make_unique<MadeUpDevice>(arm_));
  EXPECT_TRUE(QTest::qWaitFor([&] { return scale->isVisibleTo(window_.get()); }, kPatience));
  EXPECT_EQ(scale->value(), 1.0);
  scale->setValue(2.5);
  ASSERT_TRUE(arm_.placed);
  EXPECT_EQ(arm_.placed->scale, 2.5);
  EXPECT_EQ(arm_.placed->clutch, 2);

  canvas_->setFocus();
  QTest::keyPress(canvas_, Qt::Key_C);
  EXPECT_TRUE(arm_.held);
  QTest::keyRelease(canvas_, Qt::Key_C);
  EXPECT_FALSE(arm_.held);
  QTest::keyPress(canvas_, Qt::Key_C);
  QApplication::sendEvent(window_.get(), std::make_unique<QEvent>(QEvent::WindowDeactivate).get());
  EXPECT_FALSE(arm_.held);
}

TEST_F(DeviceTest, OfASecondHandIsChosenInTheWindow)
{
  auto* second = window_->findChild<QComboBox*>("second-device");
  EXPECT_FALSE(second->isVisibleTo(window_.get())) << "there is none to choose";
  const QTemporaryDir folder;
  const std::string file = folder.filePath("right.csv").toStdString();
  std::ofstream(file) << "time_s,x_mm,y_mm,z_mm\n0,0,0,500\n60,0,0,500\n";
  second->addItem(QString::fromStdString("path:" + file));
  second->setCurrentIndex(1);
  EXPECT_TRUE(session_->hasSecond());
  EXPECT_TRUE(second->isVisibleTo(window_.get()));
  second->setCurrentIndex(0);
  EXPECT_FALSE(session_->hasSecond());
  EXPECT_EQ(second->currentText(), "none");
}

TEST_F(DeviceTest, IsStoppedByTheButtonUntilArmedAnew)
{
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();
  QTest::mouseClick(window_->findChild<QPushButton*>("stop"), Qt::LeftButton);
  EXPECT_TRUE(waitForNoForce());
  EXPECT_TRUE(waitForState("stopped"));
  EXPECT_FALSE(session_->armed());
  armAndPress();
}

TEST_F(DeviceTest, IsLeftWithoutForceWhenTheWindowCloses)
{
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();
  window_.reset();
  session_.reset();
  EXPECT_EQ(arm_.force, 0.0);
}

TEST_F(DeviceTest, IsTurnedToTheViewAndHasNoForceUntilArmedAnew)
{
  session_->useDevice({ .kind = DeviceChoice::Kind::Driver, .name = "made up" },
    std::make_unique<MadeUpDevice>(arm_));
  arm_.homed = true;
  EXPECT_TRUE(waitForState("ready, force off"));
  armAndPress();
  vtkRenderer& renderer = *canvas_->renderWindow()->GetRenderers()->GetFirstRenderer();
  renderer.GetActiveCamera()->Azimuth(70.0);
  renderer.GetActiveCamera()->Elevation(20.0);
  window_->findChild<QAction*>("turn-device")->trigger();
  EXPECT_FALSE(session_->armed());
  EXPECT_TRUE(waitForNoForce());
  ASSERT_TRUE(arm_.placed);
  // by the picture itself: right is right, up is up, and away is neither but farther
  const Eigen::Vector3d focus(renderer.GetActiveCamera()->GetFocalPoint());
  const auto seen = [&](int axis)
  {
    const auto display = [&](const Eigen::Vector3d& point)
    {
      renderer.SetWorldPoint(point.x(), point.y(), point.z(), 1.0);
      renderer.WorldToDisplay();
      return Eigen::Vector3d(renderer.GetDisplayPoint());
    };
    return Eigen::Vector3d(
      display(focus + 0.01 * arm_.placed->rotation.col(axis)) - display(focus));
  };
  EXPECT_GT(seen(0).x(), 5.0);
  EXPECT_LT(std::abs(seen(0).y()), 0.01 * seen(0).x());
  EXPECT_GT(seen(2).y(), 5.0);
  EXPECT_LT(std::abs(seen(2).x()), 0.01 * seen(2).y());
  EXPECT_LT(seen(1).head(2).norm(), 0.5);
  EXPECT_GT(seen(1).z(), 0.0);
  EXPECT_NEAR(arm_.placed->rotation.determinant(), 1.0, 1e-9);
  EXPECT_TRUE(waitForState("ready, force off"));
}

TEST_F(WindowTest, AMouseIsNotTurnedToTheView)
{
  Session& session = *session_;
  EXPECT_FALSE(session.turnDevice(Eigen::Matrix3d::Identity()));
  std::ignore = pressWithForce(100);
  release();
}

} // namespace
} // namespace palp
