#include "app/program/build_trace.h"
#include "app/session/session.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>
#include <thread>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

constexpr double kYoung = 50.0_kPa;
constexpr double kPoisson = 0.33;

// of a sphere of 10 mm radius in a half-space (Hertz 1882)
double hertz(double depth)
{
  return 4.0 / 3.0 * kYoung / (1.0 - kPoisson * kPoisson) *
    std::sqrt(10.0_mm * depth * depth * depth);
}

// an arm that a test holds
struct HeldArm
{
  std::atomic<double> x = 0.0;         // [m]
  std::atomic<double> depth = -1.0_mm; // that it goes to [m]
  std::atomic<double> told = 0.0;      // [N]
  std::atomic<bool> isGone = false;
};

class HeldDevice final : public Device
{
public:
  explicit HeldDevice(HeldArm& arm)
    : arm_(arm)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "held", .rendersForce = true, .maxForce = 7.0, .damping = 2.0 };
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double) noexcept override
  {
    arm_.told = wrench.force.norm();
    depth_ += std::clamp(arm_.depth - depth_, -0.1_mm, 0.1_mm);
    return arm_.isGone ? std::nullopt : std::optional(ToolPose{ .apex = { arm_.x, 0.0, -depth_ } });
  }

private:
  HeldArm& arm_;
  double depth_ = -1.0_mm;
};

// the upper face of a block, which lies in z = 0
class TwoHands : public testing::Test
{
protected:
  TwoHands()
  {
    setenv("PALP_DATA", PALP_SHARE, 1);
  }

  [[nodiscard]] static ScenePlan plan()
  {
    ScenePlan plan;
    plan.meshes = { { .bundled = "block_50" } };
    plan.press.tissue.young = kYoung;
    plan.press.tissue.poisson = kPoisson;
    plan.press.tissue.options.mode = LawMode::Paper;
    return plan;
  }

  [[nodiscard]] DeviceChoice path(const char* name, double x, double depth) const
  {
    const std::string file = (folder_.path() / name).string();
    std::ofstream(file) << "time_s,x_mm,y_mm,z_mm,ax,ay,az\n0," << x << ",0,2,0,0,-1\n0.3," << x
                        << ",0," << -depth << ",0,0,-1\n60," << x << ",0," << -depth << ",0,0,-1\n";
    return parseDevice("path:" + file);
  }

  [[nodiscard]] static bool isActive(const Sample& sample)
  {
    return sample.state == DeviceState::Active;
  }

  static bool becomes(Session& session, const std::function<bool()>& condition,
    std::chrono::milliseconds longest = 60s)
  {
    const auto end = std::chrono::steady_clock::now() + longest;
    while (!condition() && std::chrono::steady_clock::now() < end)
    {
      session.update([](const Sample&) {});
      std::this_thread::sleep_for(2ms);
    }
    return condition();
  }

  test::TemporaryFolder folder_;
  BuildTrace silent_{ false };
};

TEST_F(TwoHands, EachFeelsItsOwnContactAlone)
{
  ScenePlan plan = TwoHands::plan();
  plan.device = path("left.csv", -20.0, 2.0);
  plan.second = path("right.csv", 20.0, 4.0);
  Session session(plan, silent_);
  ASSERT_TRUE(session.hasSecond());
  const auto rests = [](const Sample& sample, double depth)
  { return std::abs(sample.contact.depth - depth) < 1e-9; };
  ASSERT_TRUE(becomes(session,
    [&] { return rests(session.newest(), 2.0_mm) && rests(*session.newestOfSecond(), 4.0_mm); }));
  EXPECT_NEAR(session.newest().force.z(), hertz(2.0_mm), 1e-6);
  EXPECT_NEAR(session.newestOfSecond()->force.z(), hertz(4.0_mm), 1e-6);
  EXPECT_NEAR(session.newest().contact.center.x(), -20.0_mm, 1e-9);
  EXPECT_NEAR(session.newestOfSecond()->contact.center.x(), 20.0_mm, 1e-9);

  ASSERT_TRUE(becomes(session,
    [&]
    {
      const Recording& recording = session.recording();
      return recording.deepest() != nullptr && rests(*recording.deepest(), 2.0_mm) &&
        deepestOf(recording.second->samples) != nullptr &&
        rests(*deepestOf(recording.second->samples), 4.0_mm);
    }));
  const Sample& deepest = *deepestOf(session.recording().second->samples);
  EXPECT_NEAR(deepest.response.force, hertz(4.0_mm), 1e-6);
  // another hand's samples begin with its device, and what was recorded stays whole
  session.useSecond(std::nullopt);
  EXPECT_FALSE(session.hasSecond());
  EXPECT_EQ(session.newestOfSecond(), nullptr);
  EXPECT_FALSE(session.recording().second);
  ASSERT_EQ(session.earlier().size(), 1U);
  EXPECT_EQ(session.earlier().back().recording.second->device, plan.second->name);
}

