// hidapi itself, against a WoodenHaptics board that is made up: umockdev gives it a place in /sys,
// this program gives it a file descriptor, one end of a socket pair that keeps reports apart.

#include "haptics/devices/hid_drivers.h"
#include "haptics/devices/threaded_device.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <thread>
#include <umockdev.h>
#include <unistd.h>
#include <vector>

namespace
{

constexpr const char* kNode = "/dev/hidraw0";
constexpr int kMajor = 241;
constexpr int kDescriptorSize = 27;

std::atomic<int> gHostEnd = -1; // handed out to the one who opens the node
std::atomic<int> gOpen = -1;

template <typename Function>
Function next(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

// what hidapi calls; everything that is not our node goes on to the C library
extern "C" int open(const char* path, int flags, ...)
{
  va_list arguments;
  va_start(arguments, flags);
  const int mode = va_arg(arguments, int);
  va_end(arguments);
  if (std::strcmp(path, kNode) == 0)
  {
    gOpen = gHostEnd.exchange(-1);
    errno = gOpen < 0 ? ENODEV : 0;
    return gOpen;
  }
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

extern "C" int fstat(int file, struct stat* status) noexcept
{
  static const auto real = next<int (*)(int, struct stat*)>("fstat");
  const int result = real(file, status);
  if (result == 0 && file == gOpen.load())
  {
    status->st_mode = S_IFCHR | 0600;
    status->st_rdev = makedev(kMajor, 0);
  }
  return result;
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (file == gOpen.load() && request == HIDIOCGRDESCSIZE)
  {
    *static_cast<int*>(argument) = kDescriptorSize;
    return 0;
  }
  static const auto real = next<int (*)(int, unsigned long, ...)>("ioctl");
  return real(file, request, argument);
}

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;

// a Teensy with the raw HID descriptor of 64 bytes both ways
constexpr const char* kRecord =
  "P: /devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001/hidraw/hidraw0\n"
  "N: hidraw0\nE: DEVNAME=/dev/hidraw0\nE: MAJOR=241\nE: MINOR=0\nE: SUBSYSTEM=hidraw\n"
  "A: dev=241:0\\n\nL: device=../../../0003:16C0:0486.0001\n\n"
  "P: /devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001\n"
  "E: SUBSYSTEM=hid\nE: HID_ID=0003:000016C0:00000486\nE: HID_NAME=Polhem\nE: HID_UNIQ=4242\n"
  "H: report_descriptor=06ABFF0A0002A1017508150026FF00954009018102954009029102C0\n\n"
  "P: /devices/usb1/1-2/1-2:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\n"
  "A: bInterfaceNumber=00\\n\n\n"
  "P: /devices/usb1/1-2\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor=16c0\\n\n"
  "A: idProduct=0486\\n\nA: manufacturer=Forsslund\\n\nA: product=Polhem\\n\nA: "
  "bcdDevice=0280\\n\n";
constexpr const char* kDevice = "/sys/devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001/hidraw/hidraw0";

// the board: encoders that follow the currents, one report for each
class Board
{
public:
  enum class Mood
  {
    Good,
    Silent,
    Garbage, // of any length
  };

  explicit Board(int end)
    : end_(end)
    , thread_([this] { run(); })
  {
  }

  ~Board()
  {
    unplug();
  }

  void unplug()
  {
    shutdown(end_, SHUT_RDWR);
    if (thread_.joinable())
    {
      thread_.join();
      close(end_);
    }
  }

  std::atomic<Mood> mood = Mood::Good;
  std::atomic<bool> button = true; // calibrates as soon as it is asked
  std::atomic<int> packets = 0;
  std::atomic<int> beforeCalibration = 0; // currents that were not zero too early
  std::atomic<int> last = 0;              // sum of the sizes of the last currents [mA]

private:
  void run()
  {
    std::array<std::byte, 128> in{};
    std::array<std::int16_t, 3> encoders{ 0, -1000, -6000 };
    bool calibrated = false;
    for (std::uint32_t noise = 1;;)
    {
      const ssize_t size = recv(end_, in.data(), in.size(), 0);
      if (size <= 0)
      {
        return;
      }
      ++packets;
      const Bytes payload(in.data() + 1, static_cast<std::size_t>(size) - 1);
      int sum = 0;
      for (std::size_t i = 0; i < 3; ++i)
      {
        sum += std::abs(readInt<std::int16_t>(payload, 2 * i));
      }
      if (readInt<std::int16_t>(payload, 6) == 1)
      {
        calibrated = true;
        button = false;
      }
      else
      {
        last = sum;
        beforeCalibration += !calibrated && sum != 0 ? 1 : 0;
      }

      std::array<std::byte, 64> out{};
      std::size_t length = out.size();
      for (std::size_t i = 0; i < 3; ++i)
      {
        encoders[i] =
          static_cast<std::int16_t>(encoders[i] + readInt<std::int16_t>(payload, 2 * i) / 1000);
        writeInt(MutableBytes(out), 2 * i, encoders[i]);
      }
      writeInt<std::int16_t>(MutableBytes(out), 12, button ? 1 : 0);
      if (mood == Mood::Silent)
      {
        continue;
      }
      if (mood == Mood::Garbage)
      {
        for (std::byte& byte : out)
        {
          noise = noise * 1664525U + 1013904223U;
          byte = static_cast<std::byte>(noise >> 24);
        }
        length = 1 + noise % 64;
      }
      if (send(end_, out.data(), length, MSG_NOSIGNAL) < 0)
      {
        return;
      }
    }
  }

  int end_;
  std::thread thread_;
};

class HidRig : public ::testing::Test
{
protected:
  void SetUp() override
  {
    bed_ = umockdev_testbed_new();
    if (!umockdev_in_mock_environment())
    {
      GTEST_SKIP() << "umockdev's preload library is not loaded";
    }
    std::signal(SIGPIPE, SIG_IGN);
    ASSERT_TRUE(listHid().empty());
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, kRecord, &error)) << error->message;
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    gHostEnd = ends[0];
    board_ = std::make_unique<Board>(ends[1]);
  }

  void TearDown() override
  {
    board_.reset();
    if (const int unused = gHostEnd.exchange(-1); unused >= 0)
    {
      close(unused);
    }
    g_object_unref(bed_);
  }

  static std::unique_ptr<Driver> openArm()
  {
    return std::make_unique<WoodenDriver>(openHid(kNode), WoodenArm{}, 64);
  }

  UMockdevTestbed* bed_ = nullptr;
  std::unique_ptr<Board> board_;
};

TEST_F(HidRig, FindsTheBoardButOnlyAsOneOfManyWithItsIds)
{
  const auto found = listHid();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, DeviceKind::RawHid);
  EXPECT_EQ(found[0].name, "Polhem");
  EXPECT_EQ(found[0].ids, "16c0:0486");
  EXPECT_EQ(found[0].path, kNode);
}

