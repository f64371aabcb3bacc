#pragma once

#include "tests/support/file_calls.h"
#include "tests/support/process.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <spawn.h>
#include <string>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace palp::test
{

/// Text by name, without what is hidden.
using Files = std::map<std::string, std::string>;

inline Files filesIn(const std::filesystem::path& folder)
{
  Files files;
  std::error_code missing;
  for (auto at = std::filesystem::recursive_directory_iterator(folder, missing);
       at != std::filesystem::recursive_directory_iterator(); ++at)
  {
    const bool hidden = at->path().filename().string().starts_with(".");
    if (at->is_directory() && hidden)
    {
      at.disable_recursion_pending();
    }
    else if (!at->is_directory())
    {
      files[std::filesystem::relative(at->path(), folder).string()] = readAll(at->path());
    }
  }
  return files;
}

/// As before any run: what a killed one was publishing would else be finished there by the next.
inline void restore(const std::filesystem::path& folder, const Files& files)
{
  const std::filesystem::directory_iterator beside(folder.parent_path());
  const std::vector<std::filesystem::path> all(begin(beside), end(beside));
  std::ranges::for_each(all, [](const auto& path) { std::filesystem::remove_all(path); });
  for (const auto& [name, text] : files)
  {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
}

/// A program in a group of its own, killed with its children
class Victim
{
public:
  explicit Victim(const std::string& command)
  {
    std::string exec = "exec " + command + " >/dev/null 2>&1";
    std::string shell = "/bin/sh";
    std::string option = "-c";
    char* arguments[] = { shell.data(), option.data(), exec.data(), nullptr };
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    EXPECT_EQ(posix_spawn(&child_, shell.c_str(), nullptr, &attributes, arguments, environ), 0);
    posix_spawnattr_destroy(&attributes);
  }

  ~Victim()
  {
    kill(-child_, SIGKILL);
    int status = 0;
    waitpid(child_, &status, 0);
  }
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;

  [[nodiscard]] bool ended() const
  {
    siginfo_t state{};
    return waitid(P_PID, static_cast<id_t>(child_), &state, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      state.si_pid != 0;
  }

private:
  pid_t child_ = 0;
};

/// A program that stops before whatever it does to a file of a folder, as long as it is not killed
class Stepped
{
public:
  Stepped(const std::string& command, std::filesystem::path folder)
    : folder_(std::move(folder))
  {
    const std::string exec = "exec " + command + " >/dev/null 2>&1";
    main_ = fork();
    if (main_ == 0)
    {
      setpgid(0, 0);
      ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
      raise(SIGSTOP);
      execl("/bin/sh", "sh", "-c", exec.c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    waitpid(main_, &status, __WALL);
    constexpr long options = PTRACE_O_EXITKILL | PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE;
    EXPECT_EQ(ptrace(PTRACE_SETOPTIONS, main_, nullptr, options), 0);
    stopped_ = main_;
  }

  ~Stepped()
  {
    kill(-main_, SIGKILL);
    int status = 0;
    while (waitpid(-1, &status, __WALL) > 0) // its threads, too
    {
    }
  }
  Stepped(const Stepped&) = delete;
  Stepped& operator=(const Stepped&) = delete;

  /// Goes on to before the next change; false: it has ended
  [[nodiscard]] bool next()
  {
    ptrace(PTRACE_SYSCALL, stopped_, nullptr, nullptr);
    int status = 0;
    while ((stopped_ = waitpid(-1, &status, __WALL)) > 0)
    {
      if (!WIFSTOPPED(status))
      {
        if (stopped_ == main_)
        {
          return false;
        }
        continue; // a thread
      }
      const int signal = WSTOPSIG(status);
      const bool isCall = signal == (SIGTRAP | 0x80);
      if (isCall && changesFiles(stopped_, folder_))
      {
        return true;
      }
      const bool isOwn = isCall || signal == SIGTRAP || signal == SIGSTOP; // of the tracing
      ptrace(PTRACE_SYSCALL, stopped_, nullptr, static_cast<long>(isOwn ? 0 : signal));
    }
    return false;
  }

private:
  std::filesystem::path folder_;
  pid_t main_ = 0;
  pid_t stopped_ = 0; // the thread that waits to go on
};

} // namespace palp::test
