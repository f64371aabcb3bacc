#include "app/press/press_log.h"

#include "app/press/press_fit.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRadius = 10.0_mm;
constexpr double kModulus = 50.0_kPa;

// F = 4/3 E* sqrt(R) d^1.5, Hertz
double hertz(double depth)
{
  return 4.0 / 3.0 * kModulus / (1.0 - 0.33 * 0.33) * std::sqrt(kRadius) * std::pow(depth, 1.5);
}

// a servo that presses a sphere into a block, a millisecond each
class Pressing
{
public:
  Pressing()
  {
    recording.scene.surface =
      std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 20)));
    recording.scene.law = ForceLaw(SphereTip{ kRadius }, Material{ kModulus, 0.33 });
  }

  void go(double depth)
  {
    Sample sample = step(recording.scene, { .apex = { 0.0, 0.0, -depth } });
    sample.time = time;
    time += 1e-3;
    log.follow(sample);
    recording.samples.push_back(sample);
    log.keep(recording);
  }

  // half a sine, from the surface and back
  void press(double deepest, int milliseconds)
  {
    for (int i = 0; i <= milliseconds; ++i)
    {
      go(deepest * std::sin(std::numbers::pi * i / milliseconds) - 1e-9);
    }
  }

  void wait(int milliseconds)
  {
    for (int i = 0; i < milliseconds; ++i)
    {
      go(-1.0_mm);
    }
  }

  Recording recording;
  PressLog log;
  double time = 0.0;
};

TEST(PressLog, FindsEachPressWhenItIsReleased)
{
  Pressing servo;
  const std::vector<double> depths{ 5.0_mm, 0.2_mm, 9.0_mm };
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    servo.press(depths[i], i == 1 ? 40 : 1500);
    EXPECT_EQ(servo.log.presses().size(), i) << "20 ms must pass";
    servo.wait(30);
    ASSERT_EQ(servo.log.presses().size(), i + 1);
    const KeptPress& press = servo.log.presses().back();
    EXPECT_NEAR(press.summary.deepest.depth, depths[i], 1e-3 * depths[i]);
    EXPECT_NEAR(press.summary.force, hertz(press.summary.deepest.depth), 1e-6);
    EXPECT_EQ(press.summary.name, "press " + std::to_string(i + 1));
  }
}

TEST(PressLog, AgreesWithTheWholeRecording)
{
  Pressing servo;
  for (const double depth : { 3.0_mm, 1.0_mm, 6.0_mm })
  {
    servo.press(depth, 700);
    servo.wait(15); // a bounce
    servo.press(depth, 90);
    servo.wait(100);
  }
  const auto whole = findPresses(servo.recording);
  ASSERT_EQ(servo.log.presses().size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    const PressSummary& press = servo.log.presses()[i].summary;
    EXPECT_EQ(press.begin, whole[i].begin);
    EXPECT_EQ(press.end, whole[i].end);
    EXPECT_EQ(press.force, whole[i].force);
    EXPECT_EQ(press.energy, whole[i].energy);
  }
}

TEST(PressLog, KeepsThePressThatAnEndOfTheRecordingCutsOff)
{
  Pressing servo;
  for (int i = 0; i < 100; ++i)
  {
    servo.go(i * 0.05_mm);
  }
  EXPECT_TRUE(servo.log.presses().empty());
  servo.log.end(servo.recording);
  ASSERT_EQ(servo.log.presses().size(), 1U);
  EXPECT_NEAR(servo.log.presses().front().summary.force, hertz(4.95_mm), 1e-6);
  servo.recording.samples.clear();
  servo.log.end(servo.recording);
  servo.wait(100);
  EXPECT_EQ(servo.log.presses().size(), 1U) << "once";
}

