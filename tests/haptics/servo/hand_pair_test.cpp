#include "haptics/servo/servo.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <thread>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

// goes to a depth as a hand would; what it is told is read by another thread
class HeldArm final : public Device
{
public:
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "held", .rendersForce = true, .maxForce = 7.9, .damping = 1.0 };
  }
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double) noexcept override
  {
    told = wrench.force.norm();
    ++exchanges;
    depth_ += std::clamp(depth - depth_, -0.1_mm, 0.1_mm);
    return isGone ? std::nullopt : std::optional(ToolPose{ .apex = { 0.0, 0.0, -depth_ } });
  }

  std::atomic<double> told = 0.0; // [N]
  std::atomic<int> exchanges = 0;
  std::atomic<double> depth = -1.0_mm;
  std::atomic<bool> isGone = false;

private:
  double depth_ = -1.0_mm;
};

class HandPair : public testing::Test
{
protected:
  HandPair()
  {
    scene_.surface =
      std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 4)));
    const ServoOptions options{
      .realtime = false, .fault = &fault_, .epoch = std::chrono::steady_clock::now() - 100s
    };
    first_.emplace(arms_[0], scene_, options);
    second_.emplace(arms_[1], scene_, options);
  }

  // as the main thread of a program does
  void arm(bool armed)
  {
    fault_ = false;
    scene_.armed = armed;
    first_->setScene(scene_);
    second_->setScene(scene_);
  }

  template <typename Condition>
  [[nodiscard]] bool becomes(Condition condition, std::chrono::milliseconds longest = 60s)
  {
    const auto end = std::chrono::steady_clock::now() + longest;
    while (!condition() && std::chrono::steady_clock::now() < end)
    {
      (void)first_->newest(); // whoever renders force must look
      (void)second_->newest();
      std::this_thread::sleep_for(1ms);
    }
    return condition();
  }

  [[nodiscard]] static bool isActive(Servo& servo)
  {
    return servo.newest().state == DeviceState::Active;
  }

  // after what ticks that began before this call tell; a force that fades is not off
  void expectForceOff()
  {
    const std::array before{ arms_[0].exchanges.load(), arms_[1].exchanges.load() };
    const auto isOff = [&](std::size_t i, Servo& servo)
    {
      return arms_[i].exchanges > before[i] + 2 && arms_[i].told == 0.0 &&
        servo.newest().state == DeviceState::Ready;
    };
    EXPECT_TRUE(becomes([&] { return isOff(0, *first_) && isOff(1, *second_); }));
  }

  [[nodiscard]] bool bothPush() const
  {
    return arms_[0].told > 0.3 && arms_[1].told > 0.3;
  }

  // a machine that does much else loses ticks, and then the force has to be asked for again
  void armUntilBothPush()
  {
    for (int attempt = 0; attempt < 60 && !bothPush(); ++attempt)
    {
      arms_[0].depth = arms_[1].depth = -1.0_mm; // a force that starts in contact is felt less deep
      arm(false);
      (void)becomes([] { return false; }, 150ms);
      arm(true);
      (void)becomes([this] { return isActive(*first_) && isActive(*second_); }, 3s);
      arms_[0].depth = arms_[1].depth = 3.0_mm;
      (void)becomes([this] { return bothPush(); }, 3s);
    }
    ASSERT_TRUE(bothPush());
  }

  std::array<HeldArm, 2> arms_;
  std::atomic<bool> fault_ = false;
  Scene scene_;
  std::optional<Servo> first_;
  std::optional<Servo> second_;
};

TEST_F(HandPair, AFaultOfOneTakesTheForceOfBothUntilArmedAnew)
{
  for (const std::size_t failing : { 0U, 1U })
  {
    armUntilBothPush();
    arms_[failing].isGone = true; // the main thread does nothing about it
    EXPECT_TRUE(becomes([this] { return arms_[0].told == 0.0 && arms_[1].told == 0.0; }));
    EXPECT_TRUE(becomes([this] { return fault_.load(); }));
    arms_[failing].isGone = false;
    expectForceOff();
    EXPECT_FALSE(becomes([this] { return arms_[0].told > 0.0 || arms_[1].told > 0.0; }, 300ms))
      << "that it is back arms neither";
  }
}

TEST_F(HandPair, TellsTimesByOneClock)
{
  const auto began = std::chrono::steady_clock::now();
  ASSERT_TRUE(
    becomes([this] { return first_->newest().time > 0.0 && second_->newest().time > 0.0; }));
  const double elapsed =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  for (Servo* servo : { &*first_, &*second_ })
  {
    EXPECT_GE(servo->newest().time, 100.0);
    EXPECT_LE(servo->newest().time, 102.0 + elapsed);
  }
}

} // namespace
} // namespace palp
