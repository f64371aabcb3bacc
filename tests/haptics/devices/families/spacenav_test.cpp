// libspnav against a daemon made up from spacenavd's proto_unix.c: events of eight integers through
// a local socket, a change of protocol first.

#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/devices/memory_transport.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

using Axes = std::array<int, 6>;

class Daemon
{
public:
  explicit Daemon(bool old = false)
    : path_(testing::TempDir() + "palp_spnav_" + std::to_string(getpid()))
    , listening_(socket(AF_UNIX, SOCK_STREAM, 0))
  {
    unlink(path_.c_str());
    sockaddr_un place{};
    place.sun_family = AF_UNIX;
    path_.copy(place.sun_path, sizeof(place.sun_path) - 1);
    EXPECT_EQ(bind(listening_, reinterpret_cast<const sockaddr*>(&place), sizeof(place)), 0);
    EXPECT_EQ(listen(listening_, 1), 0);
    setenv("SPNAV_SOCKET", path_.c_str(), 1);
    greeter_ = std::jthread(
      [this, old]
      {
        client_ = accept(listening_, nullptr, nullptr);
        unsigned asked = 0;
        EXPECT_EQ(read(client_, &asked, sizeof(asked)), 4);
        EXPECT_EQ(asked & 0xFFFFFF00U, 0x7FAA5500U);
        const unsigned agreed = 0x7FAA5501U;
        if (!old) // an old one takes it for a sensitivity that is no number
        {
          EXPECT_EQ(write(client_, &agreed, sizeof(agreed)), 4);
        }
      });
  }
  ~Daemon()
  {
    stop();
    close(listening_);
    unlink(path_.c_str());
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void stop()
  {
    if (greeter_.joinable())
    {
      greeter_.join();
    }
    close(std::exchange(client_, -1));
  }

  // of a mouse whose axes are x right, y to the user, z down, by the daemon's own defaults
  void move(const Axes& raw)
  {
    constexpr std::array<std::size_t, 6> kMap{ 0, 2, 1, 3, 5, 4 };
    constexpr Axes kInverted{ 0, 1, 1, 0, 1, 1 };
    std::array<int, 8> event{};
    for (std::size_t i = 0; i < 6; ++i)
    {
      event[1 + kMap[i]] = kInverted[i] != 0 ? -raw[i] : raw[i];
    }
    event[7] = 16;
    say(event);
  }

  void press(int button, bool down)
  {
    say({ down ? 1 : 2, button });
  }

private:
  void say(const std::array<int, 8>& event)
  {
    greeter_.joinable() ? greeter_.join() : void();
    EXPECT_EQ(write(client_, event.data(), sizeof(event)), 32);
  }

  std::string path_;
  int listening_;
  int client_ = -1;
  std::jthread greeter_;
};

// the same twist and push of the same mouse, read from its own reports
DriverSample bySpaceMouse(const Axes& raw, int ticks)
{
  Wire wire;
  SpaceMouseDriver driver(std::make_unique<MemoryTransport>(wire));
  DriverSample sample;
  for (int i = 0; i < ticks; ++i)
  {
    Packet report(13);
    report[0] = std::byte{ 1 };
    for (std::size_t axis = 0; axis < 6; ++axis)
    {
      writeInt(report, 1 + 2 * axis, static_cast<std::int16_t>(raw[axis]));
    }
    wire.replies.push_back(report);
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  }
  return sample;
}

TEST(Spacenavd, MovesTheToolAsTheMouseItselfDoes)
{
  for (std::size_t axis = 0; axis < 6; ++axis)
  {
    Daemon daemon;
    const auto driver = openDriver("spacenavd");
    Axes raw{};
    raw[axis] = 350;
    DriverSample sample;
    for (int i = 0; i < 100; ++i)
    {
      daemon.move(raw);
      ASSERT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    }
    const DriverSample same = bySpaceMouse(raw, 100);
    EXPECT_LT((sample.position - same.position).norm(), 1e-12) << axis;
    EXPECT_LT(sample.orientation.angularDistance(same.orientation), 1e-9) << axis;
    EXPECT_NEAR(sample.position.norm() / 6.0_mm + // at full deflection, or a turn of 0.1 rad
        sample.orientation.angularDistance(Eigen::Quaterniond::Identity()) / 0.1,
      1.0, 1e-3);
  }
}

TEST(Spacenavd, ButtonsAreHeldUntilTheyAreReleased)
{
  Daemon daemon;
  const auto driver = openDriver("spacenavd");
  DriverSample sample;
  daemon.press(0, true);
  daemon.press(9, true);
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  EXPECT_EQ(sample.buttons, 0x201U);
  daemon.press(0, false);
  daemon.press(99, true); // none of a mouse's
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  EXPECT_EQ(sample.buttons, 0x200U);
}

TEST(Spacenavd, AnOldDaemonThatKnowsOneProtocolIsUnderstood)
{
  Daemon daemon(true);
  const auto driver = openDriver("spacenavd");
  DriverSample sample;
  daemon.move({ 350, 0, 0, 0, 0, 0 });
  for (int i = 0; i < 50; ++i)
  {
    (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  }
  EXPECT_NEAR(sample.position.x(), 3.0_mm, 0.1_mm);
}

TEST(Spacenavd, ItsEndIsToldAndItsAbsenceIsOneSentence)
{
  Daemon daemon;
  {
    const auto driver = openDriver("spacenavd");
    DriverSample sample;
    daemon.move({ 350, 0, 0, 0, 0, 0 });
    EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    daemon.stop();
    EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone);
  }
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  try
  {
    (void)openDriver("spacenavd");
    FAIL() << "a daemon runs here";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::NoDevice);
    EXPECT_NE(std::string(error.what()).find("start it"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace palp
