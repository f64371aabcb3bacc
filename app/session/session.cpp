#include "app/session/session.h"

#include "app/arms/arm_file.h"
#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/session/device_words.h"
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
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// a tool that nobody moves, away from the surface
bool restsAt(const Sample& before, const Sample& now)
{
  constexpr double kLength = 1e-7; // [m], less than any device tells
  constexpr double kAngle = 1e-6;  // [rad]
  const bool touches = before.contact.touching() || now.contact.touching();
  return !touches && before.force.isZero() && now.force.isZero() && before.flags == now.flags &&
    before.state == now.state && (before.pose.apex - now.pose.apex).norm() < kLength &&
    (before.pose.axis - now.pose.axis).norm() < kAngle;
}

// what is recorded of a press that has not begun
Recording startOf(const ScenePlan& plan, const SceneBody& body, BuildTrace& trace)
{
  Recording recording;
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.files = body.files;
  recording.command = commandLine();
  recording.rated = plan.validity && !body.training;
  recording.organs = plan.organs;
  recording.scene.rule = plan.press.contact;
  recording.scene.damping = plan.press.damping;
  recording.scene.law =
    trace.build("law", "tissue and tool", [&] { return plan.press.tissue.law(); });
  setTissues(recording.scene, plan.organs);
  setFelt(recording.scene, body, plan.organs);
  return recording;
}

} // namespace

Session::Session(ScenePlan plan, BuildTrace& trace, const std::atomic<bool>* stop)
  : plan_(std::move(plan))
  , servoOptions_{ .period = std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::duration<double>(plan_.servoPeriod)),
    .history = plan_.records(),
    .deadMan = plan_.deadMan,
    .stop = stop }
  , body_(trace.build("surface", "felt and shown", [&] { return loadBodies(plan_); }))
  , recording_(startOf(plan_, body_, trace))
  , calibration_(trace.build("calibration", "how far the surface gives way",
      [&] { return loadCalibration(plan_.press, recording_.scene); }))
{
  if (plan_.training && plan_.training->marks) // graded before
  {
    revealNodules(body_);
    recording_.rated = plan_.validity;
  }
  else if (plan_.training)
  {
    calibration_.style.extent = nullptr; // by which a dent would give away what lies below it
  }
  trace.build("device, servo thread", "the window presses live", [&] { useDevice(plan_.device); });
}

void Session::open(SceneBody body, std::vector<OrganPlan> organs)
{
  Scene scene = nextScene();
  scene.others.clear();
  scene.rule = organs.empty() ? scene.rule : organs.front().press.contact;
  setTissues(scene, organs);
  setFelt(scene, body, organs);
  Calibration calibration = loadCalibration(plan_.press, scene);
  SceneBody old = std::exchange(body_, std::move(body));
  const DeviceChoice choice = choice_;
  std::unique_ptr<Device> holder;
  try
  {
    holder = makeDevice(choice);
  }
  catch (...)
  {
    body_ = std::move(old);
    keepHolding();
    throw;
  }
  endRecording(old);
  calibration_ = std::move(calibration);
  recording_.mesh = body_.name;
  recording_.unit = body_.unit;
  recording_.files = body_.files;
  recording_.organs = std::move(organs);
  recording_.rated = plan_.validity;
  recording_.scene = std::move(scene);
  followTissue(calibration_, recording_.scene);
  useDevice(choice, std::move(holder));
}

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

DevicePlacement Session::placement() const
{
  DevicePlacement placement = plan_.placement;
  placement.rotation = facing_;
  placement.origin = restingPose(facing_.col(2)).apex;
  return placement;
}

std::unique_ptr<Device> Session::makeDevice(const DeviceChoice& choice)
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
  if (choice.name == choice_.name)
  {
    servo_.reset();
    device_.reset();
  }
  return openDevice(choice.name, placement(), loadArm(armFile(identityOf(choice.name))));
}

void Session::useDevice(const DeviceChoice& choice)
{
  try
  {
    useDevice(choice, makeDevice(choice));
  }
  catch (...)
  {
    keepHolding();
    throw;
  }
}

