#include "pipeline/process/sandbox.h"

#include <cstdint>
#include <fcntl.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace palp
{
namespace
{

// all rights over files that the first version knows; reading is given back for what is listed
constexpr std::uint64_t kRead = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t kAll = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;

void restrictFiles(const std::vector<std::filesystem::path>& readable) noexcept
{
  const landlock_ruleset_attr attributes{ .handled_access_fs = kAll };
  const auto rules =
    static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (rules < 0)
  {
    return; // a kernel without it
  }
  for (const std::filesystem::path& path : readable)
  {
    const int file = open(path.empty() ? "." : path.c_str(), O_PATH | O_CLOEXEC);
    std::error_code none;
    const std::uint64_t list =
      std::filesystem::is_directory(path, none) ? LANDLOCK_ACCESS_FS_READ_DIR : 0;
    const landlock_path_beneath_attr below{ .allowed_access = kRead | list, .parent_fd = file };
    syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0);
    close(file);
  }
  syscall(SYS_landlock_restrict_self, rules, 0);
  close(rules);
}

// what memory, reading, and an orderly or a sudden end need
constexpr int kCalls[] = { SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise),
  SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(lseek), SCMP_SYS(_llseek),
  SCMP_SYS(close), SCMP_SYS(fstat), SCMP_SYS(fstat64), SCMP_SYS(newfstatat), SCMP_SYS(fstatat64),
  SCMP_SYS(stat), SCMP_SYS(stat64), SCMP_SYS(lstat), SCMP_SYS(lstat64), SCMP_SYS(statx),
  SCMP_SYS(access), SCMP_SYS(faccessat), SCMP_SYS(faccessat2), SCMP_SYS(readlink),
  SCMP_SYS(readlinkat), SCMP_SYS(getcwd), SCMP_SYS(getdents64), SCMP_SYS(futex),
  SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(times),
  SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep), SCMP_SYS(sched_yield),
  SCMP_SYS(sched_getaffinity), SCMP_SYS(getrusage), SCMP_SYS(getrandom), SCMP_SYS(sysinfo),
  SCMP_SYS(uname), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(getuid), SCMP_SYS(geteuid),
  SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(pause),
  SCMP_SYS(restart_syscall), SCMP_SYS(exit), SCMP_SYS(exit_group) };

void restrictCalls(int output) noexcept
{
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(1)); // EPERM: the reader may go on without
  if (filter == nullptr)
  {
    return;
  }
  const auto allow = [&](int call) { seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0); };
  const auto allowIf = [&](int call, const scmp_arg_cmp& condition)
  { seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, condition); };
  for (const int call : kCalls)
  {
    allow(call);
  }
  // opening to read; memory that is no code; signals to itself; writing to the one descriptor
  constexpr scmp_datum_t kWrites = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
  allowIf(SCMP_SYS(open), { 1, SCMP_CMP_MASKED_EQ, kWrites, 0 });
  allowIf(SCMP_SYS(openat), { 2, SCMP_CMP_MASKED_EQ, kWrites, 0 });
  allowIf(SCMP_SYS(mmap), { 2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0 });
  allowIf(SCMP_SYS(mprotect), { 2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0 });
  const auto self = static_cast<scmp_datum_t>(getpid());
  allowIf(SCMP_SYS(tgkill), { 0, SCMP_CMP_EQ, self, 0 });
  allowIf(SCMP_SYS(kill), { 0, SCMP_CMP_EQ, self, 0 });
  const auto only = static_cast<scmp_datum_t>(output);
  allowIf(SCMP_SYS(write), { 0, SCMP_CMP_EQ, only, 0 });
  allowIf(SCMP_SYS(writev), { 0, SCMP_CMP_EQ, only, 0 });
  allowIf(SCMP_SYS(fcntl), { 1, SCMP_CMP_EQ, F_GETFL, 0 });
  allowIf(SCMP_SYS(fcntl), { 1, SCMP_CMP_EQ, F_SETFD, 0 }); // of a folder that is opened
  seccomp_load(filter);                                     // fails where the kernel has none
  seccomp_release(filter);
}

} // namespace

void enterSandbox(int output, const std::vector<std::filesystem::path>& readable) noexcept
{
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0); // which both of the others ask for
  restrictFiles(readable);
  restrictCalls(output);
}

} // namespace palp
