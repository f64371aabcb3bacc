#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/devices/families/made_up_drd.h"
#include "tests/haptics/devices/families/one_sentence.h"
#include "tests/haptics/felt_tissue.h"

#include <Eigen/Geometry>
#include <cmath>
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

const std::string kName = std::string("forcedimension:") + PALP_MADE_UP_DRD;

class ForceDimension : public ::testing::Test
{
protected:
  void SetUp() override
  {
    void* file = dlopen(PALP_MADE_UP_DRD, RTLD_NOW);
    ASSERT_NE(file, nullptr) << dlerror();
    arm_ = reinterpret_cast<DrdArm* (*)()>(dlsym(file, "drdArm"))();
    *arm_ = DrdArm{};
  }

  DrdArm* arm_ = nullptr;
  DriverSample sample_;
};

TEST_F(ForceDimension, PushesOnceItsPoleWasInItsPit)
{
  const auto driver = openDriver(kName);
  EXPECT_TRUE(arm_->open && arm_->forceOn);
  EXPECT_EQ(arm_->watchdog, 160);
  for (int i = 0; i < 5; ++i)
  {
    ASSERT_EQ(driver->tick(Vector3d(1, 2, 3), 1.0_ms, sample_), IoCode::Ok);
    ASSERT_EQ(arm_->force[2], 0.0);
    ASSERT_EQ(*sample_.sent, Vector3d::Zero());
    ASSERT_FALSE(sample_.homed);
  }
  arm_->initialized = true;
  (void)driver->tick(Vector3d(1, 2, 3), 1.0_ms, sample_);
  (void)driver->tick(Vector3d(1, 2, 3), 1.0_ms, sample_);
  // right is its y, away from the user against its x
  EXPECT_EQ(Vector3d(arm_->force[0], arm_->force[1], arm_->force[2]), Vector3d(-2, 1, 3));
  EXPECT_EQ(*sample_.sent, Vector3d(1, 2, 3));
  EXPECT_EQ(driver->limits().model, "Force Dimension omega.7");
  EXPECT_EQ(sample_.buttons, 1U);
  (void)driver->tick(Vector3d(0, std::nan(""), 0), 1.0_ms, sample_);
  EXPECT_EQ(arm_->force[0], 0.0);
}

// by work: a push along a way is one whatever the frames are called
TEST_F(ForceDimension, PlaceAndForceAreInOneFrame)
{
  arm_->initialized = true;
  const auto driver = openDriver(kName);
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample_);
  const Vector3d before = sample_.position;
  const Vector3d way(0.01, -0.02, 0.03);
  std::copy_n(way.data(), 3, arm_->place);
  (void)driver->tick(Vector3d(0.4, 0.5, -0.6), 1.0_ms, sample_);
  const Vector3d told(arm_->force[0], arm_->force[1], arm_->force[2]);
  EXPECT_NEAR(told.dot(way), Vector3d(0.4, 0.5, -0.6).dot(sample_.position - before), 1e-12);
  EXPECT_NEAR(sample_.position.z(), 0.03, 1e-12);
  EXPECT_NEAR(sample_.position.x(), -0.02, 1e-12); // its y is to the right
}

// by work, as a force: a torque through a turn is one whatever the frames are called; an arm whose
// wrist has no motors, or that was not homed, gets none
TEST_F(ForceDimension, TorqueAndTurnAreInOneFrame)
{
  arm_->name = "sigma.7";
  arm_->initialized = true;
  const Vector3d torque(0.02, -0.05, 0.03);
  const auto told = [&] { return Vector3d(arm_->torque[0], arm_->torque[1], arm_->torque[2]); };
  EXPECT_EQ(openDriver(kName)->limits().maxTorque, 0.0);
  {
    const auto passive = openDriver(kName);
    (void)passive->tick(Vector3d::Zero(), 1.0_ms, sample_);
    (void)passive->tick({ Vector3d::Zero(), torque }, 1.0_ms, sample_);
    EXPECT_EQ(told(), Vector3d::Zero());
  }
  arm_->hasActiveWrist = true;
  const auto driver = openDriver(kName);
  EXPECT_EQ(driver->limits().maxTorque, 0.2); // of CDeltaDevices.cpp
  EXPECT_LT(driver->limits().maxAngularStiffness, 1.0);
  (void)driver->tick({ Vector3d::Zero(), torque }, 1.0_ms, sample_);
  EXPECT_EQ(told(), Vector3d::Zero()) << "before it has said that it is homed";
  const Eigen::Quaterniond before = sample_.orientation;
  const Vector3d way = 1e-6 * Vector3d(1.0, 2.0, -0.5); // its own frame turns so
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(way.norm(), way.normalized()).toRotationMatrix();
  for (int i = 0; i < 9; ++i)
  {
    arm_->frame[i / 3][i % 3] = turn(i / 3, i % 3);
  }
  (void)driver->tick({ Vector3d::Zero(), torque }, 1.0_ms, sample_);
  const Eigen::Quaterniond turned = sample_.orientation * before.inverse();
  EXPECT_NEAR(told().dot(way), torque.dot(2.0 * turned.vec()), 1e-3 * torque.norm() * way.norm());
  (void)driver->tick({ Vector3d(0, 0, 1), Vector3d(0, std::nan(""), 0) }, 1.0_ms, sample_);
  EXPECT_EQ(told(), Vector3d::Zero());
  EXPECT_EQ(arm_->force[2], 0.0);
}

