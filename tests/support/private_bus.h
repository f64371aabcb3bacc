#pragma once

#include "haptics/files/descriptor.h"
#include "tests/support/process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <spawn.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace palp::test
{

/// A bus of its own in place of the system's, for this process and those that it starts; nobody is
/// on it at first.
class PrivateBus
{
public:
  PrivateBus()
  {
    setenv("DBUS_SYSTEM_BUS_ADDRESS", ("unix:path=" + socket()).c_str(), 1);
  }
  ~PrivateBus()
  {
    for (const pid_t child : children_)
    {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
  PrivateBus(const PrivateBus&) = delete;
  PrivateBus& operator=(const PrivateBus&) = delete;

  void startDaemon()
  {
    std::ofstream(folder() / "bus.conf")
      << "<busconfig><type>system</type><listen>unix:path=" << socket()
      << "</listen><policy context=\"default\"><allow user=\"*\"/><allow own=\"*\"/>"
      << "<allow send_destination=\"*\"/><allow receive_sender=\"*\"/></policy></busconfig>";
    start({ "/usr/bin/dbus-daemon", "--nofork", "--nopidfile",
      "--config-file=" + (folder() / "bus.conf").string() });
    for (int i = 0; i < kAttempts && !answers(); ++i)
    {
      std::this_thread::sleep_for(kPause);
    }
    ASSERT_TRUE(answers()) << "its socket is there before it listens";
  }

  /// @param words  program and arguments; empty ones are left out
  void start(std::vector<std::string> words)
  {
    std::erase(words, "");
    std::vector<char*> arguments;
    for (std::string& word : words)
    {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    pid_t child = -1;
    ASSERT_EQ(posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ), 0);
    children_.push_back(child);
  }

  static void await(const std::filesystem::path& file)
  {
    for (int i = 0; i < kAttempts && !std::filesystem::exists(file); ++i)
    {
      std::this_thread::sleep_for(kPause);
    }
    ASSERT_TRUE(std::filesystem::exists(file));
  }

  [[nodiscard]] const std::filesystem::path& folder() const
  {
    return folder_.path();
  }

private:
  static constexpr int kAttempts = 1000;
  static constexpr std::chrono::milliseconds kPause{ 10 };

  [[nodiscard]] bool answers() const
  {
    sockaddr_un address{ .sun_family = AF_UNIX, .sun_path = {} };
    socket().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const Descriptor peer(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    return connect(peer.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }

  [[nodiscard]] std::string socket() const
  {
    return folder() / "bus";
  }

  TemporaryFolder folder_;
  std::vector<pid_t> children_;
};

} // namespace palp::test
