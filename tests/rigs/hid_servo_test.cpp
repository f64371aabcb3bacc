// The whole chain: servo thread, law, safety chain, device thread, hidapi, and a board that moves.

#include "haptics/devices/threaded_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/servo/servo.h"
#include "haptics/units.h"
#include "tests/rigs/hid_rig.h"
#include "tests/support/surfaces.h"

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

  // as long as a machine under load may take; keeps every sample
  template <typename Condition>
  Sample waitFor(const Condition& condition)
  {
    Sample sample = servo_->newest();
    for (; !condition(sample); sample = servo_->newest())
    {
      std::this_thread::sleep_for(1ms);
      servo_->history().drain([this](const Sample& one) { samples_.push_back(one); });
    }
    return sample;
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
  std::vector<Sample> samples_; // all that came while something was waited for
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
        std::make_unique<CountedTransport>(openHid(kNode), traffic), WoodenArm{}, 64);
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

// Law, coupling, torques, currents, wire, torques, force: what a hand at the board would feel. The
// device takes the newest force when it wants one, so that the forces at the board are some of
// those that the chain said, in their order.
TEST_F(HidServo, TheBoardPushesAsTheChainSays)
{
  start(openDevice(kName, placement()));
  pressDown();
  const int whole = board_->pushes;
  waitFor([&](const Sample&) { return board_->pushes > whole + 300; });
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
        std::make_unique<CountedTransport>(openHid(kNode), traffic), WoodenArm{}, 64);
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
