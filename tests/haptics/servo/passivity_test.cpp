#include "haptics/servo/passivity.h"

#include "haptics/devices/velocity_estimator.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

Vector3d along(double value)
{
  return { value, 0.0, 0.0 };
}

// a sampled spring driven by A sin(w t) loses (K T / 2) pi A^2 w in each cycle
TEST(PassivityController, BooksTheLeakOfASampledSpring)
{
  for (const double stiffness : { 500.0, 1000.0, 3000.0 })
  {
    for (const double frequency : { 1.0, 2.0, 5.0 })
    {
      PassivityController controller(0.0);
      const double amplitude = 2.0_mm;
      const double omega = 2.0 * std::numbers::pi * frequency;
      const int ticks = static_cast<int>(std::lround(1000.0 / frequency));
      controller.restart({ along(0.0) });
      for (int tick = 0; tick <= ticks; ++tick)
      {
        const double x = amplitude * std::sin(omega * tick * 1.0_ms);
        (void)controller.damp({ .position = along(x), .velocity = along(0.0), .dt = 1.0_ms });
        controller.sent(along(-stiffness * x));
      }
      const double leak =
        stiffness * 1.0_ms / 2.0 * std::numbers::pi * amplitude * amplitude * omega;
      EXPECT_NEAR(controller.energy(), -leak, 0.01 * leak) << stiffness << " " << frequency;
    }
  }
}

// a device at a wall that is too stiff for it, pushed by 1 N; integrated fifty times finer
struct Tap
{
  double energy = 0.0;         // least at the port, in the plant [J]
  double end = 0.0;            // the same at the end [J]
  double observedEnergy = 0.0; // [J]
  double tail = 0.0;           // root mean square speed in the last quarter [m/s]
};

Tap tap(double damping, double stiffness, double maxDamping, double duration = 8.0)
{
  constexpr double kMass = 0.1;
  constexpr int kFine = 50;
  PassivityController controller(maxDamping);
  Tap result;
  double x = -5.0_mm;
  double v = 0.2;
  double port = 0.0;
  double before = x;
  controller.restart({ along(x) });
  const int ticks = static_cast<int>(duration * 1000.0);
  for (int tick = 0; tick < ticks; ++tick)
  {
    const double seenSpeed = (x - before) / 1.0_ms;
    before = x;
    const double wall = x > 0.0 ? -stiffness * x : 0.0;
    const double brake =
      controller.damp({ .position = along(x), .velocity = along(seenSpeed), .dt = 1.0_ms }).x();
    const double force = std::clamp(wall + brake, -8.0, 8.0);
    controller.sent(along(force));
    for (int i = 0; i < kFine; ++i)
    {
      const double h = 1.0_ms / kFine;
      const double faster = v + (force + 1.0 - damping * v) / kMass * h;
      const double travel = 0.5 * (v + faster) * h;
      port -= force * travel;
      x += travel;
      v = faster;
    }
    result.energy = std::min(result.energy, port);
    result.tail += tick >= ticks * 3 / 4 ? v * v / (ticks / 4.0) : 0.0;
  }
  (void)controller.damp({ .position = along(x), .velocity = along(0.0), .dt = 1.0_ms });
  result.tail = std::sqrt(result.tail);
  result.end = port;
  result.observedEnergy = controller.energy();
  return result;
}

TEST(PassivityController, ObservesTheEnergyAtThePortOfThePlant)
{
  const Tap stable = tap(0.5, 500.0, 30.0, 1.0);
  EXPECT_GT(stable.end, 0.0);
  EXPECT_NEAR(stable.observedEnergy, stable.end, 1e-9);
}

class TooStiff : public ::testing::TestWithParam<double> // times the stable stiffness
{
};
INSTANTIATE_TEST_SUITE_P(PassivityController, TooStiff, ::testing::Values(1.5, 2.5, 5.0, 10.0));

TEST_P(TooStiff, IsTamedTenfoldInSpeedAndFiftyfoldInEnergy)
{
  for (const double damping : { 0.2, 0.5 })
  {
    const double stiffness = GetParam() * 2.0 * damping / 1.0_ms;
    const Tap off = tap(damping, stiffness, 0.0);
    const Tap on = tap(damping, stiffness, 30.0);
    EXPECT_GE(off.tail, 10.0 * on.tail) << damping;
    EXPECT_GE(-off.energy, -50.0 * on.energy) << damping;
    RecordProperty("speed_ratio", std::to_string(off.tail / on.tail));
    RecordProperty("energy_ratio", std::to_string(off.energy / on.energy));
  }
}

