// Arms that are made up, integrated in steps of 20 us: a mass with viscous and Coulomb friction
// along each axis, that sticks, behind motors which may be wired the wrong way, a bus that delays,
// and an encoder that counts.

#include "haptics/devices/identify/identify.h"

#include "haptics/devices/identify/identified_driver.h"
#include "haptics/error.h"
#include "tests/support/sampled.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <gtest/gtest.h>
#include <memory>
#include <random>

namespace palp
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct MadeUpArm
{
  Vector3d mass = Vector3d::Constant(0.2);      // [kg]
  Vector3d damping = Vector3d::Constant(0.3);   // [N s/m]
  Vector3d friction = Vector3d::Constant(0.04); // [N]
  Matrix3d wiring = Matrix3d::Identity();       // forces at the handle, of those that are told
  double delay = 0.002;                         // from a command to the motors [s]
  double step = 48e-6;                          // [m]
  Vector3d weight = Vector3d::Zero();           // [N]
  double strongest = 0.0;                       // that was told [N]
  double furthest = 0.0;                        // [m]
  double time = 0.0;

  ArmPosition exchange(const Vector3d& told)
  {
    constexpr double kStep = 20e-6;
    strongest = std::max(strongest, told.norm());
    const double sent = time;
    commands_.emplace_back(sent + delay, told);
    for (int i = 0; i < 50; ++i)
    {
      while (!commands_.empty() && commands_.front().first <= time + 1e-9)
      {
        force_ = commands_.front().second;
        commands_.pop_front();
      }
      const Vector3d motors = wiring * force_ + weight;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double drive = motors[axis] - damping[axis] * velocity_[axis];
        const double kick = kStep / mass[axis];
        const double free = velocity_[axis] + kick * drive;
        const double most = kick * friction[axis];
        velocity_[axis] = std::abs(free) <= most ? 0.0 : free - std::copysign(most, free);
      }
      position_ += kStep * velocity_;
      time += kStep;
    }
    furthest = std::max(furthest, position_.cwiseAbs().maxCoeff());
    ArmPosition now{ .position = position_, .time = time, .sent = sent };
    for (int axis = 0; axis < 3 && step > 0.0; ++axis)
    {
      now.position[axis] = step * std::round(position_[axis] / step);
    }
    return now;
  }

  IdentifiedArm identify()
  {
    return identifyArm([this](const Vector3d& force) { return exchange(force); }, step);
  }

private:
  std::deque<std::pair<double, Vector3d>> commands_;
  Vector3d force_ = Vector3d::Zero();
  Vector3d position_ = Vector3d::Zero();
  Vector3d velocity_ = Vector3d::Zero();
};

TEST(Identify, FindsMassDampingFrictionAndDelayOverTheRangeOfArms)
{
  std::mt19937 random(7);
  const auto between = [&random](double low, double high) // evenly in its logarithm
  {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
  };
  int wrong = 0;
  double longest = 0.0;
  test::Sampled samples;
  for (int i = 0; i < 60; ++i)
  {
    MadeUpArm arm;
    for (int axis = 0; axis < 3; ++axis)
    {
      arm.mass[axis] = between(0.05, 1.0);
      arm.damping[axis] = between(0.05, 2.0);
      arm.friction[axis] = between(0.005, 0.15);
    }
    arm.delay = 0.005 * i / 60.0;
    arm.step = i % 4 == 0 ? 0.0 : 25e-6 * (i % 4);
    if (!samples.takes())
    {
      continue;
    }
    const IdentifiedArm found = arm.identify();
    EXPECT_TRUE(found.agrees());
    EXPECT_LE(arm.strongest, 0.3 + 1e-9);
    EXPECT_LE(arm.time, 60.0);
    EXPECT_LE(arm.furthest, 0.045);
    const double isDelay = arm.delay;
    EXPECT_NEAR(found.delay, isDelay, 0.6e-3) << i;
    for (int axis = 0; axis < 3; ++axis)
    {
      const ArmAxis& is = found.axes[static_cast<std::size_t>(axis)];
      const double mass = is.mass / arm.mass[axis];
      const double damping = is.damping / arm.damping[axis];
      const double friction = is.friction / arm.friction[axis];
      // below 0.02 N s/m and 2 mN is less than the other friction of such an arm lets be seen
      const bool good = std::abs(mass - 1.0) < 0.15 &&
        (std::abs(damping - 1.0) < 0.15 || std::abs(is.damping - arm.damping[axis]) < 0.02) &&
        (std::abs(friction - 1.0) < 0.15 || std::abs(is.friction - arm.friction[axis]) < 2e-3);
      wrong += good ? 0 : 1;
      longest = std::max(longest, arm.time);
      EXPECT_TRUE(good) << i << " axis " << axis << ": m " << arm.mass[axis] << " x " << mass
                        << ", b " << arm.damping[axis] << " x " << damping << ", f "
                        << arm.friction[axis] << " x " << friction << ", step " << arm.step
                        << " delay " << arm.delay;
    }
  }
  std::printf("%d of 180 axes beyond 15 %%; at most %.0f s\n", wrong, longest);
}

