// libusb itself, against a Novint Falcon that is made up: umockdev gives it a place in /sys, this
// program answers the requests of usbfs. A FIFO in the place of the node wakes libusb's poll.

#include "app/program/devices_options.h"
#include "app/devices_report.h"
#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/falcon/falcon_kinematics.h"
#include "haptics/devices/threaded_device.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdarg>
#include <deque>
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/usbdevice_fs.h>
#include <list>
#include <mutex>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <thread>
#include <umockdev.h>
#include <unistd.h>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;
using Packet = std::vector<std::byte>;

constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kDevice = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-3";
constexpr const char* kRecord =
  "P: /devices/pci0000:00/0000:00:14.0/usb1/1-3\nN: bus/usb/001/002=00\n"
  "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
  "E: DEVNAME=/dev/bus/usb/001/002\nE: MAJOR=189\nE: MINOR=1\n"
  "A: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=2\\n\nA: speed=12\\n\n"
  "A: idVendor=0403\\n\nA: idProduct=cb48\\n\n"
  "H: descriptors=1201000200000040030448CB000600000001"
  "0902200001010080320904000002FFFFFF000705810240000007050202400000\n\n";

enum class Mood
{
  Good,
  Split,   // a reply in two packets
  Garbage, // before each reply
  Silent,
  Stalled, // the endpoint refuses each transfer
};

// chip, boot loader and firmware of a Falcon, behind the requests of usbfs
class MadeUpFalcon
{
public:
  ~MadeUpFalcon()
  {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    if (timer_.joinable())
    {
      timer_.join();
    }
    if (bell_ >= 0)
    {
      close(bell_);
    }
  }

  void ringAt(const std::string& node)
  {
    unlink(node.c_str());
    ASSERT_EQ(mkfifo(node.c_str(), 0600), 0);
    bell_ = open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(bell_, 0);
    ASSERT_EQ(fcntl(bell_, F_SETPIPE_SZ, kPage), kPage);
    ring(false);
    timer_ = std::thread([this] { expire(); });
  }

  void unplug()
  {
    const std::lock_guard lock(mutex_);
    gone_ = true;
    for (const Urb& urb : waiting_)
    {
      finish(urb, -ESHUTDOWN, 0);
    }
    waiting_.clear();
  }

  int answer(unsigned long request, void* argument);

  std::atomic<Mood> mood = Mood::Good;
  std::atomic<bool> homed = false;
  std::atomic<bool> loaded = false;  // runs firmware
  std::atomic<bool> claimed = false; // by a driver that is open
  std::atomic<int> packets = 0;
  std::atomic<int> tooEarly = 0;             // torques before homing
  std::atomic<int> torque = 0;               // sum of the sizes of the last
  std::array<std::atomic<int>, 3> torques{}; // the last
  std::vector<std::byte> firmware;

private:
  struct Urb
  {
    usbdevfs_urb* urb;
    Clock::time_point deadline;
  };

  static constexpr int kPage = 4096;

  void ring(bool on)
  {
    static std::array<char, kPage> page{};
    if (on)
    {
      while (read(bell_, page.data(), page.size()) > 0)
      {
      }
    }
    else
    {
      (void)!write(bell_, page.data(), page.size());
    }
  }

  void finish(const Urb& urb, int status, int size)
  {
    urb.urb->status = status;
    urb.urb->actual_length = size;
    done_.push_back(urb.urb);
    ring(true);
  }

  // one packet of the chip: two status bytes, then data
  void give(const Urb& urb)
  {
    auto* out = static_cast<unsigned char*>(urb.urb->buffer);
    int size = 0;
    out[size++] = 0x01;
    out[size++] = 0x60;
    const std::size_t most = mood == Mood::Split ? 9 : 62;
    for (std::size_t i = 0; i < most && !data_.empty(); ++i)
    {
      out[size++] = std::to_integer<unsigned char>(data_.front());
      data_.pop_front();
    }
    finish(urb, 0, size);
  }

  void serve()
  {
    while (!waiting_.empty() && !data_.empty() && mood != Mood::Silent)
    {
      const Urb urb = waiting_.front();
      waiting_.pop_front();
      give(urb);
    }
  }

  // the latency timer of the chip sends packets without data
  void expire()
  {
    std::unique_lock lock(mutex_);
    while (!stop_)
    {
      const auto now = Clock::now();
      while (!waiting_.empty() && waiting_.front().deadline <= now && mood != Mood::Silent)
      {
        const Urb urb = waiting_.front();
        waiting_.pop_front();
        give(urb);
      }
      changed_.wait_for(lock, 1ms);
    }
  }

  void push(Bytes bytes)
  {
    data_.insert(data_.end(), bytes.begin(), bytes.end());
  }

