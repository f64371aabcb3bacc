// The whole chain: servo thread, law, safety chain, device thread, hidapi, and a board that moves.

#include "haptics/devices/threaded_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/servo/servo.h"
#include "haptics/units.h"
#include "tests/rigs/hid_rig.h"
#include "tests/support/surfaces.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;
using test::Board;
using test::kNode;

const std::string kName = std::string("wooden:") + kNode;
const WoodenArm kArm;

Vector3d placeAt(int reach)
{
  const auto& start = Board::kStart;
  return placeOf(kArm,
    bodyAngles(kArm, { start[0], start[1], static_cast<std::int16_t>(start[2] + reach), 0, 0, 0 }));
}

// counts after which the arm is so much lower than at its start
int reachFor(double way)
{
  const int down = placeAt(1).z() < placeAt(0).z() ? 1 : -1;
  int reach = 0;
  while (placeAt(0).z() - placeAt(reach).z() < way)
  {
    reach += down;
  }
  return reach;
}

// counts what goes through, and for how long each answer takes
struct Traffic
{
  std::atomic<bool> fails = false; // the next command, and it alone
  std::atomic<int> sent = 0;
  std::atomic<int> heard = 0;
  std::vector<double> times; // from a command to the first answer [us]; read after the end
};

class CountedTransport final : public Transport
{
public:
  CountedTransport(std::unique_ptr<Transport> wire, Traffic& traffic)
    : wire_(std::move(wire))
    , traffic_(traffic)
  {
  }
  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override
  {
    const IoResult result = wire_->read(into, timeout);
    if (result.code == IoCode::Ok)
    {
      ++traffic_.heard;
      traffic_.times.push_back(
        std::chrono::duration<double, std::micro>(Board::Clock::now() - asked_).count());
    }
    return result;
  }
  [[nodiscard]] IoCode write(Bytes bytes) noexcept override
  {
    if (traffic_.fails.exchange(false))
    {
      return IoCode::Gone;
    }
    asked_ = Board::Clock::now();
    ++traffic_.sent;
    return wire_->write(bytes);
  }

private:
  std::unique_ptr<Transport> wire_;
  Traffic& traffic_;
  Board::Clock::time_point asked_;
};

class HidServo : public test::HidRig
{
protected:
  void TearDown() override
  {
    servo_.reset();
    device_.reset();
    HidRig::TearDown();
  }

  // the tool stands 5 mm above a block, and 4 mm deep in it once the arm has reached down
  [[nodiscard]] static DevicePlacement placement()
  {
    return { .origin = Vector3d(0, 0, -4.0_mm) - placeAt(reachFor(9.0_mm)) };
  }

  void start(std::unique_ptr<Device> device)
  {
    scene_.surface =
      std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 4)));
    device_ = std::move(device);
    servo_ = std::make_unique<Servo>(*device_, scene_);
  }

  void arm(bool armed)
  {
    scene_.armed = armed;
    servo_->setScene(scene_);
  }

  // until the servo has heard of it
  void disarm()
  {
    arm(false);
    const double now = servo_->newest().time;
    waitFor([now](const Sample& sample) { return sample.time > now + 0.02; });
  }

  // as long as a machine under load may take
  template <typename Condition>
  Sample waitFor(const Condition& condition)
  {
    while (!condition(servo_->newest()))
    {
      std::this_thread::sleep_for(1ms);
    }
    return servo_->newest();
  }
  Sample waitForState(DeviceState state)
  {
    return waitFor([state](const Sample& sample) { return sample.state == state; });
  }

  // again, where a machine under load has interrupted the force: it is whole once the tool lifted
  void pressDown()
  {
    do
    {
      disarm();
      board_->reach = 0;
      waitFor([](const Sample& sample)
        { return sample.state == DeviceState::Ready && sample.contact.depth == 0.0; });
      arm(true);
      waitForState(DeviceState::Active);
      board_->reach = reachFor(9.0_mm);
      waitFor([](const Sample& sample) { return sample.contact.depth > 3.9_mm; });
    } while (board_->last == 0 || has(servo_->newest(), Flag::Reseated));
  }

  [[nodiscard]] static bool has(const Sample& sample, Flag flag)
  {
    return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
  }

  Scene scene_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Servo> servo_;
};