TEST_F(TwoHands, AFaultOfOneDisarmsBoth)
{
  HeldArm left{ .x = -20.0_mm };
  HeldArm right{ .x = 20.0_mm };
  Session session(plan(), silent_);
  session.useDevice(
    { .kind = DeviceChoice::Kind::Driver, .name = "left" }, std::make_unique<HeldDevice>(left));
  session.useSecond(
    { .kind = DeviceChoice::Kind::Driver, .name = "right" }, std::make_unique<HeldDevice>(right));
  EXPECT_FALSE(session.armed());
  const auto bothPush = [&] { return left.told > 0.05 && right.told > 0.05; };
  for (HeldArm* failing : { &left, &right })
  {
    for (int attempt = 0; attempt < 60 && !bothPush(); ++attempt)
    {
      left.depth = right.depth = -1.0_mm;
      (void)becomes(
        session, [] { return false; }, 200ms);
      session.armed() ? void() : session.arm(true);
      (void)becomes(
        session, [&] { return isActive(session.newest()) && isActive(*session.newestOfSecond()); },
        3s);
      left.depth = right.depth = 3.0_mm;
      (void)becomes(session, bothPush, 3s);
    }
    ASSERT_TRUE(bothPush());
    failing->isGone = true;
    EXPECT_TRUE(becomes(session, [&] { return !session.armed(); }));
    EXPECT_TRUE(becomes(session, [&] { return left.told == 0.0 && right.told == 0.0; }));
    failing->isGone = false;
    EXPECT_FALSE(becomes(
      session, [&] { return left.told > 0.0 || right.told > 0.0; }, 300ms));
  }
  session.stop(true);
  session.arm(true);
  EXPECT_FALSE(becomes(
    session, [&] { return left.told > 0.0 || right.told > 0.0; }, 300ms))
    << "one button stops both";
}

TEST_F(TwoHands, SamplesNameTheHandOnlyWhereThereAreTwo)
{
  ScenePlan plan = TwoHands::plan();
  plan.device = path("left.csv", -20.0, 2.0);
  Session session(plan, silent_);
  const auto text = [&]
  {
    std::ostringstream out;
    writeSamples(out, session.recording(), &session.calibration());
    return out.str();
  };
  ASSERT_TRUE(becomes(session, [&] { return session.recording().samples.size() > 10; }));
  EXPECT_EQ(text().find("hand,"), std::string::npos);
  EXPECT_EQ(text().find("second device"), std::string::npos);
  session.useSecond(path("right.csv", -5.0, 4.0));
  ASSERT_TRUE(becomes(session,
    [&]
    {
      const Recording& recording = session.recording();
      return recording.deepest() && recording.deepest()->contact.depth > 1.9_mm &&
        recording.second->samples.back().contact.depth > 3.9_mm;
    }));
  EXPECT_NE(text().find("# second device: path:"), std::string::npos);
  EXPECT_NE(text().find("time_s,hand,tool_x_mm"), std::string::npos);
}

TEST_F(TwoHands, CannotShareADeviceOrThePointer)
{
  Session session(plan(), silent_);
  EXPECT_THROW(session.useSecond(parseDevice("mouse")), Error);
  EXPECT_THROW(session.useSecond(parseDevice("hand")), Error);
  EXPECT_FALSE(session.hasSecond());
  EXPECT_THROW(checkHands(parseDevice("falcon"), parseDevice("falcon")), Error);
  session.useSecond(path("right.csv", 20.0, 4.0));
  session.useDevice(parseDevice("hand"));
  EXPECT_TRUE(session.hasSecond());
  EXPECT_TRUE(session.armed()) << "nobody can be hurt";
}

} // namespace
} // namespace palp