// theirs: x to the user, along a pen that is held level; y right, z up
TEST_F(ForceDimension, ItsPenPointsWhereTheToolDoes)
{
  const auto driver = openDriver(kName);
  const auto axisAfter = [&](double angle, const Vector3d& about)
  {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, about).toRotationMatrix();
    for (int i = 0; i < 9; ++i)
    {
      arm_->frame[i / 3][i % 3] = turn(i / 3, i % 3);
    }
    (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample_);
    return Vector3d(sample_.orientation * -Vector3d::UnitZ()); // right, away, up
  };
  EXPECT_LT((axisAfter(0.0, Vector3d::UnitX()) - Vector3d(0, 1, 0)).norm(), 1e-9);
  EXPECT_LT((axisAfter(0.3, Vector3d::UnitX()) - Vector3d(0, 1, 0)).norm(), 1e-9) << "rolled";
  // its handle goes up, or to the right, and so its tip the other way
  const Vector3d down(0, std::cos(0.3), -std::sin(0.3));
  EXPECT_LT((axisAfter(-0.3, Vector3d::UnitY()) - down).norm(), 1e-9);
  const Vector3d left(-std::sin(0.3), std::cos(0.3), 0);
  EXPECT_LT((axisAfter(0.3, Vector3d::UnitZ()) - left).norm(), 1e-9);
}

// which its library tells by a frame that never turns
TEST_F(ForceDimension, WithoutAWristTheToolStandsUpright)
{
  arm_->hasWrist = false;
  const auto driver = openDriver(kName);
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample_);
  EXPECT_LT(sample_.orientation.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
}

// as their own CDeltaDevices.cpp of CHAI3D has them; an arm that it does not name gets less
TEST_F(ForceDimension, HasTheForceAndReachThatItsMakersState)
{
  struct Arm
  {
    const char* name;
    double newtons;
    double millimeters;
  };
  for (const auto& [name, newtons, millimeters] :
    { Arm{ "omega.3", 12, 75 }, Arm{ "omega.7", 12, 75 }, Arm{ "sigma.7", 12, 75 },
      Arm{ "delta.3", 20, 150 }, Arm{ "delta.6", 20, 150 }, Arm{ "prototype", 8, 0 } })
  {
    arm_->name = name;
    const DeviceLimits limits = openDriver(kName)->limits();
    EXPECT_EQ(limits.maxForce, newtons) << name;
    EXPECT_NEAR(limits.workspaceRadius, 1e-3 * millimeters, 1e-12) << name;
    expectTissuesToBeToldApart(limits);
  }
}

TEST_F(ForceDimension, TellsWhatItsMotorsCouldNot)
{
  arm_->initialized = true;
  const auto driver = openDriver(kName);
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample_);
  (void)driver->tick(Vector3d(0, 0, 20), 1.0_ms, sample_);
  EXPECT_EQ(*sample_.sent, Vector3d(0, 0, 10));
}

TEST_F(ForceDimension, ItsEndIsToldAndLeavesNoForce)
{
  arm_->initialized = true;
  {
    const auto driver = openDriver(kName);
    (void)driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample_);
    (void)driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample_);
    EXPECT_EQ(arm_->force[2], 1.0);
    for (const double nowhere : { std::nan(""), 1e6 })
    {
      arm_->place[0] = nowhere;
      EXPECT_EQ(driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample_), IoCode::Timeout);
    }
    arm_->place[0] = 0.0;
    arm_->frame[1][2] = std::nan("");
    EXPECT_EQ(driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample_), IoCode::Timeout);
    arm_->frame[1][2] = 0.0;
    arm_->there = false;
    EXPECT_EQ(driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample_), IoCode::Gone);
    arm_->there = true;
  }
  EXPECT_EQ(arm_->force[2], 0.0);
  EXPECT_FALSE(arm_->open || arm_->forceOn);
}

TEST_F(ForceDimension, IsNotOpenedWhereItsMotorsStayOff)
{
  arm_->enables = false;
  test::expectRefusedInOneSentence(kName);
  EXPECT_FALSE(arm_->open);
  arm_->enables = true;
}

TEST_F(ForceDimension, SaysInOneSentenceWhatIsMissing)
{
  arm_->there = false;
  for (const auto& [name, advice] :
    { std::pair(kName, "switch it on"), { std::string("forcedimension"), "install" },
      { std::string("forcedimension:/nowhere.so"), "install" },
      { std::string("forcedimension:libm.so.6"), "lacks drdOpen" } })
  {
    try
    {
      (void)openDriver(name);
      ADD_FAILURE() << name;
    }
    catch (const Error& error)
    {
      const std::string what = error.what();
      EXPECT_EQ(error.code(), ErrorCode::NoDevice);
      EXPECT_NE(what.find(advice), what.npos) << what;
      EXPECT_EQ(what.find('\n'), what.npos) << what;
    }
  }
}

} // namespace
} // namespace palp
