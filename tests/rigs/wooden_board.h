#pragma once

// The arm's board, as its published firmware behaves (forsslund/haptikfabrikenapi
// firmware/main.cpp): seven int16 both ways; command 0 runs currents, command 1 sets the counters
// and lets go of the button, whose request stands until then.

#include "tests/support/wooden_reference.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <span>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp::test
{

class Board
{
public:
  enum class Mood
  {
    Good,
    Silent,
    Garbage, // of any length
    Short,   // reports that are cut off
    Leaping, // the first encoder by a quarter of a turn of its motor, in every tenth
  };

  using Clock = std::chrono::steady_clock;
  static constexpr WoodenCounts kStart{ 764, 764, 3667 }; // in the workspace

  // of a report: a wrist that turns by a count in each, so that none is missed
  [[nodiscard]] static std::uint16_t turnsOfTheWrist(std::span<const std::byte> report)
  {
    std::uint16_t turns = 0;
    std::memcpy(&turns, report.data() + 8, sizeof turns);
    return turns;
  }

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
    if (thread_.joinable())
    {
      pulled = Clock::now();
      shutdown(end_, SHUT_RDWR);
      thread_.join();
      close(end_);
    }
  }

  std::atomic<Mood> mood = Mood::Good;
  std::atomic<bool> button = true; // held down: calibrates as soon as it is asked
  std::atomic<int> reach = 0;      // counts of the third motor beyond the start that a hand goes to
  std::atomic<int> packets = 0;
  std::atomic<int> beforeCalibration = 0;    // currents that were not zero too early
  std::atomic<int> last = 0;                 // sum of the sizes of the last currents [mA]
  std::atomic<int> pushes = 0;               // packets whose currents were not all zero
  std::atomic<Clock::time_point> lastPush{}; // when the last of them came
  std::atomic<Clock::time_point> rested{};   // when the first zero after one of them came
  std::atomic<Clock::time_point> pulled{};   // when its wire was
  std::vector<WoodenCurrents> pushed;        // in those packets; the thread's, until it has ended
  std::vector<WoodenCounts> places; // where it was, in the answer to each packet; as pushed

private:
  struct Message // 14 bytes, little-endian as this machine
  {
    std::array<std::int16_t, 3> first; // currents [mA]; counters a b c
    std::int16_t command;              // ; counter d
    std::array<std::int16_t, 3> rest;  // attributes; counters e f, info
  };
  static_assert(sizeof(Message) == 14);

  void hear(const Message& told)
  {
    constexpr int kSetCounters = 1;
    if (told.command == kSetCounters)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        zero_[i] = told.rest[i] - at_[i];
      }
      calibrated_ = true;
      button = false;
      return;
    }
    const WoodenCurrents currents{ told.first[0], told.first[1], told.first[2] };
    const bool pushing = last != 0;
    last = std::abs(currents[0]) + std::abs(currents[1]) + std::abs(currents[2]);
    if (last != 0)
    {
      lastPush = Clock::now();
      ++pushes;
      pushed.push_back(currents);
      beforeCalibration += calibrated_ ? 0 : 1;
    }
    else if (pushing)
    {
      rested = Clock::now();
    }
    at_[0] += currents[0] / 1000; // a hand that yields, so that it can be told
  }

  // once it is calibrated, a hand lets go of the button, takes the arm from its rest to the start
  // at some 0.4 m/s, and moves it from there at 60 mm/s, a count in each packet
  void move()
  {
    if (!calibrated_ || waiting_ > 0)
    {
      waiting_ -= calibrated_ ? 1 : 0;
      return;
    }
    const int quick = arrived_ ? 1 : 6;
    const auto towards = [quick](int& at, int goal) { at += std::clamp(goal - at, -quick, quick); };
    for (std::size_t i = 0; i < 3 && !arrived_; ++i)
    {
      towards(at_[i], kStart[i]);
    }
    if (arrived_)
    {
      towards(at_[2], kStart[2] + reach);
    }
    arrived_ = arrived_ || at_ == kStart;
  }

  [[nodiscard]] std::size_t answer(std::array<std::byte, 64>& out)
  {
    if (mood == Mood::Garbage)
    {
      for (std::byte& byte : out)
      {
        noise_ = noise_ * 1664525U + 1013904223U;
        byte = static_cast<std::byte>(noise_ >> 24);
      }
      return 1 + noise_ % 64;
    }
    Message report{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      report.first[i] = static_cast<std::int16_t>(zero_[i] + at_[i]);
    }
    constexpr int kTenth = 10;
    if (mood == Mood::Leaping && packets % kTenth == 0)
    {
      report.first[0] = static_cast<std::int16_t>(report.first[0] + 500);
    }
    report.rest[0] = static_cast<std::int16_t>(packets.load());
    report.rest[2] = button ? 1 : 0;
    std::memcpy(out.data(), &report, sizeof report);
    return mood == Mood::Short ? 7 : out.size();
  }

  void run()
  {
    std::array<std::byte, 128> in{};
    for (;;)
    {
      const ssize_t size = recv(end_, in.data(), in.size(), 0);
      if (size <= 0)
      {
        return;
      }
      ++packets;
      Message told{};
      std::memcpy(&told, in.data() + 1, sizeof told); // behind the number of the report
      hear(told);
      move();
      places.push_back(at_);
      std::array<std::byte, 64> out{};
      const std::size_t length = answer(out);
      if (mood != Mood::Silent && send(end_, out.data(), length, MSG_NOSIGNAL) < 0)
      {
        return;
      }
    }
  }

  WoodenCounts at_ = kWoodenRest;           // where the arm is, whatever the counters say
  std::array<int, 3> zero_{ 5, -7, -5997 }; // of the counters, which began when it was plugged in
  bool calibrated_ = false;
  int waiting_ = 50; // packets before the hand moves
  bool arrived_ = false;
  std::uint32_t noise_ = 1;
  int end_;
  std::thread thread_;
};

} // namespace palp::test
