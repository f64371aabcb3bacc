#pragma once

#include "tests/support/process.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <spawn.h>
#include <string>
#include <sys/ptrace.h>
#include <sys/syscall.h>
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
      if (isCall && changesFiles())
      {
        return true;
      }
      const bool isOwn = isCall || signal == SIGTRAP || signal == SIGSTOP; // of the tracing
      ptrace(PTRACE_SYSCALL, stopped_, nullptr, static_cast<long>(isOwn ? 0 : signal));
    }
    return false;
  }

private:
  [[nodiscard]] bool changesFiles() const
  {
    __ptrace_syscall_info call{};
    if (ptrace(PTRACE_GET_SYSCALL_INFO, stopped_, sizeof call, &call) <= 0 ||
      call.op != PTRACE_SYSCALL_INFO_ENTRY)
    {
      return false;
    }
    const auto argument = [&call](int i) { return static_cast<long>(call.entry.args[i]); };
    switch (call.entry.nr)
    {
      case SYS_rename:
      case SYS_renameat:
      case SYS_renameat2:
      case SYS_unlink:
      case SYS_unlinkat:
      case SYS_mkdir:
      case SYS_mkdirat:
      case SYS_rmdir:
      case SYS_link:
      case SYS_linkat:
      case SYS_symlink:
      case SYS_symlinkat:
      case SYS_truncate:
        return true;
      case SYS_open:
        return (argument(1) & (O_CREAT | O_TRUNC)) != 0;
      case SYS_openat:
        return (argument(2) & (O_CREAT | O_TRUNC)) != 0;
      case SYS_write:
      case SYS_writev:
      case SYS_pwrite64:
      case SYS_ftruncate:
      case SYS_fallocate:
      case SYS_sendfile:
        return isInFolder(argument(0));
      case SYS_copy_file_range:
        return isInFolder(argument(2));
      default:
        return false;
    }
  }

  [[nodiscard]] bool isInFolder(long descriptor) const
  {
    std::error_code gone;
    const std::filesystem::path file = std::filesystem::read_symlink(
      "/proc/" + std::to_string(stopped_) + "/fd/" + std::to_string(descriptor), gone);
    return file.string().starts_with(folder_.string());
  }

  std::filesystem::path folder_;
  pid_t main_ = 0;
  pid_t stopped_ = 0; // the thread that waits to go on
};

} // namespace palp::test