// all that the signs of three motors can be, before joints that do not stand along the axes
TEST(Identify, NoticesEachOfTheSignsThatMotorsCanHave)
{
  for (const Matrix3d& joints : { Matrix3d(Matrix3d::Identity()),
         (Matrix3d() << 0.0, 0.24, 0.0, 0.21, 0.0, 0.02, 0.03, 0.0, 0.25).finished() })
  {
    int found = 0;
    for (int signs = 0; signs < 8; ++signs)
    {
      const Vector3d motors(signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0);
      MadeUpArm arm;
      arm.wiring = joints.transpose().inverse() * motors.asDiagonal() * joints.transpose();
      const IdentifiedArm is = arm.identify();
      found += is.agrees() == (signs == 0) ? 1 : 0;
      EXPECT_TRUE(signs == 0 || is.axes[0].mass == 0.0);
      EXPECT_LE(arm.strongest, 0.3 + 1e-9);
      EXPECT_LE(arm.furthest, 0.025);
    }
    EXPECT_EQ(found, 8);
  }
}

TEST(Identify, ScaleFollowsFromAKnownMass)
{
  MadeUpArm arm;
  arm.wiring = 0.6 * Matrix3d::Identity(); // pushes less than it is told to
  arm.friction.setConstant(0.01);
  const IdentifiedArm without = arm.identify();
  MadeUpArm heavier;
  heavier.mass = arm.mass + Vector3d::Constant(0.1);
  heavier.friction = arm.friction;
  heavier.wiring = arm.wiring;
  EXPECT_NEAR(forceScale(without, heavier.identify(), 0.1), 0.6, 0.6 * 0.15);
  EXPECT_THROW((void)forceScale(without, without, 0.1), Error);
}

class ToldDriver final : public Driver
{
public:
  explicit ToldDriver(Vector3d& told)
    : told_(told)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "arm", .maxForce = 4.0, .damping = 0.5, .quantum = 54e-6, .delay = 0.001 };
  }
  [[nodiscard]] IoCode tick(const Wrench& wrench, double, DriverSample&) noexcept override
  {
    told_ = wrench.force;
    return IoCode::Ok;
  }

private:
  Vector3d& told_;
};

TEST(Identify, AMeasuredArmHasItsOwnLimitsAndNewtons)
{
  IdentifiedArm arm{ .delay = 0.003, .encoderStep = 20e-6, .scale = 0.5 };
  arm.axes = { ArmAxis{ 0.1, 0.4, 0.03, 1.0 }, ArmAxis{ 0.1, 0.3, 0.03, 1.0 },
    ArmAxis{ 0.1, 0.8, 0.03, 1.0 } };
  Vector3d told = Vector3d::Zero();
  IdentifiedDriver driver(std::make_unique<ToldDriver>(told), arm);
  const DeviceLimits limits = driver.limits();
  EXPECT_DOUBLE_EQ(limits.damping, 0.15); // of its freest axis, in newtons of the hand
  EXPECT_DOUBLE_EQ(limits.friction, 0.015);
  EXPECT_DOUBLE_EQ(limits.mass, 0.05);
  EXPECT_FALSE(limits.unproven);
  EXPECT_DOUBLE_EQ(limits.maxForce, 2.0);
  EXPECT_EQ(limits.quantum, 20e-6);
  EXPECT_EQ(limits.delay, 0.003);
  DriverSample sample;
  (void)driver.tick(Vector3d(0, 0, 1), 0.001, sample);
  EXPECT_EQ(told.z(), 2.0);
}

TEST(Identify, RefusesInOneSentenceWhatCannotBeMeasured)
{
  const auto messageOf = [](MadeUpArm arm)
  {
    try
    {
      (void)arm.identify();
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  MadeUpArm falls;
  falls.weight = Vector3d(0, 0, -0.5);
  EXPECT_NE(messageOf(falls).find("moves by itself"), std::string::npos);
  MadeUpArm sticks;
  sticks.friction = Vector3d(0.4, 0.1, 0.1);
  EXPECT_NE(messageOf(sticks).find("along x"), std::string::npos);
  int exchanges = 0;
  EXPECT_THROW((void)identifyArm(
                 [&exchanges](const Vector3d&)
                 {
                   ++exchanges;
                   return std::optional<ArmPosition>();
                 },
                 1e-5),
    Error);
  EXPECT_LE(exchanges, 2);
}

// encoders that hang or leap, from any moment on: the arm that is pushed meanwhile gets no force
// soon
TEST(Identify, AnEncoderThatHangsOrLeapsEndsThePush)
{
  for (const bool hangs : { true, false })
  {
    for (const double from : { 0.2, 0.55, 0.8, 1.6, 3.0, 5.0, 9.0, 14.0, 25.0, 33.0 })
    {
      MadeUpArm arm;
      arm.damping.setConstant(0.1);
      std::optional<Vector3d> held;
      Vector3d last = Vector3d::Zero();
      int leaps = 0;
      const auto exchange = [&](const Vector3d& force) -> std::optional<ArmPosition>
      {
        ArmPosition now = arm.exchange(force);
        last = force;
        if (arm.time > from)
        {
          held = held.value_or(now.position);
          const Vector3d leapt =
            now.position + (++leaps % 3 == 0 ? 1.0 : 0.0) * Vector3d(0.02, 0, 0);
          now.position = hangs ? *held : leapt;
        }
        return now;
      };
      EXPECT_THROW((void)identifyArm(exchange, arm.step), Error) << from;
      EXPECT_LE(arm.time, from + 6.0);
      EXPECT_LE(arm.furthest, 0.3);
      EXPECT_EQ(last, Vector3d::Zero());
    }
  }
}

} // namespace
} // namespace palp
