// An arm behind a serial port, against a board made up from what its makers' firmware prints and
// scans: "%hd %hd %hd %hd %hd %hd %hd\n" both ways, one line for each that came.

#include "haptics/devices/serial/serial_port.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/wooden_reference.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

class TextBoard
{
public:
  TextBoard()
    : terminal_(posix_openpt(O_RDWR | O_NOCTTY))
  {
    EXPECT_EQ(grantpt(terminal_), 0);
    EXPECT_EQ(unlockpt(terminal_), 0);
    std::array<char, 64> name{};
    EXPECT_EQ(ptsname_r(terminal_, name.data(), name.size()), 0);
    path = name.data();
    kept_ = ::open(path.c_str(), O_RDWR | O_NOCTTY); // a port is there before anybody opens it
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~TextBoard()
  {
    unplug();
  }
  TextBoard(const TextBoard&) = delete;
  TextBoard& operator=(const TextBoard&) = delete;

  void unplug()
  {
    thread_.request_stop();
    if (thread_.joinable())
    {
      thread_.join();
    }
    close(std::exchange(kept_, -1));
    close(std::exchange(terminal_, -1));
  }

  std::string path;
  std::atomic<bool> asks = true;    // its calibration button is pressed
  std::atomic<bool> halves = false; // tears its lines
  std::atomic<bool> noise = false;  // before each
  std::atomic<int> lines = 0;       // understood
  std::atomic<int> bad = 0;         // not so
  std::array<std::atomic<int>, 3> currents{};
  std::array<std::atomic<int>, 3> set{}; // encoders, by the last calibration

private:
  void run(const std::stop_token& stop)
  {
    std::string text;
    while (!stop.stop_requested())
    {
      pollfd one{ terminal_, POLLIN, 0 };
      std::array<char, 256> bytes{};
      if (poll(&one, 1, 5) <= 0 || (one.revents & POLLIN) == 0)
      {
        continue;
      }
      const ssize_t size = read(terminal_, bytes.data(), bytes.size());
      text.append(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
      for (std::size_t end = 0; (end = text.find('\n')) != text.npos; text.erase(0, end + 1))
      {
        hear(text.substr(0, end));
      }
    }
  }

  void hear(const std::string& line)
  {
    std::array<short, 7> words{};
    const int found = std::sscanf(line.c_str(), "%hd %hd %hd %hd %hd %hd %hd", &words[0], &words[1],
      &words[2], &words[3], &words[4], &words[5], &words[6]);
    ++(found == 7 ? lines : bad);
    for (std::size_t i = 0; i < 3; ++i)
    {
      currents[i] = words[3] == 0 ? words[i] : 0;
      set[i] = words[3] == 1 ? words[4 + i] : set[i].load();
      encoders_[i] = words[3] == 1 ? words[4 + i] : encoders_[i];
    }
    asks = asks && words[3] != 1;
    if (words[3] == 1) // then the user moves it into its workspace
    {
      encoders_ = { 0, 764, 3667 };
    }
    std::array<char, 80> reply{};
    const int size = std::snprintf(reply.data(), reply.size(), "%d %d %d %d %d %d %d\n",
      encoders_[0], encoders_[1], encoders_[2], 10'000 - 300, 0, 0, asks ? 1 : 0);
    if (noise)
    {
      say("boot 1.2\n7 7 7\n99999 1 1 1 1 1 1\n1 2 3 4 5 6 7 8\n\n" + std::string(600, '#') + "\n");
    }
    say(std::string(reply.data(), halves ? 5 : static_cast<std::size_t>(size)));
    if (halves)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(300));
      say(std::string(reply.data() + 5, static_cast<std::size_t>(size) - 5));
    }
  }

  void say(const std::string& text) const
  {
    EXPECT_EQ(write(terminal_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  int terminal_;
  int kept_ = -1;
  std::array<int, 3> encoders_{};
  std::jthread thread_;
};

// ticks until it is homed and pushes
DriverSample homed(Driver& driver, const Vector3d& force)
{
  DriverSample sample;
  sample.homed = false;
  for (int i = 0; i < 2000 && !(sample.homed && sample.sent && !sample.sent->isZero()); ++i)
  {
    (void)driver.tick(force, 1.0_ms, sample);
  }
  return sample;
}

TEST(WoodenText, PushesAsItsMakersBoardIsTold)
{
  for (const bool halves : { false, true })
  {
    TextBoard board;
    board.halves = halves;
    const auto driver = openDriver("wooden:" + board.path);
    const Vector3d force(0.5, -1.0, 2.0);
    DriverSample sample = homed(*driver, force);
    ASSERT_TRUE(sample.homed);
    EXPECT_EQ(board.set[2], 6000); // where the makers calibrate
    constexpr WoodenCounts kPlace{ 0, 764, 3667 };
    // its guardian lets a force grow anew after a late tick, as on a loaded machine
    Vector3d felt = Vector3d::Zero();
    const auto isFelt = [&]
    {
      return (felt - force).norm() <= woodenRounding(kPlace) && sample.sent &&
        (*sample.sent - felt).norm() < woodenRounding(kPlace);
    };
    for (int i = 0; i < 20'000 && !isFelt(); ++i)
    {
      (void)driver->tick(force, 1.0_ms, sample);
      felt = woodenForce(kPlace, { board.currents[0], board.currents[1], board.currents[2] });
    }
    EXPECT_LT((sample.position - woodenTool(kPlace)).norm(), 1e-9);
    EXPECT_EQ(sample.buttons, 1U); // 10000 in encoder d
    EXPECT_LE((felt - force).norm(), woodenRounding(kPlace)) << felt.transpose();
    EXPECT_LT((*sample.sent - felt).norm(), woodenRounding(kPlace));
    EXPECT_EQ(board.bad, 0);
  }
}

TEST(WoodenText, WhatIsNoLineOfABoardIsSkipped)
{
  TextBoard board;
  board.noise = true;
  const auto driver = openDriver("wooden:" + board.path);
  const DriverSample sample = homed(*driver, Vector3d(0, 0, 1));
  EXPECT_TRUE(sample.homed);
  EXPECT_LT((sample.position - woodenTool(WoodenCounts{ 0, 764, 3667 })).norm(), 1e-9);
}

TEST(WoodenText, ItsEndIsToldAndWhatIsNoPortIsRefusedInOneSentence)
{
  {
    TextBoard board;
    const auto driver = openDriver("wooden:" + board.path);
    (void)homed(*driver, Vector3d(0, 0, 1));
    EXPECT_THROW((void)openDriver("wooden:" + board.path), Error); // one palp drives it at a time
    board.unplug();
    DriverSample sample;
    EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone);
  }
  for (const char* path : { "/dev/ttyACM77", "/dev/null", "/nowhere" })
  {
    try
    {
      (void)openDriver(std::string("wooden:") + path);
      ADD_FAILURE() << path;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::NoDevice);
      EXPECT_EQ(std::string(error.what()).find(path), 0U) << error.what();
    }
  }
  for (const char* noPath : { "", ",v2015" })
  {
    try
    {
      (void)openDriver(std::string("wooden:") + noPath);
      ADD_FAILURE() << noPath;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::BadValue) << error.what();
    }
  }
}

TEST(WoodenText, ItsPortsAreFoundWithoutOpeningOne)
{
  const std::filesystem::path folder =
    testing::TempDir() + "palp_ports_" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  for (const char* name : { "ttyUSB0", "tty0", "ttyS0", "hidraw0" })
  {
    (void)std::ofstream(folder / name);
  }
  std::filesystem::create_symlink("nowhere", folder / "ttyACM3"); // what nobody may open
  const std::vector<SerialPort> found = serialPorts(folder);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].path, folder / "ttyACM3");
  EXPECT_FALSE(found[0].permitted);
  EXPECT_EQ(found[1].path, folder / "ttyUSB0");
  EXPECT_TRUE(found[1].permitted);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(serialPorts(folder).empty());
}

// what vouches for the signs of one configuration does not for those of another
TEST(WoodenText, AMeasurementIsOfABoardAndItsConfiguration)
{
  const std::string file = testing::TempDir() + "palp_arm_" + std::to_string(getpid()) + ".conf";
  const auto with = [&](const char* text)
  {
    std::ofstream(file) << text;
    return identityOf("wooden:/dev/ttyACM9," + file);
  };
  const std::string mine = with("sign = 1 1 1\n");
  EXPECT_EQ(mine, with("sign = 1 1 1\n"));
  EXPECT_NE(mine, with("sign = 1 -1 1\n"));
  EXPECT_EQ(identityOf("wooden:/dev/ttyACM9"), identityOf("wooden:/dev/ttyACM9,v2015"));
  EXPECT_NE(identityOf("wooden:/dev/ttyACM9"), identityOf("wooden:/dev/ttyACM9,aluhaptics"));
  EXPECT_NE(identityOf("wooden:/dev/ttyACM9"), mine);
  std::filesystem::remove(file);
}

} // namespace
} // namespace palp
