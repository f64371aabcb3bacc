#include "haptics/devices/bus_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/units.h"
#include "tests/haptics/devices/families/haply_service.h"
#include "tests/haptics/devices/families/one_sentence.h"
#include "tests/haptics/felt_tissue.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <chrono>
#include <thread>
#include <tuple>

namespace palp
{
namespace
{

using namespace test;
using namespace std::chrono_literals;
using namespace units::literals;
using Eigen::Vector3d;
using Clock = std::chrono::steady_clock;

// as the makers print it, with less of what nobody reads
const std::string kInventory = R"({"session_id": 7, "inverse3": [{"device_id": "049D", "config":
  {"type": "inverse3", "port": "COM12", "handedness": "right", "preset": "defaults",
  "filters": {"force_gate": {"gain": 0.3}, "damping": {"scalar": 0.0}}},
  "state": {"cursor_position": {"x": 0.0, "y": -0.12, "z": 0.15},
  "cursor_velocity": {"x": 0.0, "y": 0.0, "z": 0.0}, "control_mode": "idle"},
  "status": {"calibrated": false, "in_use": false, "power_supply": true, "ready": true}}]})";

// of a service of version 3.1
const std::string kOldInventory = R"({"inverse3": [{"device_id": "049D",
  "config": {"type": "inverse3", "device_info": {"model": 4}},
  "state": {"cursor_position": {"x": 0.07842738, "y": -0.14836666, "z": 0.14297646},
  "mode": "idle"}, "status": {"calibrated": false, "power_supply": true}}],
  "verse_grip": [{"device_id": "61548", "state": {"button": false, "hall": 0,
  "orientation": {"x": -0.5019531, "y": 0.8632202, "z": -0.048095703, "w": -0.022338867}}}]})";

std::unique_ptr<Driver> open(const HaplyService& service)
{
  return openDriver("haply:" + std::to_string(service.port));
}

// as long as a machine under load may take
bool replies(Driver& driver, const Vector3d& force, DriverSample& sample)
{
  for (int i = 0; i < 500; ++i)
  {
    if (driver.tick(force, 1.0_ms, sample) == IoCode::Ok)
    {
      return true;
    }
  }
  return false;
}

// likewise, until its last command has asked for a force
template <typename Step>
bool hears(const HaplyService& service, const Vector3d& force, const Step& step)
{
  const auto isHeard = [&]
  { return Vector3d(service.force[0], service.force[1], service.force[2]) == force; };
  for (const auto end = Clock::now() + 20s; !isHeard() && Clock::now() < end;)
  {
    step();
  }
  return isHeard();
}

bool pushesUntilHeard(
  Driver& driver, const HaplyService& service, const Vector3d& force, DriverSample& sample)
{
  return hears(service, force, [&] { (void)driver.tick(force, 1.0_ms, sample); }) &&
    replies(driver, force, sample);
}

// a service of today or of version 3.1, and what drives its arm
struct ServiceOf
{
  explicit ServiceOf(bool old)
    : service(old ? kOldInventory : kInventory)
  {
    service.word = old ? "values" : "vector";
    driver = open(service);
  }

  HaplyService service;
  std::unique_ptr<Driver> driver;
  DriverSample sample;
};

void waits()
{
  std::this_thread::sleep_for(1ms);
}

TEST(Haply, PushesAndTellsWhereItIs)
{
  for (const bool old : { false, true })
  {
    ServiceOf whole(old);
    auto& [service, driver, sample] = whole;
    ASSERT_TRUE(pushesUntilHeard(*driver, service, Vector3d(0.5, -1.0, 2.0), sample));
    EXPECT_EQ(service.bad, 0);
    EXPECT_TRUE(sample.sent->isApprox(sample.sent->norm() * Vector3d(0.5, -1.0, 2.0).normalized()));
    EXPECT_TRUE(sample.homed);
    // its frame begins in the middle of its workspace, or where it was calibrated
    const Vector3d middle(service.middle.data());
    const Vector3d start = old ? Vector3d::Zero() : Vector3d(Vector3d(0.0, -0.12, 0.15) - middle);
    EXPECT_LT((sample.position - start).norm(), 1e-9);
    EXPECT_EQ(sample.buttons, 2U); // the second of its grip
    service.place[2] = 0.16;
    for (int i = 0; i < 5; ++i)
    {
      ASSERT_TRUE(replies(*driver, Vector3d::Zero(), sample));
    }
    EXPECT_LT((sample.position - start - Vector3d(0, 0, 0.01)).norm(), 1e-9);
    EXPECT_EQ(service.named, !old);
  }
}

