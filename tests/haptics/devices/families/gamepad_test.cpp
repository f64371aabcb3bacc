#include "haptics/devices/gamepad/gamepad_driver.h"
#include "haptics/units.h"
#include "tests/haptics/devices/families/made_up_gamepad.h"
#include "tests/haptics/devices/families/one_sentence.h"
#include "tests/support/allocation_guard.h"

#include <cstdarg>
#include <sys/syscall.h>

namespace
{

palp::test::MadeUpGamepad* gPad = nullptr;

} // namespace

// in place of the C library's: the node of the made-up pad is a socket
extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list rest;
  va_start(rest, request);
  void* data = va_arg(rest, void*);
  va_end(rest);
  return gPad != nullptr && file == gPad->node
    ? gPad->control(request, static_cast<unsigned char*>(data))
    : static_cast<int>(syscall(SYS_ioctl, file, request, data));
}

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

constexpr std::uint16_t kKey = 1;
constexpr std::uint16_t kAbsolute = 3;
constexpr std::uint16_t kForce = 0x15;

class Gamepad : public ::testing::Test
{
protected:
  void open(bool rumbles = true)
  {
    driver_.reset();
    pad_ = std::make_unique<MadeUpGamepad>(rumbles);
    gPad = pad_.get();
    driver_ = std::make_unique<GamepadDriver>(Descriptor(pad_->node));
  }
  ~Gamepad() override
  {
    driver_.reset();
    gPad = nullptr;
  }

  void tick(int ticks, double force = 0.0)
  {
    for (int i = 0; i < ticks; ++i)
    {
      ASSERT_EQ(driver_->tick(Vector3d(0, 0, force), 1.0_ms, sample_), IoCode::Ok);
    }
  }

  std::unique_ptr<MadeUpGamepad> pad_;
  std::unique_ptr<GamepadDriver> driver_;
  DriverSample sample_;
};

TEST_F(Gamepad, ItsSticksMoveTheToolAtARate)
{
  struct Row
  {
    std::uint16_t axis;
    int value;
    Vector3d way; // at full deflection 60 mm/s
  };
  for (const auto& [axis, value, way] :
    { Row{ 0, 32'767, { 1, 0, 0 } }, Row{ 1, -32'768, { 0, 1, 0 } }, Row{ 4, -32'768, { 0, 0, 1 } },
      Row{ 1, 32'767, { 0, -1, 0 } }, Row{ 0, 100, { 0, 0, 0 } } }) // the last: flat
  {
    open();
    pad_->tell(kAbsolute, axis, value);
    tick(500); // a stick that is held tells nothing more
    EXPECT_LT((sample_.position - 30.0_mm * way).norm(), 0.1_mm) << axis;
    pad_->tell(kAbsolute, axis, 0);
    tick(500);
    EXPECT_LT((sample_.position - 30.0_mm * way).norm(), 0.1_mm) << axis;
    EXPECT_FALSE(driver_->limits().rendersForce);
  }
}

TEST_F(Gamepad, ItsCrossTiltsTheTool)
{
  open();
  pad_->tell(kAbsolute, 0x10, 1); // right: the top to the right, the tip to the left
  tick(500);
  const Vector3d left = sample_.orientation * -Vector3d::UnitZ();
  EXPECT_NEAR(left.x(), -std::sin(0.5), 1e-3);
  EXPECT_NEAR(left.y(), 0.0, 1e-9);
  open();
  pad_->tell(kAbsolute, 0x11, -1); // up: the top away, the tip to the user
  tick(500);
  const Vector3d near = sample_.orientation * -Vector3d::UnitZ();
  EXPECT_NEAR(near.y(), -std::sin(0.5), 1e-3);
}

TEST_F(Gamepad, RumblesAsTheForceDoes)
{
  open();
  tick(100);
  EXPECT_TRUE(pad_->strengths.empty());
  EXPECT_TRUE(pad_->heard().empty());
  tick(30, 1.0);
  ASSERT_FALSE(pad_->strengths.empty());
  EXPECT_NEAR(pad_->strengths.back(), 65'535 / 4, 1); // 4 N is all it has
  const auto begun = pad_->heard();
  ASSERT_FALSE(begun.empty());
  EXPECT_EQ(begun.front().type, kForce);
  EXPECT_EQ(begun.front().code, 3); // the number that the kernel gave it
  EXPECT_EQ(begun.front().value, 1);
  tick(30, 9.0);
  EXPECT_EQ(pad_->strengths.back(), 65'535);
  (void)pad_->heard();
  tick(30, 0.0);
  const auto ended = pad_->heard();
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended.front().value, 0);
  EXPECT_EQ(pad_->effects, 1);
}

// an effect lasts 0.2 s, so that a program that stops leaves none; and no bus is flooded
TEST_F(Gamepad, TellsAForceThatLastsAgainAndNoOftenerThanAMotorFollows)
{
  open();
  tick(1000, 2.0);
  EXPECT_GE(pad_->strengths.size(), 10U);
  EXPECT_LE(pad_->strengths.size(), 12U);
  pad_->strengths.clear();
  for (int i = 0; i < 1000; ++i)
  {
    tick(1, 1.0 + i % 2);
  }
  EXPECT_LE(pad_->strengths.size(), 51U);
  (void)pad_->heard();
  AllocationGuard guard;
  DriverSample sample;
  (void)driver_->tick(Vector3d(0, 0, 3.0), 1.0_ms, sample);
  EXPECT_EQ(guard.count(), 0U);
}

TEST_F(Gamepad, LeavesNoRumbleWhereItEndsOrTheForceIsNoNumber)
{
  open();
  tick(30, 2.0);
  (void)pad_->heard();
  tick(30, std::nan(""));
  ASSERT_EQ(pad_->heard().back().value, 0);
  tick(30, 2.0);
  (void)pad_->heard();
  driver_.reset();
  ASSERT_EQ(pad_->heard().back().value, 0);
}

TEST_F(Gamepad, WithoutMotorsItMovesTheToolAndIsToldNothing)
{
  open(false);
  tick(100, 3.0);
  EXPECT_TRUE(pad_->heard().empty());
  EXPECT_TRUE(pad_->strengths.empty());
}

TEST_F(Gamepad, ItsButtonsAreHeldAlsoWhereEventsWereDropped)
{
  open();
  pad_->tell(kKey, 0x131, 1);
  pad_->tell(kKey, 0x1E, 1); // of a keyboard
  tick(3);
  EXPECT_EQ(sample_.buttons, 2U);
  pad_->southIsHeld = true;
  pad_->stickX = 32'767;
  pad_->tell(0, 3, 0); // SYN_DROPPED: what it says from now on is no longer all
  tick(500);
  EXPECT_EQ(sample_.buttons, 1U);
  EXPECT_NEAR(sample_.position.x(), 30.0_mm, 0.2_mm);
}

TEST_F(Gamepad, ItsEndIsTold)
{
  open();
  tick(10, 1.0);
  pad_->unplug();
  EXPECT_EQ(driver_->tick(Vector3d::Zero(), 1.0_ms, sample_), IoCode::Gone);
}

TEST_F(Gamepad, SaysInOneSentenceWhatIsMissing)
{
  for (const char* name : { "gamepad:/dev/null", "gamepad:/nowhere/event3" })
  {
    expectRefusedInOneSentence(name);
  }
  EXPECT_TRUE(listGamepads("/nowhere").empty());
}

} // namespace
} // namespace palp
