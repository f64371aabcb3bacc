// palp devices beside made-up daemons, services, libraries and peers.

#include "app/devices_report.h"
#include "app/program/devices_options.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "tests/haptics/devices/families/haply_service.h"
#include "tests/haptics/devices/families/made_up_drd.h"
#include "tests/haptics/devices/families/spacenav_daemon.h"

#include <chrono>
#include <dlfcn.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp
{
namespace
{

using namespace test;
using namespace std::chrono_literals;

struct Told
{
  int code;
  std::string text;

  // the line after that of a family
  [[nodiscard]] std::string of(const std::string& family) const
  {
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line))
    {
      if (line.starts_with(family))
      {
        std::getline(lines, line);
        return line;
      }
    }
    return "no family " + family;
  }
};

Told tell()
{
  testing::internal::CaptureStdout();
  const int code = showDevices({});
  return { code, testing::internal::GetCapturedStdout() };
}

TEST(DeviceFamilies, AreAllListedWithWhatEachNeeds)
{
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  const Told told = tell();
  for (const auto& [device, need] :
    { std::pair("spacemouse[:PATH]", "udev rules"), { "falcon[:FIRMWARE]", "firmware" },
      { "phd1:PATH", "hidapi" }, { "wooden:PATH[,ARM]", "group dialout" },
      { "gamepad[:PATH]", "group input" }, { "spacenavd", "libspnav" },
      { "haply[:PORT]", "service" }, { "forcedimension[:LIBRARY]", "libdrd" },
      { "openigtlink[:ADDRESS:PORT][,TOOL]", "libopenigtlink" } })
  {
    std::istringstream lines(told.text);
    std::string line;
    bool listed = false;
    while (std::getline(lines, line))
    {
      listed = listed ||
        (line.find(device) != line.npos && line.find(std::string(": needs ")) != line.npos &&
          line.find(need) != line.npos);
    }
    EXPECT_TRUE(listed) << device << '\n' << told.text;
  }
}

TEST(DeviceFamilies, AreThoseThatTheirNamesOpen)
{
  const Told told = tell();
  std::istringstream names(kHardwareNames);
  for (std::string name; names >> name;)
  {
    name = name.substr(0, name.find_first_of(":,"));
    EXPECT_TRUE(name == "or" || (namesHardware(name) && told.text.find(name) != told.text.npos))
      << name;
  }
}

TEST(DeviceFamilies, SpacenavdIsThereWhileItRuns)
{
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  EXPECT_NE(tell().of("six-axis mice").find("  none; does not run"), std::string::npos);
  {
    SpacenavDaemon daemon;
    const Told told = tell();
    EXPECT_NE(told.of("six-axis mice").find("  spacenavd runs"), std::string::npos) << told.text;
    EXPECT_EQ(told.code, 0);
  }
  EXPECT_NE(tell().of("six-axis mice").find("  none; does not run"), std::string::npos);
}

TEST(DeviceFamilies, AHaplyIsThereWhereItsServiceKnowsOne)
{
  EXPECT_NE(tell().of("Haply Inverse3").find("start the Haply Inverse Service"), std::string::npos);
  HaplyService service(R"({"session_id": 7, "inverse3": [{"device_id": "049D", "state":
    {"cursor_position": {"x": 0.0, "y": -0.12, "z": 0.15}}}]})",
    10'001);
  const Told told = tell();
  EXPECT_EQ(told.of("Haply Inverse3"), "  its service knows one: can be used");
  EXPECT_EQ(told.code, 0);
  EXPECT_EQ(service.commands, 0) << "a list moves nothing";
}

TEST(DeviceFamilies, AHaplyThatGoesAwayWhileProbedIsLookedForAtItsService)
{
  HaplyService service(R"({"session_id": 7, "inverse3": [{"device_id": "049D", "state":
    {"cursor_position": {"x": 0.0, "y": -0.12, "z": 0.15}}}]})");
  service.habit = Habit::Closes;
  testing::internal::CaptureStdout();
  EXPECT_EQ(showDevices({ .probe = "haply:" + std::to_string(service.port) }), 6);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("its service still runs"), std::string::npos) << said;
  EXPECT_EQ(said.find("cable"), std::string::npos) << said;
}

TEST(DeviceFamilies, ForceDimensionNeedsItsMakersLibraryAndIsNotOpened)
{
  EXPECT_NE(
    tell().of("Force Dimension").find("none; cannot load libdrd.so.3; install"), std::string::npos);
  void* file = dlopen(PALP_NAMED_DRD, RTLD_NOW); // by its soname it is found from now on
  ASSERT_NE(file, nullptr) << dlerror();
  const auto* arm = reinterpret_cast<DrdArm* (*)()>(dlsym(file, "drdArm"))();
  EXPECT_NE(tell().of("Force Dimension").find("libdrd is there"), std::string::npos);
  EXPECT_EQ(arm->watchdog, 0);
  EXPECT_FALSE(arm->open || arm->forceOn);
}

TEST(DeviceFamilies, OpenIgtLinkNeedsItsPort)
{
  const int other = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(18944);
  const bool ours = bind(other, reinterpret_cast<const sockaddr*>(&place), sizeof(place)) == 0 &&
    listen(other, 1) == 0; // or another has it, which is as good
  EXPECT_NE(tell().of("OpenIGTLink").find("another program does"), std::string::npos) << ours;
  close(other);
  std::string state;
  for (const auto end = std::chrono::steady_clock::now() + 60s;
       state.find("is free") == state.npos && std::chrono::steady_clock::now() < end;)
  {
    state = tell().of("OpenIGTLink");
  }
  EXPECT_NE(state.find("port 18944 is free"), state.npos) << state;
}

} // namespace
} // namespace palp
