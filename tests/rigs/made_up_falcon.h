#pragma once

#include "haptics/devices/bytes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/usbdevice_fs.h>
#include <list>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp::test
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How its replies come.
enum class Mood
{
  Good,
  Split,   // a reply in two packets
  Garbage, // before each reply
  Silent,
  Stalled, // the endpoint refuses each transfer
};

/// Chip, boot loader and firmware of a Falcon, behind the requests of usbfs.
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

  /// One ioctl, as the kernel answers it.
  int answer(unsigned long request, void* argument);

  [[nodiscard]] bool repliesAtOnce()
  {
    const std::lock_guard lock(mutex_);
    return eventCharacter_ == std::byte{ '>' };
  }

  std::atomic<Mood> mood = Mood::Good;
  std::atomic<bool> homed = false;
  std::atomic<bool> loaded = false;  // runs firmware
  std::atomic<bool> claimed = false; // by a driver that is open
  std::atomic<int> counts = 1000;    // of each encoder; 1000: the grip is pulled out
  std::atomic<int> lights = 0;       // bits of the last packet
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
    // before its timer runs out, the chip hands over what holds the event character
    while (!waiting_.empty() && mood != Mood::Silent &&
      std::ranges::find(data_, eventCharacter_) != data_.end())
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
  void control(Bytes bytes);
  int submit(usbdevfs_urb& urb);
  int reap(void** urb);
  int discard(const void* urb);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread timer_;
  std::list<Urb> waiting_;
  std::deque<usbdevfs_urb*> done_;
  std::deque<std::byte> data_;
  std::vector<std::byte> heard_;
  bool loading_ = false;
  bool halted_ = false; // the endpoint to the host
  bool stop_ = false;
  bool gone_ = false;
  int bell_ = -1;
  int divisor_ = 0;
  std::byte eventCharacter_{ 0 }; // 0: none
};

/// The one that is plugged in.
extern std::atomic<MadeUpFalcon*> gFalcon;

} // namespace palp::test
