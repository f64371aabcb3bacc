#include "app/session/device_words.h"
#include "tests/app/window/window_rig.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <tuple>

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
  std::atomic<double> depth = -5e-3; // that it goes to [m]
  std::atomic<double> force = 0.0;   // last told [N]
  Eigen::Vector3d top;               // of the body [m]
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
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double) noexcept override
  {
    arm_.force = force.norm();
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

} // namespace
} // namespace palp
