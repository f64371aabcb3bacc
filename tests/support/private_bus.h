#pragma once

#include "tests/support/process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <spawn.h>
#include <string>
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
    await(socket());
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
    for (int i = 0; i < 1000 && !std::filesystem::exists(file); ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_TRUE(std::filesystem::exists(file));
  }

  [[nodiscard]] const std::filesystem::path& folder() const
  {
    return folder_.path();
  }

private:
  [[nodiscard]] std::string socket() const
  {
    return folder() / "bus";
  }

  TemporaryFolder folder_;
  std::vector<pid_t> children_;
};

} // namespace palp::test