// tutorial 05 of the makers: a ball of 100 mm about the middle, 40 mm of a Minverse; data sheet: 4
// N in 80 % of the workspace, steps of 0.01 mm
TEST(Haply, ReachesAsFarAsItsMakersSay)
{
  std::string small = kInventory;
  small.replace(small.find("inverse3\", \"port"), 8, "minverse");
  for (const auto& [inventory, word, reach] : { std::tuple(kInventory, "vector", 100.0_mm),
         std::tuple(small, "vector", 40.0_mm), std::tuple(kOldInventory, "values", 0.0) })
  {
    HaplyService service(inventory);
    service.word = word;
    const DeviceLimits limits = open(service)->limits();
    EXPECT_EQ(limits.workspaceRadius, reach) << inventory;
    EXPECT_EQ(limits.workspaceCenter, Vector3d::Zero());
    EXPECT_EQ(limits.maxForce, 4.0);
    EXPECT_EQ(limits.quantum, 10.0_um);
    expectTissuesToBeToldApart(limits);
  }
}

// as it is held first is upright: where its zero is, no protocol says
TEST(Haply, TiltsTheToolWithItsGripFromWhenItWakes)
{
  HaplyService service(kInventory);
  service.awake = false;
  service.tilted = false;
  const auto driver = open(service);
  DriverSample sample;
  const auto axis = [&]
  {
    for (int i = 0; i < 5; ++i)
    {
      EXPECT_TRUE(replies(*driver, Vector3d::Zero(), sample));
    }
    return Vector3d(sample.orientation * -Vector3d::UnitZ());
  };
  EXPECT_LT((axis() - Vector3d(0, 0, -1)).norm(), 1e-6);
  service.awake = true;
  EXPECT_LT((axis() - Vector3d(0, 0, -1)).norm(), 1e-6);
  service.tilted = true; // its top goes to the right, so its tip to the left
  EXPECT_LT((axis() - Vector3d(-1, 0, 0)).norm(), 1e-6);
}

TEST(Haply, GetsNoForceBeforeItIsCalibrated)
{
  HaplyService service(kInventory);
  service.calibrated = false;
  const auto driver = open(service);
  DriverSample sample;
  for (int i = 0; i < 50; ++i)
  {
    ASSERT_TRUE(replies(*driver, Vector3d(0, 0, 2), sample));
    ASSERT_FALSE(sample.homed);
    ASSERT_EQ(service.force[2], 0.0);
    ASSERT_EQ(*sample.sent, Vector3d::Zero());
  }
  EXPECT_TRUE(driver->limits().needsHoming);
}

// one that stops or dies; frames and mask by the service's own reader
TEST(Haply, ItsGuardianEndsTheForceOfAProgramThatIsSilent)
{
  for (const bool old : { false, true })
  {
    ServiceOf whole(old);
    auto& [service, driver, sample] = whole;
    ASSERT_TRUE(pushesUntilHeard(*driver, service, Vector3d(0, 0, 2), sample));
    EXPECT_TRUE(hears(service, Vector3d::Zero(), waits));
    EXPECT_EQ(service.bad, 0);
    EXPECT_TRUE(pushesUntilHeard(*driver, service, Vector3d(0, 0, 2), sample))
      << "it was late only";
  }
}