// a machine under load may answer late: that is no loss
TEST_F(HidRig, ClosedLoopLosesNoReply)
{
  const auto wire = openHid(kNode);
  std::vector<double> times; // [us]
  int answered = 0;
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i)
  {
    std::array<std::byte, 65> out{};
    encodeWooden({ 1.0, 0.0, 0.0 }, MutableBytes(out).subspan(1));
    std::array<std::byte, 64> in{};
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(wire->write(out), IoCode::Ok);
    const IoResult result = wire->read(in, 1s);
    times.push_back(
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    // the encoder moves one count with each ampere that arrived
    answered +=
      result.size == in.size() && decodeWooden(in)->encoders[0] == static_cast<std::int16_t>(i + 1);
    std::this_thread::sleep_for(50us);
  }
  std::nth_element(times.begin(), times.begin() + kTicks / 2, times.end());
  std::printf("median exchange %.1f us\n", times[kTicks / 2]); // a report, not a gate
  EXPECT_EQ(answered, kTicks);
  EXPECT_EQ(board_->packets, kTicks);
}

TEST_F(HidRig, NoCurrentReachesTheBoardBeforeItsCalibration)
{
  const auto arm = openArm();
  DriverSample sample;
  for (int i = 0; i < 200; ++i)
  {
    (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
  }
  EXPECT_EQ(board_->beforeCalibration, 0);
  EXPECT_TRUE(sample.homed);
  EXPECT_GT(board_->last, 0);
}

TEST_F(HidRig, UnplugIsNoticedInAnyState)
{
  for (const int ticks : { 0, 1, 2, 50 })
  {
    const auto arm = openArm();
    DriverSample sample;
    for (int i = 0; i < ticks; ++i)
    {
      (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
    }
    board_->unplug();
    EXPECT_EQ(arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample), IoCode::Gone) << ticks;
    EXPECT_THROW((void)openArm(), Error);
    TearDown();
    SetUp();
  }
}

TEST_F(HidRig, SilenceIsToldByTheAgeOfThePose)
{
  ThreadedDevice device(&openArm, {});
  board_->mood = Board::Mood::Silent;
  std::this_thread::sleep_for(60ms);
  ASSERT_TRUE(device.exchange(Vector3d(0, 0, 1), 1.0_ms));
  EXPECT_GT(device.status().age, 20.0_ms);
}

TEST_F(HidRig, GarbageGivesNoPlaceThatIsNotFinite)
{
  const auto arm = openArm();
  board_->mood = Board::Mood::Garbage;
  for (int i = 0; i < 1000; ++i)
  {
    DriverSample sample;
    (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
    ASSERT_TRUE(sample.position.allFinite());
  }
}

TEST_F(HidRig, LastWordsOfADeviceAreZero)
{
  {
    ThreadedDevice device(&openArm, {});
    while (board_->last == 0) // as long as a machine under load may take
    {
      (void)device.exchange(Vector3d(0.5, 0, 0.5), 1.0_ms);
      std::this_thread::sleep_for(1ms);
    }
  }
  while (board_->last != 0)
  {
    std::this_thread::sleep_for(1ms);
  }
}

} // namespace
} // namespace palp
