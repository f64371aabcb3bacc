#pragma once

// hidapi itself, against a WoodenHaptics board that is made up: umockdev gives it a place in /sys,
// the program gives it a file descriptor, one end of a socket pair that keeps reports apart. For
// one source file of a program only: it defines what hidapi calls.

#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "tests/rigs/wooden_board.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdarg>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <thread>
#include <umockdev.h>
#include <unistd.h>

namespace palp::test
{

inline constexpr const char* kNode = "/dev/hidraw0";
inline constexpr int kMajor = 241;
inline constexpr int kDescriptorSize = 27;

inline std::atomic<int> gHostEnd = -1; // a copy for whoever opens the node
inline std::atomic<int> gOpen = -1;
inline std::atomic<bool> gDenied = false; // to this user, as without udev rules

template <typename Function>
Function next(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace palp::test

// what hidapi calls; everything that is not our node goes on to the C library
extern "C" int open(const char* path, int flags, ...)
{
  va_list arguments;
  va_start(arguments, flags);
  const int mode = va_arg(arguments, int);
  va_end(arguments);
  if (std::strcmp(path, palp::test::kNode) == 0 && palp::test::gDenied)
  {
    errno = EACCES;
    return -1;
  }
  if (std::strcmp(path, palp::test::kNode) == 0)
  {
    const int end = palp::test::gHostEnd;
    palp::test::gOpen = end < 0 ? -1 : dup(end);
    errno = end < 0 ? ENODEV : 0;
    return palp::test::gOpen;
  }
  static const auto real = palp::test::next<int (*)(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

extern "C" int access(const char* path, int mode) noexcept
{
  if (std::strcmp(path, palp::test::kNode) == 0 && palp::test::gDenied)
  {
    errno = EACCES;
    return -1;
  }
  static const auto real = palp::test::next<int (*)(const char*, int)>("access");
  return real(path, mode);
}

extern "C" int fstat(int file, struct stat* status) noexcept
{
  static const auto real = palp::test::next<int (*)(int, struct stat*)>("fstat");
  const int result = real(file, status);
  if (result == 0 && file == palp::test::gOpen.load())
  {
    status->st_mode = S_IFCHR | 0600;
    status->st_rdev = makedev(palp::test::kMajor, 0);
  }
  return result;
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (file == palp::test::gOpen.load() && request == HIDIOCGRDESCSIZE)
  {
    *static_cast<int*>(argument) = palp::test::kDescriptorSize;
    return 0;
  }
  static const auto real = palp::test::next<int (*)(int, unsigned long, ...)>("ioctl");
  return real(file, request, argument);
}

namespace palp::test
{

// a Teensy with the raw HID descriptor of 64 bytes both ways
inline constexpr const char* kRecord =
  "P: /devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001/hidraw/hidraw0\n"
  "E: DEVNAME=/dev/hidraw0\nE: MAJOR=241\nE: MINOR=0\nE: SUBSYSTEM=hidraw\n"
  "A: dev=241:0\\n\nL: device=../../../0003:16C0:0486.0001\n\n"
  "P: /devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001\n"
  "E: SUBSYSTEM=hid\nE: HID_ID=0003:000016C0:00000486\nE: HID_NAME=Polhem\nE: HID_UNIQ=4242\n"
  "H: report_descriptor=06ABFF0A0002A1017508150026FF00954009018102954009029102C0\n\n"
  "P: /devices/usb1/1-2/1-2:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\n"
  "A: bInterfaceNumber=00\\n\n\n"
  "P: /devices/usb1/1-2\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor=16c0\\n\n"
  "A: idProduct=0486\\n\nA: manufacturer=Forsslund\\n\nA: product=Polhem\\n\nA: "
  "bcdDevice=0280\\n\n";
inline constexpr std::array kNodes{
  "/sys/devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001/hidraw/hidraw0",
  "/sys/devices/usb1/1-2/1-2:1.0/0003:16C0:0486.0001",
  "/sys/devices/usb1/1-2/1-2:1.0",
  "/sys/devices/usb1/1-2",
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
    plugIn();
  }

  void plugIn(const std::string& record = kRecord)
  {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, record.c_str(), &error)) << error->message;
    gchar* root = umockdev_testbed_get_root_dir(bed_);
    std::ofstream(std::string(root) + kNode); // there, for whoever asks: open is ours
    g_free(root);
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    board_ = std::make_unique<Board>(ends[1]);
    gHostEnd = ends[0];
  }

  void unplug()
  {
    board_->unplug();
    if (const int unused = gHostEnd.exchange(-1); unused >= 0)
    {
      close(unused);
    }
    gOpen = -1;
    for (const char* node : kNodes)
    {
      umockdev_testbed_remove_device(bed_, node);
    }
  }

  void TearDown() override
  {
    gDenied = false;
    board_.reset();
    if (const int unused = gHostEnd.exchange(-1); unused >= 0)
    {
      close(unused);
    }
    g_object_unref(bed_);
  }

  UMockdevTestbed* bed_ = nullptr;
  std::unique_ptr<Board> board_;
};

} // namespace palp::test
