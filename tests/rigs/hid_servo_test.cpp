// The whole chain: servo thread, law, safety chain, device thread, hidapi, and a board that moves.

#include "haptics/devices/threaded_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/servo/servo.h"
#include "haptics/units.h"
#include "tests/rigs/hid_rig.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
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

Vector3d placeAt(int reach)
{
  const auto& start = Board::kStart;
  return test::woodenTool(test::WoodenCounts{ start[0], start[1], start[2] + reach });
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

// what goes through, and for how long each answer takes
struct Traffic
{
  std::atomic<bool> fails = false; // the next command, and it alone
  std::atomic<int> heard = 0;
  std::atomic<int> lost = 0;      // answers that were never heard
  std::atomic<int> pushes = 0;    // commands whose currents are not all zero
  std::atomic<bool> rests = true; // the last command has none
  std::atomic<int> closed = 0;
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
  ~CountedTransport() override
  {
    ++traffic_.closed;
  }
  CountedTransport(const CountedTransport&) = delete;
  CountedTransport& operator=(const CountedTransport&) = delete;
  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override
  {
    const IoResult result = wire_->read(into, timeout);
    if (result.code == IoCode::Ok)
    {
      const auto turns = Board::turnsOfTheWrist(into);
      traffic_.lost += ++traffic_.heard == 1 ? 0 : static_cast<std::uint16_t>(turns - turns_ - 1);
      turns_ = turns;
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
    traffic_.rests = std::ranges::all_of(
      bytes.subspan(1, 6), [](std::byte byte) { return byte == std::byte{ 0 }; });
    traffic_.pushes += traffic_.rests ? 0 : 1;
    return wire_->write(bytes);
  }

private:
  std::unique_ptr<Transport> wire_;
  Traffic& traffic_;
  Board::Clock::time_point asked_;
  std::uint16_t turns_ = 0;
};

// forces that the servo hands on, counted with those that go out
class CountedDevice final : public Device
{
public:
  CountedDevice(std::unique_ptr<Device> device, Traffic& traffic)
    : device_(std::move(device))
    , traffic_(traffic)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return device_->limits();
  }
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return device_->status();
  }
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Vector3d& force, double dt) noexcept override
  {
    handed += force.isZero(0.0) ? 0 : 1;
    const auto pose = device_->exchange(force, dt);
    if (!force.isZero(0.0))
    {
      before = -1;
    }
    else if (before < 0)
    {
      before = traffic_.pushes.load();
    }
    return pose;
  }

  std::atomic<int> handed = 0;  // forces that were not zero
  std::atomic<int> before = -1; // pushes when the first zero after them was handed on

private:
  std::unique_ptr<Device> device_;
  Traffic& traffic_;
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

  // as long as a machine under load may take; keeps every sample
  template <typename Condition>
  Sample waitFor(const Condition& condition)
  {
    const auto end = Board::Clock::now() + 60s;
    Sample sample = servo_->newest();
    for (; !condition(sample); sample = servo_->newest())
    {
      if (Board::Clock::now() > end)
      {
        throw std::runtime_error("did not come within a minute");
      }
      std::this_thread::sleep_for(1ms);
      servo_->history().drain([this](const Sample& one) { samples_.push_back(one); });
    }
    return sample;
  }
  Sample waitForState(DeviceState state)
  {
    return waitFor([state](const Sample& sample) { return sample.state == state; });
  }

  // whether the force comes; a machine under load may take it until it is asked for again
  [[nodiscard]] bool getsForce()
  {
    disarm();
    waitForState(DeviceState::Ready);
    arm(true);
    const double soon = servo_->newest().time + 0.02; // when the servo has heard of it
    return isForced(waitFor([soon](const Sample& sample)
      {
        return isForced(sample) ||
          (sample.time > soon && (has(sample, Flag::Late) || has(sample, Flag::Jump)));
      }));
  }

  // again, where a machine under load has interrupted the force: it is whole once the tool lifted
  void pressDown()
  {
    do
    {
      board_->reach = 0;
      waitFor([](const Sample& sample) { return sample.contact.depth == 0.0; });
      if (getsForce())
      {
        waitFor([](const Sample& sample) { return sample.state != DeviceState::SoftStart; });
      }
      board_->reach = reachFor(9.0_mm);
      waitFor([](const Sample& sample) { return sample.contact.depth > 3.9_mm; });
    } while (board_->last == 0 || has(servo_->newest(), Flag::Reseated));
  }

  [[nodiscard]] std::unique_ptr<ThreadedDevice> openCounted(Traffic& traffic) const
  {
    return std::make_unique<ThreadedDevice>(
      [&traffic]
      {
        return std::make_unique<WoodenDriver>(
          std::make_unique<CountedTransport>(openHid(kNode), traffic), WoodenArm{}, 64);
      },
      placement());
  }

  [[nodiscard]] static bool isForced(const Sample& sample)
  {
    return sample.state == DeviceState::SoftStart || sample.state == DeviceState::Active;
  }

  [[nodiscard]] static bool has(const Sample& sample, Flag flag)
  {
    return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
  }

  Scene scene_;
  std::vector<Sample> samples_; // all that came while something was waited for
  std::unique_ptr<Device> device_;
  std::unique_ptr<Servo> servo_;
};

