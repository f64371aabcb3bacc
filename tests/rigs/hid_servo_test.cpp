// The whole chain: servo thread, law, safety chain, device thread, hidapi, and a board that moves.

#include "tests/rigs/hid_servo.h"

#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;
using test::Board;
using test::CountedDevice;
using test::kName;
using test::reachFor;

using HidServo = test::HidServo;

TEST_F(HidServo, FiveThousandTicksLoseNoReply)
{
  traffic_.times.reserve(20'000);
  start(openCounted());
  while (traffic_.heard < 5000 || board_->pushes < 500)
  {
    pressDown();
  }
  servo_.reset();
  device_.reset();
  EXPECT_EQ(traffic_.lost, 0);
  std::ranges::sort(traffic_.times);
  std::printf("median exchange %.1f us\n", traffic_.times[traffic_.times.size() / 2]); // no gate
}

// Law, coupling, torques, currents, wire, torques, force, each where the arm was when its answer
// was heard: on a busy machine it has gone on since. Without a guardian, which lets a force return
// from zero where the program was held up for 3 ms.
TEST_F(HidServo, TheBoardPushesAsTheChainSays)
{
  start(openCounted());
  const auto isStrong = [](const Sample& sample) { return sample.force.norm() > 0.5; };
  while (std::ranges::count_if(samples_, isStrong) < 200)
  {
    pressDown();
    const int packets = board_->packets; // until it rests
    waitFor([&](const Sample&) { return board_->packets > packets + 200; });
  }
  disarm();
  waitFor([this](const Sample&)
    { return samples_.back().state == DeviceState::Ready && board_->last == 0; });
  ASSERT_EQ(servo_->history().dropped(), 0U);
  servo_.reset();
  device_.reset();
  unplug();

  ASSERT_EQ(traffic_.from.size(), board_->pushed.size());
  auto from = samples_.cbegin();
  double strongest = 0.0;
  double turned = 0.0; // [rad] the most that the nearest force of the chain is away
  for (std::size_t i = 0; i < board_->pushed.size(); ++i)
  {
    const auto& at = board_->places.at(traffic_.from[i] - 1);
    const Vector3d felt = test::inScene(test::woodenForce(at, board_->pushed[i]));
    const double rounding = test::woodenRounding(at);
    const auto isFelt = [&](const Sample& sample)
    { return (felt - sample.force).norm() <= 1e-4 * sample.force.norm() + rounding; };
    const auto found = std::find_if(from, samples_.cend(), isFelt);
    ASSERT_NE(found, samples_.cend()) << "packet " << i << ": felt " << felt.transpose();
    from = found;
    if (felt.norm() > 0.5)
    {
      double least = 1.0;
      for (auto sample = samples_.cbegin(); sample != samples_.cend(); ++sample)
      {
        const double sine = felt.cross(sample->force).norm() / (felt.norm() * sample->force.norm());
        least = isFelt(*sample) ? std::min(least, sine) : least;
      }
      turned = std::max(turned, least);
    }
    strongest = std::max(strongest, felt.norm());
  }
  EXPECT_GT(strongest, 0.5);
  RecordProperty("turned_deg", std::to_string(turned / 1.0_deg));
}

// counted in ticks, not on a clock: the force that the servo has just found goes out, and in the
// device's thread the one that it has just taken
TEST_F(HidServo, AStopIsZeroOnTheWireAtOnceAndStays)
{
  auto counted = std::make_unique<CountedDevice>(openCounted(), traffic_);
  CountedDevice& device = *counted;
  start(std::move(counted));
  std::vector<double> took; // [ms]
  for (int round = 0; round < 9; ++round)
  {
    pressDown();
    const auto asked = Board::Clock::now();
    servo_->setEmergencyStop(true);
    const int handed = device.handed;
    waitFor(
      [&](const Sample& sample) { return has(sample, Flag::EmergencyStop) && board_->last == 0; });
    const int packets = board_->packets;
    waitFor([&](const Sample&) { return board_->packets > packets + 20; });
    took.push_back(
      std::chrono::duration<double, std::milli>(board_->lastPush.load() - asked).count());
    EXPECT_LE(device.handed - handed, 1);
    EXPECT_LE(traffic_.pushes - device.before, 1);
    EXPECT_EQ(board_->last, 0);
    board_->reach = 0;
    waitFor([](const Sample& sample) { return sample.contact.depth == 0.0; });
    servo_->setEmergencyStop(false);
  }
  std::ranges::sort(took);
  std::printf("last force after a stop: median %.2f ms, largest %.2f ms\n", took[4], took[8]);
}

TEST_F(HidServo, ACommandThatDoesNotArriveLeavesNoCurrent)
{
  start(openCounted());
  pressDown();
  traffic_.fails = true;
  waitFor([&](const Sample&) { return traffic_.closed == 1; });
  EXPECT_TRUE(traffic_.rests);
  waitFor([this](const Sample&) { return board_->last == 0; });
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
  const Sample ended = waitFor(
    [](const Sample& sample)
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