// a plant of its own: forces act a delay after their pose, which is no whole number of ticks, on a
// mass at a spring, integrated forty times finer by the midpoint rule
struct LatePlant
{
  double delay = 0.0;   // [s]
  double told = 0.0;    // of it [s]
  double damping = 0.8; // [N s/m]
  double stiffness = 200.0;
  double mass = 0.1; // [kg]

  double worst = 0.0; // difference of observed and true energy, at any tick [J]
  double late = 0.0;  // largest speed in the last second [m/s]

  void press(double maxDamping)
  {
    constexpr int kFine = 40;
    constexpr double kLong = 8.0;
    const double h = 1.0_ms / kFine;
    PassivityController controller(maxDamping);
    std::vector<double> forces;
    double x = -5.0_mm;
    double v = 0.2;
    double port = 0.0;
    double before = x;
    controller.restart({ along(x) });
    for (int tick = 0; tick * 1.0_ms < kLong; ++tick)
    {
      const double speed = (x - std::exchange(before, x)) / 1.0_ms;
      const double depth = std::max(0.0, x);
      const double brake = controller
                             .damp({ .position = along(x),
                               .velocity = along(speed),
                               .dt = 1.0_ms,
                               .delay = told,
                               .stored = 0.5 * stiffness * depth * depth })
                             .x();
      worst = std::max(worst, std::abs(controller.energy() - port));
      forces.push_back(std::min(0.0, x > 0.0 ? brake - stiffness * x : 0.0));
      controller.sent(along(forces.back()));
      for (int i = 0; i < kFine; ++i)
      {
        const double when = tick * 1.0_ms + (i + 0.5) * h - delay;
        const auto which = static_cast<std::size_t>(std::max(0.0, when) / 1.0_ms);
        const double force = when < 0.0 ? 0.0 : forces[which];
        const double middle = v + 0.5 * h * (force + 1.0 - damping * v) / mass;
        v += h * (force + 1.0 - damping * middle) / mass;
        x += h * middle;
        port -= force * h * middle;
      }
      late = tick * 1.0_ms > kLong - 1.0 ? std::max(late, std::abs(v)) : late;
    }
  }
};

TEST(PassivityController, ObservesTheEnergyOfThePlantHoweverLateItsForcesAre)
{
  for (const double delay : { 0.0_ms, 0.3_ms, 1.0_ms, 2.0_ms, 2.7_ms, 4.0_ms, 5.0_ms })
  {
    LatePlant plant{ .delay = delay, .told = delay };
    plant.press(2.0);
    EXPECT_LE(plant.worst, 1e-4) << delay;
    RecordProperty("worst_J", std::to_string(plant.worst));
  }
  LatePlant unknowing{ .delay = 4.0_ms }; // as if every force acted at once
  unknowing.press(2.0);
  EXPECT_GE(unknowing.worst, 1e-3);
}