TEST(Haply, HoweverItEndsTheLastCommandIsOfNoForce)
{
  for (const Habit habit :
    { Habit::Good, Habit::Garbage, Habit::Opcode, Habit::OtherArm, Habit::NoWhere })
  {
    HaplyService service(kInventory);
    auto driver = open(service);
    DriverSample sample;
    ASSERT_TRUE(pushesUntilHeard(*driver, service, Vector3d(0, 0, 1), sample));
    service.habit = habit;
    for (int i = 0; i < 1000 && habit != Habit::Good; ++i)
    {
      i = driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample) == IoCode::Gone ? 1000 : i;
    }
    driver.reset();
    EXPECT_TRUE(hears(service, Vector3d::Zero(), waits)) << static_cast<int>(habit);
  }
}

TEST(Haply, OneProgramDrivesIt)
{
  HaplyService service(kInventory);
  const auto driver = open(service);
  expectRefusedInOneSentence("haply:" + std::to_string(service.port));
  DriverSample sample;
  EXPECT_TRUE(replies(*driver, Vector3d::Zero(), sample));
}

TEST(Haply, AMessageMayComeInPieces)
{
  HaplyService service(kInventory);
  service.habit = Habit::Fragments;
  const auto driver = open(service);
  DriverSample sample;
  for (int i = 0; i < 20; ++i)
  {
    ASSERT_TRUE(replies(*driver, Vector3d(0, 0, 1), sample)) << i;
  }
  EXPECT_TRUE(sample.homed);
}

// no reply, or half of one: the servo goes on after the two milliseconds that any bus may take
TEST(Haply, APeerThatStallsHoldsUpNoTick)
{
  for (const Habit habit : { Habit::Silent, Habit::Half })
  {
    HaplyService service(kInventory);
    const auto driver = open(service);
    DriverSample sample;
    ASSERT_TRUE(replies(*driver, Vector3d::Zero(), sample));
    service.habit = habit;
    (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample); // may have been answered before
    (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
    AllocationGuard guard;
    const auto begin = Clock::now();
    for (int i = 0; i < 100; ++i)
    {
      EXPECT_EQ(driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample), IoCode::Timeout);
    }
    EXPECT_EQ(guard.count(), 0U);
    EXPECT_LT(Clock::now() - begin, 600ms); // 200 ms on an idle machine
  }
}

TEST(Haply, WhatIsNoMessageEndsIt)
{
  for (const Habit habit :
    { Habit::Large, Habit::Garbage, Habit::OtherArm, Habit::NoWhere, Habit::Closes })
  {
    HaplyService service(kInventory);
    const auto driver = open(service);
    DriverSample sample;
    ASSERT_TRUE(replies(*driver, Vector3d(0, 0, 1), sample));
    service.habit = habit;
    IoCode code = IoCode::Ok;
    const auto begin = Clock::now();
    for (int i = 0; i < 1000 && code != IoCode::Gone; ++i)
    {
      code = driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample);
      ASSERT_TRUE(sample.position.allFinite());
    }
    EXPECT_EQ(code, IoCode::Gone) << static_cast<int>(habit);
    EXPECT_LT(Clock::now() - begin, 2s) << "of 100 MB, 64 kB are taken";
  }
}

// through the device that a servo uses: gone is told to it, which ends the force
TEST(Haply, ADeviceWhosePeerFloodsIsLost)
{
  HaplyService service(kInventory);
  const auto device = openDevice("haply:" + std::to_string(service.port), {});
  EXPECT_TRUE(device->exchange(Vector3d::Zero(), 1.0_ms));
  service.habit = Habit::Large;
  std::optional<ToolPose> pose;
  for (int i = 0; i < 1000 && (i == 0 || pose); ++i)
  {
    pose = device->exchange(Vector3d::Zero(), 1.0_ms);
  }
  EXPECT_FALSE(pose);
}

TEST(Haply, SaysInOneSentenceWhatIsMissing)
{
  HaplyService none(R"({"session_id": 7, "inverse3": []})");
  HaplyService other("<html>not found</html>");
  for (const std::string& port : { std::to_string(none.port), std::to_string(other.port),
         std::string("1"), std::string("port"), std::string("0") })
  {
    expectRefusedInOneSentence("haply:" + port);
  }
}

} // namespace
} // namespace palp