void Session::lag(bool lags)
{
  lagReference_ = lags ? std::optional(recording_.scene.law.material()) : std::nullopt;
  useDevice(DeviceChoice(choice_));
}

// hardware can be opened once only: what is open must be let go of before it is opened again, and
// where that fails the mouse takes the tool
void Session::keepHolding()
{
  if (!device_)
  {
    useDevice(DeviceChoice{});
  }
}

void Session::useDevice(const DeviceChoice& choice, std::unique_ptr<Device> device)
{
  endRecording(body_);
  servo_.reset(); // stops before its device goes
  lagging_ = nullptr;
  const bool isFree = !choice.isScript() && !device->limits().rendersForce;
  if (lagReference_ && isFree)
  {
    auto lagging = std::make_unique<LaggingTool>(std::move(device), *lagReference_);
    lagging_ = lagging.get();
    lagging_->setScene(recording_.scene);
    device = std::move(lagging);
  }
  device_ = std::move(device);
  guided_ = device_->guided();
  choice_ = choice;
  recording_.device = choice.name;
  startServo();
}

bool Session::turnDevice(const Eigen::Matrix3d& seen)
{
  if (choice_.kind != DeviceChoice::Kind::Driver)
  {
    return false;
  }
  endRecording(body_);
  servo_.reset(); // stops before its device goes elsewhere
  facing_ = seen;
  const bool placed = device_->place(placement());
  startServo();
  return placed;
}

void Session::startServo()
{
  recording_.scene.armed =
    choice_.kind == DeviceChoice::Kind::Hand; // only a simulated hand cannot be hurt
  armedAt_ = 0.0;
  recordedFrom_ = 0.0;
  if (guided_ != nullptr)
  {
    guided_->setScene(recording_.scene);
  }
  servo_ = std::make_unique<Servo>(*device_, recording_.scene, servoOptions_);
}

ScriptedDevice* Session::scripted() const noexcept
{
  return dynamic_cast<ScriptedDevice*>(device_.get());
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
  recording_.scene.armed = armed;
  armedAt_ = servo_->newest().time + kForgiving;
  servo_->setScene(recording_.scene);
}

double Session::stableStiffness() const
{
  return rendersForce() ? SafetyChain(device_->limits()).stiffnessLimit(recording_.scene.damping)
                        : std::numeric_limits<double>::infinity();
}

double Session::largestForce() const
{
  return rendersForce() ? std::min(recording_.scene.forceLimit, device_->limits().maxForce)
                        : recording_.scene.forceLimit;
}

void Session::stop(bool stopped)
{
  if (!rendersForce())
  {
    return; // nothing to stop, and nobody could take it back
  }
  servo_->setEmergencyStop(stopped);
  if (stopped)
  {
    arm(false);
  }
}

void Session::aim(const PressTarget& target)
{
  if (guided_ != nullptr)
  {
    guided_->moveTo(target);
  }
}

void Session::update(const std::function<void(const Sample&)>& each)
{
  drain(body_, each);
}

void Session::drain(const SceneBody& body, const std::function<void(const Sample&)>& each)
{
  servo_->history().drain(
    [&](const Sample& sample)
    {
      if (isCurrent(sample))
      {
        record(sample, each);
      }
    });
  save(body, presses_.keep(recording_));
  if (armed() && newest().time > armedAt_ && isFault(newest().state, newest().flags))
  {
    arm(false);
  }
  bound(recording_);
  boundEarlier();
}

// of a rest the first sample and the last, so that curves go level between them
void Session::record(const Sample& sample, const std::function<void(const Sample&)>& each)
{
  presses_.follow(sample);
  std::vector<Sample>& kept = recording_.samples;
  if (!kept.empty() && restsAt(kept.back(), sample))
  {
    resting_ = sample;
    return;
  }
  if (resting_)
  {
    kept.push_back(*resting_);
    each(kept.back());
    resting_.reset();
  }
  kept.push_back(sample);
  each(sample);
}

} // namespace palp
