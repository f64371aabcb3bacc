#include "app/devices_identify.h"

#include "app/arms/arm_file.h"
#include "haptics/devices/driver.h"
#include "haptics/devices/identify/identify.h"
#include "haptics/devices/identify/unlike_axis.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/threads/realtime.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kDisagrees = 6;
constexpr const char* kAxes = "xyz";

double kilograms(const std::string& text)
{
  double grams = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), grams);
  constexpr double kMost = 5000.0; // on a handle [g]
  const bool isMass = error == std::errc{} && std::string(end, text.data() + text.size()) == "g";
  if (!isMass || !(grams > 0.0 && grams <= kMost))
  {
    throw Error(
      ErrorCode::BadValue, "--added: '" + text + "': give the mass in grams, to 5000g, as 100g");
  }
  return 1e-3 * grams;
}

double seconds(Clock::time_point time)
{
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

// once a millisecond; an answer that does not come is waited for
ArmExchange exchangeOf(Driver& driver, DriverSample& sample)
{
  return [&driver, &sample, due = Clock::now()](
           const Eigen::Vector3d& force) mutable -> std::optional<ArmPosition>
  {
    due = std::max(due + 1ms, Clock::now());
    std::this_thread::sleep_until(due);
    const auto sent = Clock::now();
    constexpr int kPatience = 20;
    constexpr int kPushes = 5; // of these, before one that does not answer gets no force
    IoCode code = IoCode::Timeout;
    for (int i = 0; code == IoCode::Timeout && i < kPatience; ++i)
    {
      code = driver.tick(i < kPushes ? force : Eigen::Vector3d::Zero(), 0.001, sample);
    }
    if (code != IoCode::Ok || !sample.homed || sample.stopped)
    {
      return std::nullopt;
    }
    return ArmPosition{ .position = sample.position,
      .time = seconds(Clock::now()),
      .sent = seconds(sent),
      .joints = sample.joints };
  };
}

// a device says that it is homed once the user has done what it needs
void waitForHoming(Driver& driver, DriverSample& sample)
{
  sample.homed = false;
  if (driver.limits().needsHoming)
  {
    std::cout << driver.limits().model << ": home it, then let go of it\n" << std::flush;
  }
  for (const auto end = Clock::now() + 60s; !sample.homed && Clock::now() < end;)
  {
    (void)driver.tick(Eigen::Vector3d::Zero(), 0.001, sample);
    std::this_thread::sleep_for(1ms);
  }
}

// what hardly is of an arm, but of a computer that was late or of one axis that is told wrong
std::string doubtOf(const IdentifiedArm& arm)
{
  constexpr double kUnlike = 4.0;
  constexpr double kLongest = 7.9e-3; // of the delays that are looked for [s]
  constexpr double kLate = 0.002;     // of the exchanges
  const auto [light, heavy] = std::ranges::minmax(arm.axes, {}, &ArmAxis::mass);
  if (arm.delay > kLongest)
  {
    return "a delay of 8 ms is the longest that is looked for";
  }
  if (heavy.mass > kUnlike * light.mass)
  {
    return "one axis is more than four times as heavy as another";
  }
  return arm.late > kLate
    ? "this computer was late in " + std::to_string(std::lround(1e3 * arm.late)) +
      " of 1000 exchanges, by which damping and friction may be off by half"
    : "";
}

void tellDoubts(const IdentifiedArm& arm)
{
  if (const std::string doubt = doubtOf(arm); !doubt.empty())
  {
    std::printf("  Doubtful: %s. Measure again with nothing else running; if it stays, look at the "
                "encoders and the configuration.\n",
      doubt.c_str());
  }
}

void tell(const IdentifiedArm& arm)
{
  for (std::size_t i = 0; i < arm.axes.size(); ++i)
  {
    const auto& [mass, damping, friction, agreement] = arm.axes[i];
    constexpr double kAside = 0.2; // below: it does not move along the push, nor against it
    if (std::abs(agreement) < kAside)
    {
      std::printf(
        "  %c: a push does not move it along this axis but aside (cosine %.2f): the encoder of "
        "this axis may be dead, the arm held, or a motor in another's place; check the cables and "
        "identify it again\n",
        kAxes[i], agreement);
      continue;
    }
    if (agreement < IdentifiedArm::kAgrees)
    {
      std::printf(
        "  %c: a push moves it elsewhere (cosine %.2f): the sign or the place of a motor or "
        "encoder is wrong; mend `sign` in its configuration and identify it again\n",
        kAxes[i], agreement);
      continue;
    }
    std::printf("  %c: follows its motors (cosine %.2f)", kAxes[i], agreement);
    if (arm.agrees())
    {
      std::printf("; mass %.3f kg, damping %.2f N s/m, friction %.3f N", mass, damping, friction);
    }
    std::printf("\n");
  }
  if (arm.agrees())
  {
    std::printf(
      "  delay %.2f ms from a command to the position that shows it, encoder step %.0f um\n"
      "  The more damping and friction and the less delay, the stiffer a tissue it renders "
      "without trembling.\n",
      1e3 * arm.delay, 1e6 * arm.encoderStep);
    std::printf(arm.scale == 1.0 ? "  A newton was taken for a newton; --added with a known mass "
                                   "on the handle measures it.\n"
                                 : "  A hand feels %.2f of each newton that it is told.\n",
      arm.scale);
    tellDoubts(arm);
  }
  std::fflush(stdout);
}

} // namespace

int identifyDevice(const std::string& name, const std::string& added)
{
  const double mass = added.empty() ? 0.0 : kilograms(added);
  const std::filesystem::path file = armFile(identityOf(name));
  const auto before = loadArm(file);
  if (mass > 0.0 && (!before || !before->agrees()))
  {
    throw Error(ErrorCode::BadValue,
      std::string("--added: ") +
        (before ? "this arm does not follow its motors; mend `sign` in its configuration"
                : "this arm was not measured yet") +
        "; identify it first without an added mass");
  }
  const std::unique_ptr<Driver> driver = openDriver(name);
  if (!driver->limits().rendersForce)
  {
    throw Error(ErrorCode::BadValue,
      "--identify: " + driver->limits().model + " has no motors; give a device with force");
  }
  DriverSample sample;
  waitForHoming(*driver, sample);
  (void)makeRealtime(pthread_self(), gettid(), false);
  IdentifiedArm arm = identifyArm(exchangeOf(*driver, sample), driver->limits().quantum);
  if (const std::string wrong = unlikeAxis(arm); !wrong.empty())
  {
    throw Error(ErrorCode::NoDevice, "identify: " + wrong + "; nothing is kept");
  }
  if (mass > 0.0 && arm.agrees())
  {
    const double scale = forceScale(*before, arm, mass);
    const double late = arm.late;
    arm = *before;
    arm.scale = scale;
    arm.late = late;
  }
  std::cout << driver->limits().model << ":\n" << std::flush;
  tell(arm);
  saveArm(file, arm);
  std::cout << "  kept in " << file.string() << '\n';
  return arm.agrees() ? 0 : kDisagrees;
}

int homeDevice(const std::string& name)
{
  const std::unique_ptr<Driver> driver = openHoming(name);
  DriverSample sample{ .homed = false };
  for (const auto end = Clock::now() + 10s; !sample.homed && Clock::now() < end;)
  {
    (void)driver->tick(Eigen::Vector3d::Zero(), 0.001, sample);
    std::this_thread::sleep_for(1ms);
  }
  std::cout << driver->limits().model
            << (sample.homed ? ": homed\n" : ": did not get to its zero\n");
  return sample.homed ? 0 : kDisagrees;
}

} // namespace palp