// how far what is observed strays from the energy of a motion that is known, A sin(w t) about a
// place, behind an encoder whose steps are the rows of a spring
double strayed(double quantum, double amplitude, double omega, double place)
{
  constexpr double kStiffness = 2000.0;
  PassivityController controller(0.0, quantum);
  VelocityEstimator velocity(quantum);
  const auto at = [&](double time) { return place + amplitude * std::sin(omega * time); };
  const auto seen = [&](double x) { return along(std::round(x / quantum) * quantum); };
  controller.restart({ seen(at(0.0)) });
  double port = 0.0;
  double force = 0.0;
  double worst = 0.0;
  for (int tick = 0; tick < 40'000; ++tick)
  {
    const double now = tick * 1.0_ms;
    port -= tick > 0 ? force * (at(now) - at(now - 1.0_ms)) : 0.0;
    const Vector3d position = seen(at(now));
    (void)controller.damp(
      { .position = position, .velocity = velocity(position, 1.0_ms), .dt = 1.0_ms });
    force = -kStiffness * position.x();
    controller.sent(along(force));
    worst = std::max(worst, std::abs(controller.energy() - port));
  }
  return worst / (quantum * kStiffness * (std::abs(place) + amplitude + quantum));
}

// half a step times the change of force at each crossing of a border is what the reading alone
// gives
TEST(PassivityController, StraysLittleWhereAnArmGoesBackAndForthOverTheStepsOfItsEncoder)
{
  constexpr double kFinest = 20e-6;
  for (const double steps : { 0.1, 0.4, 0.7, 2.0, 7.3, 40.0 }) // of the encoder, the amplitude
  {
    for (const double frequency : { 0.2, 1.0, 5.0, 20.0 })
    {
      for (const double place : { 0.5, 0.8, 10.5, 11.0 }) // in steps
      {
        const double crossings = 40.0 * frequency * std::max(2.0, 4.0 * steps);
        EXPECT_LE(
          strayed(kFinest, steps * kFinest, 2.0 * std::numbers::pi * frequency, place * kFinest),
          1.0 + 0.05 * crossings)
          << steps << " " << frequency << " " << place;
      }
    }
  }
}

TEST(PassivityController, CalmsALateWallThatNoBoundWasAskedFor)
{
  for (const double delay : { 1.0_ms, 3.0_ms, 5.0_ms })
  {
    LatePlant wall{ .delay = delay, .told = delay, .damping = 0.2 };
    wall.press(2.0);
    EXPECT_LE(wall.late, 5.0e-3) << delay;
    LatePlant alone = wall;
    alone.late = 0.0;
    alone.press(0.0);
    EXPECT_GE(alone.late, delay > 2.0_ms ? 0.1 : 0.0) << delay;
  }
}

// what the tissue stores may be taken back, but pays for nothing else
TEST(PassivityController, EnergyInTheSpringIsNoCredit)
{
  PassivityController controller(30.0);
  controller.restart({ along(0.0) });
  controller.sent(along(-5.0));
  const Vector3d force = controller.damp(
    { .position = along(1.0_mm), .velocity = along(0.1), .dt = 1.0_ms, .stored = 7.0e-3 });
  EXPECT_LT(force.x(), 0.0);
  EXPECT_NEAR(controller.energy(), 5.0e-3, 1e-12);
}

TEST(PassivityController, BooksWhatTheMotorsWereGiven)
{
  PassivityController controller(0.0);
  controller.restart({ along(0.0) });
  controller.sent(along(-5.0));
  controller.given(along(-3.0));
  (void)controller.damp({ .position = along(1.0_mm), .dt = 1.0_ms });
  EXPECT_NEAR(controller.energy(), 3.0e-3, 1e-12);
}

// a torque works where the tool turns, as a force where it goes
TEST(PassivityController, BooksTheTurnsOfATool)
{
  PassivityController controller(0.0);
  const Vector3d down = -Vector3d::UnitZ();
  controller.restart({ along(0.0), down });
  const Vector3d about = Vector3d(0.6, 0.8, 0.0); // of a spring that turns it upright
  constexpr double kStiffness = 0.1;
  constexpr double kTurned = 1e-3;
  for (int i = 0; i < 200; ++i)
  {
    controller.sent({ Vector3d::Zero(), -kStiffness * i * kTurned * about });
    const Vector3d axis = Eigen::AngleAxisd((i + 1) * kTurned, about) * down;
    (void)controller.damp({ .position = along(0.0), .axis = axis, .dt = 1.0_ms });
  }
  EXPECT_NEAR(controller.energy(), 0.5 * kStiffness * 0.2 * 0.2, 0.01 * 2e-3);
}

TEST(PassivityController, NeverPushesAlongTheMotion)
{
  PassivityController controller(30.0);
  controller.restart({ along(0.0) });
  controller.sent(along(5.0));
  const Vector3d force = controller.damp(
    { .position = along(1.0_mm), .velocity = Vector3d(0.1, 0.2, -0.1), .dt = 1.0_ms });
  EXPECT_LT(force.dot(Vector3d(0.1, 0.2, -0.1)), 0.0);
  EXPECT_LE(force.norm(), 30.0 * Vector3d(0.1, 0.2, -0.1).norm() * (1.0 + 1e-12));
}

TEST(PassivityController, LeavesAHandAloneThatWasGivenNothing)
{
  PassivityController controller(30.0);
  controller.restart({ along(0.0) });
  controller.sent(along(-5.0));
  EXPECT_TRUE(controller.damp({ .position = along(1.0_mm), .velocity = along(0.1), .dt = 1.0_ms })
                .isZero(0.0));
  EXPECT_GT(controller.energy(), 0.0);
  controller.sent(along(2.0)); // gives back a part of what it took, in another contact
  controller.leaveContact();
  const Vector3d force =
    controller.damp({ .position = along(1.1_mm), .velocity = along(0.1), .dt = 1.0_ms });
  EXPECT_LT(force.x(), 0.0);
  EXPECT_GT(controller.energy(), 0.0); // of all contacts
}

} // namespace
} // namespace palp