  void hear(Bytes bytes);
  void run(std::byte byte);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread timer_;
  std::list<Urb> waiting_;
  std::deque<usbdevfs_urb*> done_;
  std::deque<std::byte> data_;
  std::vector<std::byte> heard_;
  bool loading_ = false;
  bool stop_ = false;
  bool gone_ = false;
  int bell_ = -1;
  int divisor_ = 0;
};

void MadeUpFalcon::hear(Bytes bytes)
{
  for (const std::byte byte : bytes)
  {
    if (loaded && divisor_ == 0x2)
    {
      run(byte);
    }
    else if (loading_ && divisor_ == 0x15)
    {
      firmware.push_back(byte);
      data_.push_back(byte);
    }
    else
    {
      heard_.push_back(byte);
      const std::string text(reinterpret_cast<const char*>(heard_.data()), heard_.size());
      if (divisor_ == 0x4138 && text.ends_with("\x0a\x43\x0d"))
      {
        push(std::as_bytes(std::span("\x0a\x44\x2c\x0d", 4)));
      }
      else if (divisor_ == 0x15 && byte == std::byte{ 0x41 })
      {
        data_.push_back(byte);
        loading_ = true;
      }
    }
  }
  serve();
}

void MadeUpFalcon::run(std::byte byte)
{
  if (byte == std::byte{ '<' })
  {
    heard_.clear();
  }
  heard_.push_back(byte);
  if (heard_.size() != kFalconPacket || byte != std::byte{ '>' })
  {
    return;
  }
  ++packets;
  int sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    unsigned word = 0;
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
    {
      word |= ((std::to_integer<unsigned>(heard_[1 + 4 * i + nibble]) - 'A') & 0xFU)
        << (4 * nibble);
    }
    torques[i] = static_cast<std::int16_t>(word);
    sum += std::abs(torques[i]);
  }
  torque = sum;
  tooEarly += !homed && sum != 0 ? 1 : 0;
  if (mood == Mood::Garbage)
  {
    push(std::as_bytes(std::span("<AAxy>>z", 8)));
  }
  auto reply = encode(FalconCommand{}); // encoders at zero
  reply[13] = static_cast<std::byte>('A' + (homed ? 0x75 : 0x05));
  push(reply);
  heard_.clear();
}

int MadeUpFalcon::answer(unsigned long request, void* argument)
{
  const auto fail = [](int error)
  {
    errno = error;
    return -1;
  };
  const std::lock_guard lock(mutex_);
  switch (request)
  {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) = USBDEVFS_CAP_BULK_CONTINUATION |
        USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_GETDRIVER:
    case USBDEVFS_IOCTL: // no driver of the kernel's holds it
      return fail(ENODATA);
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_RELEASEINTERFACE:
      claimed = request == USBDEVFS_CLAIMINTERFACE;
      return gone_ ? fail(ENODEV) : 0;
    case USBDEVFS_SUBMITURB:
    {
      if (gone_)
      {
        return fail(ENODEV);
      }
      auto* urb = static_cast<usbdevfs_urb*>(argument);
      const Bytes bytes(
        static_cast<const std::byte*>(urb->buffer), static_cast<std::size_t>(urb->buffer_length));
      if (urb->type == USBDEVFS_URB_TYPE_CONTROL)
      {
        if (bytes[1] == std::byte{ 3 })
        {
          divisor_ = readInt<std::uint16_t>(bytes, 2);
          loaded = loaded || (divisor_ == 0x2 && !firmware.empty());
        }
        else if (bytes[1] == std::byte{ 0 } && readInt<std::uint16_t>(bytes, 2) != 1)
        {
          data_.clear(); // 0 resets, 2 is SIO_TCIFLUSH of libftdi; 1 spares what waits for the host
        }
        finish({ urb, {} }, 0, 0);
      }
      else if (urb->endpoint == 0x02)
      {
        finish({ urb, {} }, 0, urb->buffer_length);
        hear(bytes);
      }
      else
      {
        if (mood == Mood::Stalled)
        {
          finish({ urb, {} }, -EPIPE, 0);
          return 0;
        }
        waiting_.push_back({ urb, Clock::now() + 1ms });
        serve();
      }
      return 0;
    }
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      if (done_.empty())
      {
        ring(false);
        return fail(gone_ ? ENODEV : EAGAIN);
      }
      *static_cast<void**>(argument) = done_.front();
      done_.pop_front();
      return 0;
    case USBDEVFS_DISCARDURB:
      for (auto urb = waiting_.begin(); urb != waiting_.end(); ++urb)
      {
        if (urb->urb == argument)
        {
          const Urb discarded = *urb;
          waiting_.erase(urb);
          finish(discarded, -ENOENT, 0);
          return 0;
        }
      }
      return fail(EINVAL);
    default:
      return fail(ENOTTY);
  }
}

