#pragma once

// The Inverse Service of Haply as docs.haply.co writes it down (WebSocket Protocol, Simulation
// Channel): an inventory on connection, then one state for each command. Frames and handshake by
// RFC 6455, without a WebSocket library.

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>
#include <nettle/base64.h>
#include <nettle/sha1.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace palp::test
{

enum class Habit
{
  Good,
  Fragments, // a message in three frames, with a ping between
  Silent,    // takes commands, says nothing
  Half,      // a frame that never ends
  Large,     // 100 MB
  Garbage,   // no JSON
  Opcode,    // a frame of a kind that there is none of
  OtherArm,  // the arm is gone from the list
  NoWhere,   // a place that is no number
  Closes,
};

class HaplyService
{
public:
  /// @param at  a port; 0: any that is free
  explicit HaplyService(const std::string& inventory, std::uint16_t at = 0)
    : inventory_(inventory)
    , listening_(socket(AF_INET, SOCK_STREAM, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(at);
    const int on = 1;
    (void)setsockopt(listening_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    EXPECT_EQ(bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(listening_, 1), 0);
    socklen_t size = sizeof(address);
    EXPECT_EQ(getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port = ntohs(address.sin_port);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~HaplyService()
  {
    thread_.request_stop();
    thread_.join();
    close(client_);
    close(listening_);
  }
  HaplyService(const HaplyService&) = delete;
  HaplyService& operator=(const HaplyService&) = delete;

  std::uint16_t port = 0;
  std::atomic<Habit> habit = Habit::Good;
  std::atomic<bool> calibrated = true;
  std::atomic<int> commands = 0;
  std::atomic<int> bad = 0;
  std::array<std::atomic<double>, 3> force{};
  std::array<std::atomic<double>, 3> place{ 0.0, -0.12, 0.15 };
  std::atomic<bool> named = false;                   // it was told which program this is
  std::atomic<bool> awake = true;                    // its grip
  std::atomic<bool> tilted = true;                   // a quarter turn about y
  std::string word = "vector";                       // of a force
  std::array<double, 3> middle{ 0.02, -0.17, 0.16 }; // of the workspace, from its base

private:
  void run(const std::stop_token& stop)
  {
    while (!stop.stop_requested() && client_ < 0)
    {
      client_ = isReadable(listening_) ? accept(listening_, nullptr, nullptr) : -1;
    }
    std::string heard;
    while (!stop.stop_requested())
    {
      std::array<char, 4096> bytes{};
      const ssize_t size = isReadable(client_) ? read(client_, bytes.data(), bytes.size()) : -1;
      if (size == 0)
      {
        return;
      }
      heard.append(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
      greeted_ ? take(heard) : greet(heard);
    }
  }

  static bool isReadable(int file)
  {
    pollfd one{ file, POLLIN, 0 };
    return poll(&one, 1, 5) > 0;
  }

  void greet(std::string& heard)
  {
    const std::size_t end = heard.find("\r\n\r\n");
    const std::string name = "Sec-WebSocket-Key: ";
    const std::size_t at = heard.find(name);
    if (end == heard.npos || at == heard.npos)
    {
      return;
    }
    const std::string key =
      heard.substr(at + name.size(), 24) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
    sha1_ctx hash{};
    sha1_init(&hash);
    sha1_update(&hash, key.size(), reinterpret_cast<const std::uint8_t*>(key.data()));
    std::array<std::uint8_t, SHA1_DIGEST_SIZE> digest{};
    sha1_digest(&hash, digest.size(), digest.data());
    std::array<char, BASE64_ENCODE_RAW_LENGTH(SHA1_DIGEST_SIZE)> text{};
    base64_encode_raw(text.data(), digest.size(), digest.data());
    say("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
      std::string(text.data(), text.size()) + "\r\n\r\n");
    heard.erase(0, end + 4);
    greeted_ = true;
    say(frame(inventory_, 0x81));
  }

  // frames of a client, which are masked
  void take(std::string& heard)
  {
    const auto octet = [&](std::size_t i)
    { return std::size_t{ static_cast<unsigned char>(heard[i]) }; };
    while (heard.size() >= 6)
    {
      const bool longer = (octet(1) & 0x7F) == 126;
      const std::size_t front = longer ? 8 : 6;
      if (heard.size() < front)
      {
        return;
      }
      const std::size_t size = longer ? octet(2) << 8 | octet(3) : octet(1) & 0x7F;
      if (heard.size() < front + size)
      {
        return;
      }
      std::string text = heard.substr(front, size);
      for (std::size_t i = 0; i < size; ++i)
      {
        text[i] = static_cast<char>(text[i] ^ heard[front - 4 + i % 4]);
      }
      const bool masked = (octet(1) & 0x80) != 0;
      const int kind = octet(0) & 0x0F;
      heard.erase(0, front + size);
      bad += masked ? 0 : 1;
      if (kind == 1)
      {
        obey(text);
      }
    }
  }

  void obey(const std::string& text)
  {
    const auto told = nlohmann::json::parse(text, nullptr, false);
    try
    {
      const auto& arm = told.at("inverse3").at(0);
      EXPECT_EQ(arm.at("device_id"), "049D");
      const auto& vector = arm.at("commands").at("set_cursor_force").at(word);
      force[0] = vector.at("x").get<double>();
      force[1] = vector.at("y").get<double>();
      force[2] = vector.at("z").get<double>();
      named = named || told.contains("session");
      isCentered_ = isCentered_ ||
        (word == "vector" && arm.contains("configure") &&
          arm["configure"].at("preset") == "arm_front_centered");
      ++commands;
    }
    catch (const nlohmann::json::exception&)
    {
      ++bad;
    }
    reply();
  }

  void reply()
  {
    const auto number = [](double value) { return nlohmann::json(value).dump(); };
    const Habit now = habit;
    const std::string id = now == Habit::OtherArm ? "0BAD" : "049D";
    const auto at = [&](std::size_t i) { return number(place[i] - (isCentered_ ? middle[i] : 0)); };
    const std::string x = now == Habit::NoWhere ? "null" : at(0);
    const std::string text = R"({"inverse3":[{"device_id":")" + id +
      R"(","state":{"cursor_position":{"x":)" + x + R"(,"y":)" + at(1) + R"(,"z":)" + at(2) +
      R"(},"cursor_velocity":{"x":0,"y":0,"z":0},"control_mode":"force"},"status":{"calibrated":)" +
      (calibrated ? "true" : "false") +
      R"(,"in_use":true,"power_supply":true,"ready":true,"started":true}}],)"
      R"("wireless_verse_grip":[)" +
      (awake ? grip() : "") + "]}";
    switch (now)
    {
      case Habit::Silent:
        return;
      case Habit::Fragments:
        say(frame(text.substr(0, 50), 0x01));
        say(frame("are you there", 0x89));
        say(frame(text.substr(50, 20), 0x00));
        say(frame(text.substr(70), 0x80));
        return;
      case Habit::Half:
        say(frame(text, 0x81).substr(0, 60));
        habit = Habit::Silent;
        return;
      case Habit::Large:
        large();
        return;
      case Habit::Garbage:
        say(frame(R"({"inverse3": [)", 0x81));
        return;
      case Habit::Opcode:
        say(frame("x", 0x85));
        return;
      case Habit::Closes:
        shutdown(client_, SHUT_RDWR);
        return;
      default:
        say(frame(text, 0x81));
    }
  }

  [[nodiscard]] std::string grip() const
  {
    return R"({"device_id":"61548","state":{"buttons":{"a":false,"b":true,"c":false},"orientation":)" +
      std::string(tilted ? R"({"w":0.70710678,"x":0.0,"y":0.70710678,"z":0.0}}})"
                         : R"({"w":1.0,"x":0.0,"y":0.0,"z":0.0}}})");
  }

  void large()
  {
    std::string front{ '\x81', '\x7F' };
    for (int i = 7; i >= 0; --i)
    {
      front += static_cast<char>(100'000'000ULL >> (8 * i));
    }
    say(front);
    const std::string part(100'000, ' ');
    for (int i = 0; i < 1000 && say(part); ++i)
    {
    }
  }

  static std::string frame(const std::string& text, int first)
  {
    std::string whole{ static_cast<char>(first) };
    if (text.size() < 126)
    {
      whole += static_cast<char>(text.size());
    }
    else
    {
      whole += '\x7E';
      whole += static_cast<char>(text.size() >> 8);
      whole += static_cast<char>(text.size());
    }
    return whole + text;
  }

  bool say(const std::string& text) const
  {
    return send(client_, text.data(), text.size(), MSG_NOSIGNAL) ==
      static_cast<ssize_t>(text.size());
  }

  std::string inventory_;
  int listening_;
  int client_ = -1;
  bool greeted_ = false;
  bool isCentered_ = false; // where its places are from
  std::jthread thread_;
};

} // namespace palp::test
