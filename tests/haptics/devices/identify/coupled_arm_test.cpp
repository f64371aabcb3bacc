// An arm whose axes are coupled by its three bodies: an encoder that dies is one of three.

#include "haptics/devices/identify/unlike_axis.h"
#include "haptics/error.h"
#include "tests/haptics/devices/identify/coupled_arm.h"

#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

std::string refusalOf(test::CoupledArm& arm)
{
  try
  {
    (void)arm.identify();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

TEST(IdentifyCoupled, ADeadEncoderEndsThePushBeforeTheArmGoesFar)
{
  for (const double friction : { 1e-3, 5e-3 })
  {
    for (const int dead : { 0, 1, 2 })
    {
      for (const double dies : { 1.6, 3.0, 5.0, 9.0, 14.0, 22.0 })
      {
        test::CoupledArm arm;
        arm.friction.setConstant(friction);
        arm.dead = dead;
        arm.dies = dies;
        const std::string what = refusalOf(arm);
        EXPECT_NE(what.find("encoder"), std::string::npos)
          << dead << " at " << dies << ": " << what;
        EXPECT_LE(arm.unseen, 0.1) << dead << " at " << dies;
        EXPECT_EQ(arm.told.norm(), 0.0);
      }
    }
  }
}

TEST(IdentifyCoupled, AnEncoderThatNeverCountsIsNamed)
{
  for (const int dead : { 0, 1, 2 })
  {
    test::CoupledArm arm;
    arm.dead = dead;
    EXPECT_NE(refusalOf(arm).find("encoder"), std::string::npos) << dead;
    EXPECT_LE(arm.unseen, 0.12);
  }
}

TEST(IdentifyCoupled, WithoutJointsADeadEncoderLeavesMotionInOnePlane)
{
  for (const int dead : { 1, 2 })
  {
    test::CoupledArm arm;
    arm.dead = dead;
    const auto exchange = [&arm](const Eigen::Vector3d& force) -> std::optional<ArmPosition>
    {
      ArmPosition now = arm.exchange(force);
      now.joints.reset();
      return now;
    };
    try
    {
      (void)identifyArm(exchange, 54e-6);
      ADD_FAILURE() << "measured";
    }
    catch (const Error& error)
    {
      EXPECT_NE(std::string(error.what()).find("one plane"), std::string::npos) << error.what();
    }
  }
}

TEST(IdentifyCoupled, ASoundArmIsMeasured)
{
  for (const char* name : { "v2015", "polhem", "aluhaptics" })
  {
    for (const double friction : { 1e-3, 4e-3, 8e-3 })
    {
      for (const double damping : { 0.004, 0.012, 0.03 })
      {
        test::CoupledArm arm(*publishedArm(name));
        arm.friction.setConstant(friction);
        arm.damping.setConstant(damping);
        const IdentifiedArm found = arm.identify();
        EXPECT_TRUE(found.agrees()) << name;
        EXPECT_EQ(found.late, 0.0) << name;
        EXPECT_EQ(unlikeAxis(found), "") << name;
        // of a push along one axis that leaves the others free; half of what is let pass comes of
        // the arm's shape, which changes over a swing of 10 mm
        const Eigen::Vector3d mass = arm.mass().inverse().diagonal().cwiseInverse();
        const Eigen::Vector3d viscous = arm.dampingOfHandle().inverse().diagonal().cwiseInverse();
        for (int axis = 0; axis < 3; ++axis)
        {
          const ArmAxis& one = found.axes[static_cast<std::size_t>(axis)];
          EXPECT_NEAR(one.mass, mass[axis], 0.10 * mass[axis]) << name << axis;
          EXPECT_NEAR(one.damping, viscous[axis], std::max(0.22 * viscous[axis], 0.02))
            << name << axis;
        }
      }
    }
  }
}

// threads that have to wait for others, before a force goes out or with an answer in hand
class BusyComputer
{
public:
  BusyComputer(test::CoupledArm& arm, double every, double longest)
    : arm_(arm)
    , next_(1.0 / every)
    , longest_(longest)
  {
  }

  ArmPosition exchange(const Eigen::Vector3d& force)
  {
    const double sent = arm_.time;
    const bool holdsAnswer = random_() % 2 == 0;
    const double wait = pause();
    arm_.wait(holdsAnswer ? 0.0 : wait);
    ArmPosition now = arm_.exchange(force);
    arm_.wait(holdsAnswer ? wait : 0.0);
    now.sent = sent;
    now.time = arm_.time;
    return now;
  }

private:
  double pause()
  {
    if (arm_.time < until_)
    {
      return 0.0;
    }
    until_ = arm_.time + next_(random_);
    return std::uniform_real_distribution<double>(0.5e-3, longest_)(random_);
  }

  test::CoupledArm& arm_;
  std::exponential_distribution<double> next_; // [s]
  double longest_;                             // [s]
  double until_ = 0.0;
  std::mt19937 random_{ 5 };
};

// such times are not measured with, and where too few are left or figures may be off, it is said
TEST(IdentifyCoupled, AComputerThatIsLateBlamesNoEncoderAndSaysSo)
{
  struct Busy
  {
    double every;   // [s]
    double longest; // [s]
  };
  for (const Busy& busy : { Busy{ 1.0, 0.04 }, Busy{ 0.3, 0.02 }, Busy{ 0.1, 0.04 },
         Busy{ 0.1, 0.01 }, Busy{ 0.03, 0.004 } })
  {
    for (const double damping : { 0.004, 0.03 })
    {
      test::CoupledArm arm;
      arm.damping.setConstant(damping);
      BusyComputer computer(arm, busy.every, busy.longest);
      try
      {
        const IdentifiedArm found = identifyArm(
          [&](const Eigen::Vector3d& force) { return computer.exchange(force); }, 54e-6);
        EXPECT_TRUE(found.agrees());
        EXPECT_GT(found.late, busy.every < 0.5 ? 0.002 : 0.0) << busy.every;
        const Eigen::Vector3d mass = arm.mass().inverse().diagonal().cwiseInverse();
        for (int axis = 0; axis < 3; ++axis)
        {
          const double one = found.axes[static_cast<std::size_t>(axis)].mass;
          EXPECT_NEAR(one, mass[axis], 0.15 * mass[axis]) << busy.every << " " << axis;
        }
      }
      catch (const Error& error)
      {
        EXPECT_NE(std::string(error.what()).find("late in"), std::string::npos) << error.what();
        EXPECT_LT(busy.every, 0.2);
      }
    }
  }
}

TEST(IdentifyCoupled, AnAxisThatNoArmHasIsNamed)
{
  IdentifiedArm arm;
  arm.axes = { ArmAxis{ 0.2, 0.3, 0.04, 1.0 }, ArmAxis{ 0.02, 0.03, 0.04, 1.0 },
    ArmAxis{ 0.25, 0.3, 0.04, 1.0 } };
  EXPECT_NE(
    unlikeAxis(arm).find("along y the arm is more than six times as light"), std::string::npos);
  arm.axes[1].mass = 2.2;
  EXPECT_NE(
    unlikeAxis(arm).find("along y the arm is more than six times as heavy"), std::string::npos);
  arm.axes[1].mass = 0.05;
  EXPECT_EQ(unlikeAxis(arm), "");
}

} // namespace
} // namespace palp