std::atomic<MadeUpFalcon*> gFalcon = nullptr;

} // namespace
} // namespace palp

// what libusb calls; everything that is not usbfs goes on to the C library
extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  palp::MadeUpFalcon* falcon = palp::gFalcon.load();
  if (falcon != nullptr && _IOC_TYPE(request) == 'U')
  {
    return falcon->answer(request, argument);
  }
  static const auto real =
    reinterpret_cast<int (*)(int, unsigned long, ...)>(dlsym(RTLD_NEXT, "ioctl"));
  return real(file, request, argument);
}

namespace palp
{
namespace
{

class FalconRig : public ::testing::Test
{
protected:
  void SetUp() override
  {
    bed_ = umockdev_testbed_new();
    if (!umockdev_in_mock_environment())
    {
      GTEST_SKIP() << "umockdev's preload library is not loaded";
    }
    ASSERT_TRUE(listUsb().empty());
    plugIn();
  }

  void plugIn()
  {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, kRecord, &error)) << error->message;
    falcon_ = std::make_unique<MadeUpFalcon>();
    gchar* root = umockdev_testbed_get_root_dir(bed_);
    falcon_->ringAt(std::string(root) + kNode);
    g_free(root);
    gFalcon = falcon_.get();
  }

  void TearDown() override
  {
    gFalcon = nullptr;
    falcon_.reset();
    g_object_unref(bed_);
  }

  void unplug()
  {
    falcon_->unplug();
    umockdev_testbed_uevent(bed_, kDevice, "remove");
    umockdev_testbed_remove_device(bed_, kDevice);
  }

  // true when it answers
  static bool answers(FalconDriver& driver)
  {
    DriverSample sample;
    return driver.tick(Vector3d::Zero(), 1.0_ms, sample) == IoCode::Ok;
  }

  // as long as a machine under load may take
  static void untilAnswered(FalconDriver& driver, const Vector3d& force, DriverSample& sample)
  {
    const auto end = Clock::now() + 60s;
    while (driver.tick(force, 1.0_ms, sample) != IoCode::Ok)
    {
      if (Clock::now() > end)
      {
        throw std::runtime_error("no answer within a minute");
      }
    }
  }

  static std::vector<std::byte> someFirmware()
  {
    std::vector<std::byte> firmware(7914);
    for (std::size_t i = 0; i < firmware.size(); ++i)
    {
      firmware[i] = static_cast<std::byte>(i * 131 + 7);
    }
    return firmware;
  }

  UMockdevTestbed* bed_ = nullptr;
  std::unique_ptr<MadeUpFalcon> falcon_;
};

TEST_F(FalconRig, IsFound)
{
  const auto found = listUsb();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, DeviceKind::Falcon);
  EXPECT_EQ(found[0].hurdle, "");
}

TEST_F(FalconRig, LoadsTheFirmwareByteForByteOnlyWhereNoneRuns)
{
  {
    const FalconDriver driver(openFalcon(), someFirmware());
    EXPECT_EQ(falcon_->firmware, someFirmware());
  }
  falcon_->firmware.clear();
  const FalconDriver again(openFalcon(), {});
  EXPECT_TRUE(falcon_->firmware.empty());
}

TEST_F(FalconRig, SaysThatFirmwareIsMissing)
{
  EXPECT_THROW(FalconDriver(openFalcon(), {}), Error);
}

TEST_F(FalconRig, DevicesTellsThatItsFirmwareIsMissing)
{
  for (const bool loaded : { false, true })
  {
    falcon_->loaded = loaded;
    testing::internal::CaptureStdout();
    EXPECT_EQ(showDevices({}), loaded ? 0 : 6);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find(loaded ? ": can be used" : ": has no firmware since"), text.npos) << text;
  }
}

// a machine under load may answer late: that is no loss
TEST_F(FalconRig, ClosedLoopLosesNoReply)
{
  falcon_->loaded = true;
  const auto wire = openFalcon();
  ASSERT_TRUE(wire->request(3, 0x2)); // to full speed
  FalconReader reader;
  std::vector<double> times; // [us]
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i)
  {
    const auto begin = Clock::now();
    ASSERT_EQ(wire->write(encode(FalconCommand{})), IoCode::Ok);
    std::optional<FalconState> state;
    while (!state)
    {
      std::array<std::byte, 64> packet{};
      const IoResult result = wire->read(packet, 60s);
      ASSERT_EQ(result.code, IoCode::Ok);
      state = reader.take(Bytes(packet).first(result.size).subspan(2));
    }
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  std::nth_element(times.begin(), times.begin() + kTicks / 2, times.end());
  std::printf("median exchange %.1f us\n", times[kTicks / 2]); // a report, not a gate
  EXPECT_EQ(falcon_->packets, kTicks);
}

