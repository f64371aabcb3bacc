// The hands of a session: their devices and servo threads.

#include "app/arms/arm_file.h"
#include "app/session/session.h"
#include "haptics/devices/simulated/lagging_tool.h"
#include "haptics/devices/simulated/pointer.h"
#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/devices/simulated/simulated_hand.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/servo/safety.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace palp
{

ToolPose Session::restingPose(const Eigen::Vector3d& up) const
{
  // above the highest point of all, pointing down
  std::optional<Eigen::Vector3d> highest;
  for (const SceneBody& body :
    body_.organs.empty() ? std::span(&body_, 1) : std::span(body_.organs))
  {
    for (const Eigen::Vector3d& point : body.haptic->points())
    {
      highest = !highest || highest->dot(up) < point.dot(up) ? point : *highest;
    }
  }
  return { .apex = *highest + kClearance * up, .axis = -up };
}

// the second hand to the right of the first
DevicePlacement Session::placement(std::size_t hand) const
{
  constexpr double kApart = 0.04; // [m]
  DevicePlacement placement = plan_.placement;
  placement.rotation = facing_;
  placement.origin =
    restingPose(facing_.col(2)).apex + static_cast<double>(hand) * kApart * facing_.col(0);
  return placement;
}

std::unique_ptr<Device> Session::makeDevice(std::size_t hand, const DeviceChoice& choice)
{
  switch (choice.kind)
  {
    case DeviceChoice::Kind::Mouse:
      return std::make_unique<Pointer>(restingPose());
    case DeviceChoice::Kind::Hand:
      return std::make_unique<SimulatedHand>(restingPose());
    case DeviceChoice::Kind::Script:
      return std::make_unique<ScriptedDevice>(readPath(choice.file));
    case DeviceChoice::Kind::Driver:
      break;
  }
  if (!namesHardware(choice.name))
  {
    throw Error(ErrorCode::BadValue,
      "--device: '" + choice.name +
        "' is no device; give mouse, hand, path:FILE.csv, replay:samples.csv, " + kHardwareNames);
  }
  if (hand < hands_.size() && choice.name == hands_[hand].choice.name)
  {
    hands_[hand].servo.reset();
    hands_[hand].device.reset();
  }
  return openDevice(choice.name, placement(hand), loadArm(armFile(identityOf(choice.name))));
}

void Session::useDevice(const DeviceChoice& choice)
{
  hasSecond() ? checkHands(choice, hands_.back().choice) : void();
  try
  {
    hold(0, choice, makeDevice(0, choice));
  }
  catch (...)
  {
    keepHolding();
    throw;
  }
}

void Session::useDevice(const DeviceChoice& choice, std::unique_ptr<Device> device)
{
  hold(0, choice, std::move(device));
}

void Session::useSecond(const std::optional<DeviceChoice>& choice)
{
  if (!choice)
  {
    endRecording(body_);
    stopServos();
    hands_.resize(1);
    startServos();
    return;
  }
  checkHands(first().choice, *choice);
  try
  {
    hold(1, *choice, makeDevice(1, *choice));
  }
  catch (...)
  {
    keepHolding();
    throw;
  }
}

void Session::useSecond(const DeviceChoice& choice, std::unique_ptr<Device> device)
{
  hold(1, choice, std::move(device));
}

void Session::lag(bool lags)
{
  lagReference_ = lags ? std::optional(recording_.scene.law.material()) : std::nullopt;
  useDevice(DeviceChoice(first().choice));
}

// hardware can be opened once only: what is open must be let go of before it is opened again, and
// where that fails the mouse takes the tool, and a second hand ends
void Session::keepHolding()
{
  if (hasSecond() && !hands_.back().device)
  {
    useSecond(std::nullopt);
  }
  if (!first().device)
  {
    useDevice(DeviceChoice{});
  }
}

void Session::hold(std::size_t number, const DeviceChoice& choice, std::unique_ptr<Device> device)
{
  endRecording(body_);
  stopServos(); // before their devices go
  give(number, choice, std::move(device));
  startServos();
}

void Session::give(std::size_t number, const DeviceChoice& choice, std::unique_ptr<Device> device)
{
  hands_.resize(std::max(hands_.size(), number + 1));
  Hand& hand = hands_[number];
  hand.lagging = nullptr;
  const bool isFree = !choice.isScript() && !device->limits().rendersForce;
  if (lagReference_ && isFree && number == 0)
  {
    auto lagging = std::make_unique<LaggingTool>(std::move(device), *lagReference_);
    hand.lagging = lagging.get();
    hand.lagging->setScene(recording_.scene);
    device = std::move(lagging);
  }
  hand.device = std::move(device);
  hand.guided = hand.device->guided();
  hand.choice = choice;
}

bool Session::isPlaced() const
{
  return std::ranges::any_of(hands_, &Hand::isPlaced);
}

bool Session::turnDevice(const Eigen::Matrix3d& seen)
{
  return placeDevices(seen, scale());
}

bool Session::scaleDevice(double scale)
{
  return placeDevices(facing_, scale);
}

bool Session::placeDevices(const Eigen::Matrix3d& facing, double scale)
{
  if (!isPlaced())
  {
    return false;
  }
  endRecording(body_);
  stopServos(); // before their devices go elsewhere
  facing_ = facing;
  plan_.placement.scale = scale;
  bool placed = false;
  for (std::size_t i = 0; i < hands_.size(); ++i)
  {
    placed = (hands_[i].isPlaced() && hands_[i].device->place(placement(i))) || placed;
  }
  startServos();
  return placed;
}

void Session::holdTools(bool held)
{
  for (Hand& hand : hands_)
  {
    hand.device->hold(held);
  }
}

void Session::stopServos()
{
  for (Hand& hand : hands_)
  {
    hand.servo.reset();
  }
}

void Session::startServos()
{
  const auto canBeHurt = [](const Hand& hand)
  { return hand.choice.kind != DeviceChoice::Kind::Hand && hand.device->limits().rendersForce; };
  recording_.scene.armed =
    first().choice.kind == DeviceChoice::Kind::Hand && std::ranges::none_of(hands_, canBeHurt);
  recording_.device = first().choice.name;
  recording_.second.reset();
  armedAt_ = 0.0;
  recordedFrom_ = 0.0;
  fault_ = false;
  ServoOptions options = servoOptions_;
  if (hasSecond())
  {
    recording_.second.emplace().device = hands_.back().choice.name;
    options.fault = &fault_;
    options.epoch = std::chrono::steady_clock::now();
  }
  for (Hand& hand : hands_)
  {
    hand.guided != nullptr ? hand.guided->setScene(recording_.scene) : void();
    hand.servo = std::make_unique<Servo>(*hand.device, recording_.scene, options);
  }
}

void Session::tellScene()
{
  for (Hand& hand : hands_)
  {
    hand.guided != nullptr ? hand.guided->setScene(recording_.scene) : void();
    hand.lagging != nullptr ? hand.lagging->setScene(recording_.scene) : void();
    hand.servo->setScene(recording_.scene);
  }
}

ScriptedDevice* Session::scripted() const noexcept
{
  return dynamic_cast<ScriptedDevice*>(first().device.get());
}

std::vector<std::string> Session::devices()
{
  std::vector<std::string> names{ "mouse", "hand" };
  for (const FoundDevice& found : findDevices())
  {
    if (found.unusableReason.empty())
    {
      std::ranges::copy(namesOf(found), std::back_inserter(names));
    }
  }
  return names;
}

void Session::arm(bool armed)
{
  fault_ = false;
  recording_.scene.armed = armed;
  armedAt_ = newest().time + kForgiving;
  for (Hand& hand : hands_)
  {
    hand.servo->setScene(recording_.scene);
  }
}

void Session::disarmAtFault()
{
  bool failed = fault_;
  for (Hand& hand : hands_)
  {
    const Sample& sample = hand.servo->newest();
    failed = failed || (sample.time > armedAt_ && isFault(sample.state, sample.flags));
  }
  armed() && failed ? arm(false) : void();
}

bool Session::rendersForce() const
{
  return std::ranges::any_of(
    hands_, [](const Hand& hand) { return hand.device->limits().rendersForce; });
}

double Session::stableStiffness() const
{
  double stiffest = std::numeric_limits<double>::infinity();
  for (const Hand& hand : hands_)
  {
    if (const DeviceLimits limits = hand.device->limits(); limits.rendersForce)
    {
      stiffest = std::min(stiffest, SafetyChain(limits).stiffnessLimit(recording_.scene.damping));
    }
  }
  return stiffest;
}

double Session::largestForce() const
{
  double largest = recording_.scene.forceLimit;
  for (const Hand& hand : hands_)
  {
    const DeviceLimits limits = hand.device->limits();
    largest = limits.rendersForce ? std::min(largest, limits.maxForce) : largest;
  }
  return largest;
}

void Session::stop(bool stopped)
{
  if (!rendersForce())
  {
    return; // nothing to stop, and nobody could take it back
  }
  for (Hand& hand : hands_)
  {
    hand.device->limits().rendersForce ? hand.servo->setEmergencyStop(stopped) : void();
  }
  if (stopped)
  {
    arm(false);
  }
}

void Session::aim(const PressTarget& target)
{
  if (first().guided != nullptr)
  {
    first().guided->moveTo(target);
  }
}

} // namespace palp