TEST_F(HidServo, FiveThousandTicksLoseNoReply)
{
  Traffic traffic;
  traffic.times.reserve(20'000);
  start(openCounted(traffic));
  while (traffic.heard < 5000 || board_->pushes < 500)
  {
    pressDown();
  }
  servo_.reset();
  device_.reset();
  EXPECT_EQ(traffic.lost, 0);
  std::ranges::sort(traffic.times);
  std::printf("median exchange %.1f us\n", traffic.times[traffic.times.size() / 2]); // no gate
}

// Law, coupling, torques, currents, wire, torques, force: what a hand at the board would feel. The
// device takes the newest force when it wants one, so that the forces at the board are some of
// those that the chain said, in their order.
TEST_F(HidServo, TheBoardPushesAsTheChainSays)
{
  start(openDevice(kName, placement()));
  while (board_->pushes < 600)
  {
    pressDown();
    const int packets = board_->packets; // until it rests
    waitFor([&](const Sample&) { return board_->packets > packets + 300; });
  }
  disarm();
  waitFor([this](const Sample&)
    { return samples_.back().state == DeviceState::Ready && board_->last == 0; });
  ASSERT_EQ(servo_->history().dropped(), 0U);
  servo_.reset();
  device_.reset();
  unplug();

  auto from = samples_.cbegin();
  double strongest = 0.0;
  for (std::size_t i = 0; i < board_->pushed.size(); ++i)
  {
    const auto& [at, currents] = board_->pushed[i];
    const Vector3d felt = test::woodenForce(at, currents);
    const double rounding = test::woodenRounding(at);
    const auto isFelt = [&](const Sample& sample) // to 0.5 degrees, 0.9 %
    { return (felt - sample.force).norm() <= 0.0087 * sample.force.norm() + rounding; };
    const auto found = std::find_if(from, samples_.cend(), isFelt);
    ASSERT_NE(found, samples_.cend()) << "packet " << i << ": felt " << felt.transpose();
    from = found;
    strongest = std::max(strongest, felt.norm());
  }
  EXPECT_GT(strongest, 0.3);
}

// counted in ticks, not on a clock: the force that the servo has just found goes out, and in the
// device's thread the one that it has just taken
TEST_F(HidServo, AStopIsZeroOnTheWireAtOnceAndStays)
{
  Traffic traffic;
  auto counted = std::make_unique<CountedDevice>(openCounted(traffic), traffic);
  CountedDevice& device = *counted;
  start(std::move(counted));
  std::vector<double> took; // [ms]
  for (int round = 0; round < 9; ++round)
  {
    pressDown();
    const auto asked = Board::Clock::now();
    servo_->setEmergencyStop(true);
    const int handed = device.handed;
    waitFor([&](const Sample& sample)
      { return has(sample, Flag::EmergencyStop) && board_->last == 0; });
    const int packets = board_->packets;
    waitFor([&](const Sample&) { return board_->packets > packets + 20; });
    took.push_back(
      std::chrono::duration<double, std::milli>(board_->lastPush.load() - asked).count());
    EXPECT_LE(device.handed - handed, 1);
    EXPECT_LE(traffic.pushes - device.before, 1);
    EXPECT_EQ(board_->last, 0);
    board_->reach = 0;
    waitFor([](const Sample& sample) { return sample.contact.depth == 0.0; });
    servo_->setEmergencyStop(false);
  }
  std::ranges::sort(took);
  std::printf("last force after a stop: median %.2f ms, largest %.2f ms\n", took[4], took[8]);
  servo_.reset();
  device_.reset(); // while its traffic is there
}

TEST_F(HidServo, ACommandThatDoesNotArriveLeavesNoCurrent)
{
  Traffic traffic;
  start(openCounted(traffic));
  pressDown();
  traffic.fails = true;
  waitFor([&](const Sample&) { return traffic.closed == 1; });
  EXPECT_TRUE(traffic.rests);
  waitFor([this](const Sample&) { return board_->last == 0; });
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
  const Sample ended = waitFor([](const Sample& sample)
    {
      return sample.state == DeviceState::Ready &&
        (has(sample, Flag::Stale) || has(sample, Flag::Jump));
    });
  EXPECT_EQ(ended.force, Vector3d::Zero());
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
      while (!getsForce())
      {
      }
      return;
    }
    else if (state == DeviceState::Active || state == DeviceState::Decay)
    {
      pressDown();
      arm(state == DeviceState::Active);
    }
    // a machine under load may have left it before anybody looks
    waitFor(
      [state](const Sample& sample)
      {
        return sample.state == state ||
          (state == DeviceState::Active && sample.state == DeviceState::SoftStart) ||
          (state > DeviceState::Ready && sample.state == DeviceState::Ready);
      });
  }
};
INSTANTIATE_TEST_SUITE_P(Wire, HidServoUnplug,
  ::testing::Values(DeviceState::NeedsHoming, DeviceState::Ready, DeviceState::SoftStart,
    DeviceState::Active, DeviceState::Decay));

TEST_P(HidServoUnplug, IsToldAndComesBackWithoutForce)
{
  reach(GetParam());
  samples_.clear();
  const double before = servo_->newest().time; // up to a tick ago, which counts against the servo
  const auto asked = Board::Clock::now();
  std::thread puller([this] { board_->unplug(); }); // its wire, at once; then its place in /sys
  const Sample gone = waitForState(DeviceState::Closed);
  puller.join();
  double noticed = std::numeric_limits<double>::infinity(); // time of the first tick without it
  for (const Sample& sample : samples_)
  {
    noticed = sample.state == DeviceState::Closed ? std::min(noticed, sample.time) : noticed;
  }
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
  while (!getsForce())
  {
  }
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