TEST_F(FalconRig, RepliesThatComeLateAreForgotten)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  falcon_->mood = Mood::Silent;
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout);
  }
  falcon_->mood = Mood::Good;
  falcon_->homed = true; // what the late replies do not know
  untilAnswered(driver, Vector3d::Zero(), sample);
  EXPECT_TRUE(sample.homed);
}

TEST_F(FalconRig, NoTorqueComesBeforeHoming)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  for (int i = 0; i < 200; ++i)
  {
    untilAnswered(driver, Vector3d(0, 0, -1), sample);
  }
  EXPECT_EQ(falcon_->torque, 0);
  falcon_->homed = true;
  while (falcon_->torque == 0)
  {
    (void)driver.tick(Vector3d(0, 0, -1), 1.0_ms, sample);
  }
  EXPECT_EQ(falcon_->tooEarly, 0);
  EXPECT_TRUE(sample.homed);
  EXPECT_EQ(sample.buttons, 5U);
  EXPECT_NEAR(sample.position.z(), 0.1346 - 0.125, 1e-4);
}

// by the work that a small motion does: torques times the way of the legs is force times the way
// of the grip
TEST_F(FalconRig, MotorsGetTheTorquesOfTheForce)
{
  falcon_->loaded = true;
  falcon_->homed = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  untilAnswered(driver, Vector3d::Zero(), sample);
  const Vector3d place = sample.position + falconCentre(); // all encoders at zero
  for (const Vector3d& force : { Vector3d(0, 0, -8), Vector3d(5, 0, 2), Vector3d(-2, 6, -3) })
  {
    untilAnswered(driver, force, sample); // so that it has been taken up
    Vector3d felt;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = 1.0_um * Vector3d::Unit(axis);
      const Vector3d way = *falconAngles(place + step) - *falconAngles(place - step);
      const Vector3d torques(falcon_->torques[0], falcon_->torques[1], falcon_->torques[2]);
      felt[axis] = -torques.dot(way) / 2.0_um / 2300.0; // counts in a newton metre
    }
    EXPECT_NEAR(felt.norm(), force.norm(), 0.01 * force.norm());
    EXPECT_LT(std::acos(std::min(1.0, felt.normalized().dot(force.normalized()))), 0.5_deg);
  }
}

TEST_F(FalconRig, FindsRepliesThatAreSplitOrFollowGarbage)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  for (const Mood mood : { Mood::Split, Mood::Garbage })
  {
    falcon_->mood = mood;
    for (int i = 0; i < 200; ++i)
    {
      DriverSample sample;
      untilAnswered(driver, Vector3d::Zero(), sample);
      ASSERT_TRUE(sample.position.allFinite());
    }
  }
}

TEST_F(FalconRig, SilenceAndStallsAreTimeoutsAndNoHang)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  for (const Mood mood : { Mood::Silent, Mood::Stalled })
  {
    falcon_->mood = mood;
    DriverSample sample;
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout);
  }
  falcon_->mood = Mood::Good;
  while (!answers(driver)) // goes on as if nothing had been
  {
  }
}

TEST_F(FalconRig, IsSilentThenGoneThenBack)
{
  falcon_->loaded = true;
  ThreadedDevice device([] { return std::make_unique<FalconDriver>(openFalcon(), Packet{}); }, {});
  falcon_->mood = Mood::Silent;
  while (device.exchange(Vector3d::Zero(), 1.0_ms) && device.status().age < 20.0_ms)
  {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(device.status().age, 20.0_ms);
  unplug();
  while (device.exchange(Vector3d::Zero(), 1.0_ms) || falcon_->claimed)
  {
    std::this_thread::sleep_for(1ms);
  }
  gFalcon = nullptr;
  falcon_.reset();
  plugIn();
  falcon_->loaded = true;
  while (!device.exchange(Vector3d::Zero(), 1.0_ms))
  {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_FALSE(device.status().homed);
}

TEST_F(FalconRig, UnplugIsNoticedInAnyState)
{
  for (const int ticks : { 0, 1, 50 })
  {
    falcon_->loaded = true;
    FalconDriver driver(openFalcon(), {});
    DriverSample sample;
    for (int i = 0; i < ticks; ++i)
    {
      (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
    }
    unplug();
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone) << ticks;
    EXPECT_THROW((void)openFalcon(), Error);
    if (ticks < 50)
    {
      TearDown();
      SetUp();
    }
  }
}

} // namespace
} // namespace palp