TEST_F(HidServo, FiveThousandTicksLoseNoReply)
{
  Traffic traffic;
  traffic.times.reserve(20'000);
  start(std::make_unique<ThreadedDevice>(
    [&traffic]
    {
      return std::make_unique<WoodenDriver>(
        std::make_unique<CountedTransport>(openHid(kNode), traffic), kArm, 64);
    },
    placement()));
  waitForState(DeviceState::Ready);
  arm(true);
  waitForState(DeviceState::Active);
  while (traffic.heard < 5000) // down and up again, each some 0.15 s
  {
    board_->reach = traffic.heard / 300 % 2 == 0 ? reachFor(9.0_mm) : 0;
    (void)servo_->newest();
    std::this_thread::sleep_for(1ms);
  }
  servo_.reset();
  device_.reset();
  EXPECT_EQ(board_->packets, traffic.sent);
  EXPECT_LE(traffic.sent - traffic.heard, 1); // the last may come when nobody listens any more
  EXPECT_GT(board_->pushes, 500);
  std::ranges::sort(traffic.times);
  std::printf("median exchange %.1f us\n", traffic.times[traffic.times.size() / 2]); // no gate
}

// law, coupling, torques, currents, wire, torques, force: what a hand at the board would feel
TEST_F(HidServo, TheBoardPushesAsTheChainSays)
{
  start(openDevice(kName, placement()));
  do
  {
    pressDown();
    const int packets = board_->packets; // until it rests
    waitFor([&](const Sample&) { return board_->packets > packets + 300; });
  } while (has(servo_->newest(), Flag::Reseated));
  const Vector3d told = servo_->newest().force;
  Vector3d torques;
  for (int i = 0; i < 3; ++i)
  {
    const auto motor = static_cast<std::size_t>(i);
    torques[i] = board_->currents[motor] / 1000.0 * kArm.torque[motor] * kArm.sign[motor] *
      kArm.body[motor] / kArm.capstan[motor];
  }
  servo_.reset();
  device_.reset();
  unplug();
  const auto& at = board_->encoders;
  const Eigen::Matrix3d jacobian =
    placeJacobian(kArm, bodyAngles(kArm, { at[0], at[1], at[2], 0, 0, 0 }));
  const Vector3d felt = jacobian.transpose().inverse() * torques;
  ASSERT_GT(told.norm(), 0.3);
  EXPECT_NEAR(felt.norm(), told.norm(), 0.01 * told.norm());
  EXPECT_LT(std::acos(std::min(1.0, felt.normalized().dot(told.normalized()))), 0.5_deg);
}

TEST_F(HidServo, AStopIsZeroOnTheWireAtOnceAndStays)
{
  start(openDevice(kName, placement()));
  std::vector<int> late;    // packets with a force after the stop
  std::vector<double> took; // [ms]
  for (int round = 0; round < 9; ++round)
  {
    pressDown();
    const int before = board_->pushes;
    const auto asked = Board::Clock::now();
    servo_->setEmergencyStop(true);
    waitFor([this](const Sample& sample)
      { return has(sample, Flag::EmergencyStop) && board_->last == 0; });
    std::this_thread::sleep_for(20ms);
    late.push_back(board_->pushes - before);
    took.push_back(
      std::chrono::duration<double, std::milli>(board_->lastPush.load() - asked).count());
    EXPECT_EQ(board_->last, 0);
    board_->reach = 0;
    waitFor([](const Sample& sample) { return sample.contact.depth == 0.0; });
    servo_->setEmergencyStop(false);
    disarm();
  }
  std::ranges::sort(late);
  std::ranges::sort(took);
  std::printf("last force after a stop: median %.2f ms, largest %.2f ms\n", took[4], took[8]);
  EXPECT_LE(late[4], 2); // a tick of the servo and one of the device: 2 ms
}

TEST_F(HidServo, ACommandThatDoesNotArriveLeavesNoCurrent)
{
  Traffic traffic;
  start(std::make_unique<ThreadedDevice>(
    [&traffic]
    {
      return std::make_unique<WoodenDriver>(
        std::make_unique<CountedTransport>(openHid(kNode), traffic), kArm, 64);
    },
    placement()));
  pressDown();
  traffic.fails = true;
  waitForState(DeviceState::Closed);
  std::this_thread::sleep_for(100ms); // it is opened again after half a second
  EXPECT_EQ(board_->last, 0);
  servo_.reset();
  device_.reset(); // while its traffic is there
}

class HidServoFault
  : public HidServo
  , public ::testing::WithParamInterface<Board::Mood>
{
};
INSTANTIATE_TEST_SUITE_P(Wire, HidServoFault,
  ::testing::Values(Board::Mood::Silent, Board::Mood::Garbage, Board::Mood::Short));

TEST_P(HidServoFault, EndsInNoForceAndSaysWhy)
{
  start(openDevice(kName, placement()));
  pressDown();
  board_->mood = GetParam();
  const Sample ended = waitForState(DeviceState::Ready);
  EXPECT_EQ(ended.force, Vector3d::Zero());
  EXPECT_TRUE(has(ended, Flag::Stale) || has(ended, Flag::Jump));
  waitFor([this](const Sample&) { return board_->last == 0; });
  board_->mood = Board::Mood::Good;
  const int packets = board_->packets;
  waitFor([&](const Sample&) { return board_->packets > packets + 50; });
  EXPECT_EQ(board_->last, 0); // until it is armed anew
}

class HidServoUnplug
  : public HidServo
  , public ::testing::WithParamInterface<DeviceState>
{
protected:
  void reach(DeviceState state)
  {
    if (state == DeviceState::NeedsHoming)
    {
      board_->button = false;
    }
    start(openDevice(kName, placement()));
    if (state == DeviceState::SoftStart)
    {
      waitForState(DeviceState::Ready);
      board_->reach = reachFor(9.0_mm);
      waitFor([](const Sample& sample) { return sample.contact.depth > 3.9_mm; });
      arm(true);
    }
    else if (state == DeviceState::Active || state == DeviceState::Decay)
    {
      pressDown();
      arm(state == DeviceState::Active);
    }
    // two of them are over by themselves before a machine under load may look
    waitFor(
      [state](const Sample& sample)
      {
        return sample.state == state ||
          (state == DeviceState::SoftStart && sample.state == DeviceState::Active) ||
          (state == DeviceState::Decay && sample.state == DeviceState::Ready);
      });
  }
};
INSTANTIATE_TEST_SUITE_P(Wire, HidServoUnplug,
  ::testing::Values(DeviceState::NeedsHoming, DeviceState::Ready, DeviceState::SoftStart,
    DeviceState::Active, DeviceState::Decay));

TEST_P(HidServoUnplug, IsToldAndComesBackWithoutForce)
{
  reach(GetParam());
  servo_->history().drain([](const Sample&) {});
  const double before = servo_->newest().time; // up to a tick ago, which counts against the servo
  const auto asked = Board::Clock::now();
  std::thread puller([this] { board_->unplug(); }); // its wire, at once; then its place in /sys
  const Sample gone = waitForState(DeviceState::Closed);
  puller.join();
  double noticed = std::numeric_limits<double>::infinity(); // time of the first tick without it
  servo_->history().drain([&](const Sample& sample)
    { noticed = sample.state == DeviceState::Closed ? std::min(noticed, sample.time) : noticed; });
  const std::chrono::duration<double> waited = board_->pulled.load() - asked;
  std::printf("noticed after %.1f ms\n", 1e3 * (noticed - before - waited.count())); // no gate
  unplug();
  EXPECT_EQ(gone.force, Vector3d::Zero());
  EXPECT_TRUE(has(gone, Flag::DeviceLost));

  plugIn(); // a board that knows nothing
  board_->button = false;
  waitForState(DeviceState::NeedsHoming);
  board_->button = true;
  board_->reach = reachFor(9.0_mm);
  waitFor([](const Sample& sample) { return sample.contact.depth > 3.9_mm; });
  EXPECT_EQ(servo_->newest().state, DeviceState::Ready); // however it was armed before
  EXPECT_EQ(board_->pushes, 0);
  disarm();
  arm(true);
  waitFor([](const Sample& sample)
    { return sample.state == DeviceState::SoftStart || sample.state == DeviceState::Active; });
}

TEST_F(HidServo, AnotherBoardInItsPlaceIsLeftAlone)
{
  start(openDevice(kName, placement()));
  waitForState(DeviceState::Ready);
  unplug();
  waitForState(DeviceState::Closed);
  std::string other = test::kRecord;
  other.replace(other.find("product=Polhem"), 14, "product=Drone!");
  plugIn(other);
  const auto until = Board::Clock::now() + 1200ms; // it is looked for twice a second
  while (Board::Clock::now() < until)
  {
    ASSERT_EQ(servo_->newest().state, DeviceState::Closed);
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_EQ(board_->packets, 0);
  unplug();
  plugIn();
  waitForState(DeviceState::Ready);
}

} // namespace
} // namespace palp
