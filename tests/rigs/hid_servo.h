#pragma once

// A servo that presses with the arm of hid_rig.h, and what counts its traffic. For one source file
// of a program only, as hid_rig.h.

#include "haptics/devices/bus_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/servo/servo.h"
#include "haptics/units.h"
#include "tests/rigs/hid_rig.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace palp::test
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;

inline const std::string kName = std::string("wooden:") + kNode;

inline Vector3d positionAt(int reach)
{
  const auto& start = Board::kStart;
  return woodenTool(WoodenCounts{ start[0], start[1], start[2] + reach });
}

// from the arm's frame, with x to the user and y right, to that of the scene
inline Vector3d inScene(const Vector3d& ofArm)
{
  return { ofArm.y(), -ofArm.x(), ofArm.z() };
}

// counts after which the arm is so much lower than at its start
inline int reachFor(double travel)
{
  const int down = positionAt(1).z() < positionAt(0).z() ? 1 : -1;
  int reach = 0;
  while (positionAt(0).z() - positionAt(reach).z() < travel)
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
  std::vector<std::size_t> from; // of each push, the packet whose answer was heard last; as times
  std::vector<double> times;     // from a command to the first answer [us]; read after the end
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
      packet_ += static_cast<std::uint16_t>(turns - turns_);
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
    if (!traffic_.rests)
    {
      traffic_.from.push_back(packet_);
    }
    return wire_->write(bytes);
  }

private:
  std::unique_ptr<Transport> wire_;
  Traffic& traffic_;
  Board::Clock::time_point asked_;
  std::uint16_t turns_ = 0;
  std::size_t packet_ = 0; // that was answered last
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
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override
  {
    handed += wrench.isZero() ? 0 : 1;
    const auto pose = device_->exchange(wrench, dt);
    if (!wrench.isZero())
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

class HidServo : public HidRig
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
    return { .origin = Vector3d(0, 0, -4.0_mm) - inScene(positionAt(reachFor(9.0_mm))) };
  }

  void start(std::unique_ptr<Device> device)
  {
    scene_.surface = std::make_shared<const Surface>(makeSurface(block({ 0.1, 0.1, 0.05 }, 4)));
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
    return isForced(
      waitFor([soon](const Sample& sample) { return isForced(sample) || sample.time > soon; }));
  }

  // again, where a machine under load has interrupted the force: it is whole once the tool lifted,
  // and where its taps looked like swings that grow, once it was away for two seconds
  void pressDown()
  {
    double away = 0.0;
    do
    {
      board_->reach = 0;
      const Sample up = waitFor([](const Sample& sample) { return sample.contact.depth == 0.0; });
      waitFor([&](const Sample& sample) { return sample.time >= up.time + away; });
      away = 2.1;
      if (getsForce())
      {
        waitFor([](const Sample& sample) { return sample.state != DeviceState::SoftStart; });
      }
      board_->reach = reachFor(9.0_mm);
      waitFor([](const Sample& sample) { return sample.contact.depth > 3.9_mm; });
    } while (board_->last == 0 || has(servo_->newest(), Flag::Rebased));
  }

  [[nodiscard]] std::unique_ptr<BusDevice> openCounted()
  {
    return std::make_unique<BusDevice>(
      [this]
      {
        return std::make_unique<WoodenDriver>(
          std::make_unique<CountedTransport>(openHid(kNode), traffic_), WoodenArm{}, 64);
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
  Traffic traffic_;             // of what openCounted() opens
  std::vector<Sample> samples_; // all that came while something was waited for
  std::unique_ptr<Device> device_;
  std::unique_ptr<Servo> servo_;
};

} // namespace palp::test
