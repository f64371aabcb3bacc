#pragma once

#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <system_error>

namespace palp::test
{

/// Whether a descriptor of a process is one of a file in a folder.
inline bool isOfFolder(pid_t process, long descriptor, const std::filesystem::path& folder)
{
  std::error_code gone;
  const std::filesystem::path file = std::filesystem::read_symlink(
    "/proc/" + std::to_string(process) + "/fd/" + std::to_string(descriptor), gone);
  return file.string().starts_with(folder.string());
}

/// Whether a thread that is traced, with PTRACE_O_TRACESYSGOOD, has stopped before a call that
/// changes what is in a folder; a kill at any other call leaves there what the one before left.
inline bool changesFiles(pid_t stopped, const std::filesystem::path& folder)
{
  __ptrace_syscall_info call{};
  if (ptrace(PTRACE_GET_SYSCALL_INFO, stopped, sizeof call, &call) <= 0 ||
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
      return isOfFolder(stopped, argument(0), folder);
    case SYS_copy_file_range:
      return isOfFolder(stopped, argument(2), folder);
    default:
      return false;
  }
}

} // namespace palp::test