TEST(PressLog, CurveIsBoundedAndHasTheDeepestPoint)
{
  Pressing servo;
  servo.press(4.0_mm, 300);
  servo.wait(30);
  for (int i = 0; i <= 1000; ++i)
  {
    servo.go(std::min(i * 0.01_mm, 3.0_mm)); // rests at its depth for 0.7 s
  }
  servo.wait(30);
  servo.press(20.0_mm, 20'000);
  servo.wait(30);
  ASSERT_EQ(servo.log.presses().size(), 3U);
  for (const KeptPress& press : servo.log.presses())
  {
    EXPECT_LE(press.curve.size(), KeptPress::kCurve + 2);
    EXPECT_GE(press.curve.size(), 100U);
    const auto deepest = std::ranges::max_element(press.curve, {}, &CurvePoint::depth);
    EXPECT_EQ(deepest->depth, press.summary.deepest.depth);
    for (const CurvePoint& point : press.curve)
    {
      EXPECT_NEAR(point.force, hertz(point.depth), 1e-6);
    }
  }
}

// of 8 s at one depth after half a second of motion: straight lines between its points, as a chart
// draws them, are the force
TEST(PressLog, CurveIsEvenHoweverLongAPressIsHeld)
{
  Pressing servo;
  for (int i = 0; i <= 9000; ++i)
  {
    const double held = 4.0_mm + 0.005_mm * std::sin(0.5 * i);
    servo.go(i < 500 ? i * 0.008_mm : i < 8500 ? held : (9000 - i) * 0.008_mm);
  }
  servo.wait(30);
  ASSERT_EQ(servo.log.presses().size(), 1U);
  const std::vector<CurvePoint>& curve = servo.log.presses().front().curve;
  EXPECT_LE(curve.size(), KeptPress::kCurve + 2);
  for (std::size_t i = 1; i < curve.size(); ++i)
  {
    const double depth = 0.5 * (curve[i - 1].depth + curve[i].depth);
    const double force = 0.5 * (curve[i - 1].force + curve[i].force);
    EXPECT_NEAR(force, hertz(depth), 0.005 * hertz(4.0_mm)) << i << ' ' << depth;
  }
}

TEST(PressLog, NeverHoldsMoreThanItsBound)
{
  Pressing servo;
  for (std::size_t i = 0; i < PressLog::kMost + 20; ++i)
  {
    servo.recording.samples.clear();
    servo.press(1.0_mm, 10);
    servo.wait(25);
  }
  EXPECT_EQ(servo.log.presses().size(), PressLog::kMost);
  EXPECT_EQ(servo.log.presses().front().id, 21);
  EXPECT_EQ(servo.log.presses().back().id, static_cast<int>(PressLog::kMost) + 20);
}

TEST(PressLog, PutsADeletedPressBackWhereItWas)
{
  Pressing servo;
  for (int i = 0; i < 4; ++i)
  {
    servo.press(1.0_mm, 50);
    servo.wait(25);
  }
  const KeptPress second = *servo.log.find(2);
  servo.log.remove(2);
  servo.log.remove(77);
  EXPECT_EQ(servo.log.find(2), nullptr);
  EXPECT_EQ(servo.log.presses().size(), 3U);
  const int version = servo.log.version();
  servo.log.restore(second);
  EXPECT_NE(servo.log.version(), version);
  EXPECT_TRUE(std::ranges::is_sorted(servo.log.presses(), {}, &KeptPress::id));
  EXPECT_EQ(servo.log.presses().size(), 4U);
  servo.log.rename(2, "left lobe");
  EXPECT_EQ(servo.log.find(2)->summary.name, "left lobe");
}

TEST(PressLog, TellsWhichPressesWereRemoved)
{
  Pressing servo;
  for (int i = 0; i < 4; ++i)
  {
    servo.press(1.0_mm + i * 0.1_mm, 50);
    servo.wait(25);
  }
  const KeptPress third = *servo.log.find(3);
  servo.log.remove(3);
  servo.log.rename(4, "left lobe");
  using Names = std::vector<std::string>;
  EXPECT_EQ(servo.log.names()(servo.recording), (Names{ "press 1", "press 2", "", "left lobe" }));
  servo.recording.names = servo.log.names()(servo.recording);
  EXPECT_EQ(findPresses(servo.recording).size(), 3U);
  EXPECT_EQ(findPresses(servo.recording).back().name, "left lobe");
  servo.recording.names.clear();
  servo.log.restore(third);
  EXPECT_EQ(
    servo.log.names()(servo.recording), (Names{ "press 1", "press 2", "press 3", "left lobe" }));
}

TEST(PressLog, GivesNoNameTwice)
{
  Pressing servo;
  servo.press(1.0_mm, 50);
  servo.wait(25);
  servo.log.rename(1, "press 2"); // as of another session
  servo.press(1.0_mm, 50);
  servo.wait(25);
  EXPECT_EQ(servo.log.presses().back().summary.name, "press 3");
  servo.log.rename(2, "press 2");
  EXPECT_EQ(servo.log.presses().back().summary.name, "press 2 (2)");
  servo.log.rename(1, "press 2");
  EXPECT_EQ(servo.log.presses().front().summary.name, "press 2");
}

// the modulus that the servo pressed with
TEST(PressFit, FindsTheModulusOfASphere)
{
  for (const double depth : { 1.0_mm, 5.0_mm })
  {
    Pressing servo;
    servo.press(depth, 1000);
    servo.wait(25);
    const fit::ModulusFit fit = fitPress(servo.log.presses().front());
    EXPECT_NEAR(fit.asked().curve.scale.value, kModulus, 1e-4 * kModulus);
    ASSERT_NE(fit.exponent(), nullptr);
    EXPECT_NEAR(fit.exponent()->value, 1.5, 1e-3);
  }
}

} // namespace
} // namespace palp
