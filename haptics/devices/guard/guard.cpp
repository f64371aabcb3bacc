#include "haptics/devices/guard/guard.h"

#include "haptics/error.h"
#include "haptics/files/descriptor.h"
#include "haptics/files/prefix.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

// a copy above those that a guardian is born with
int copied(int file) noexcept
{
  return file < 0 ? -1 : fcntl(file, F_DUPFD_CLOEXEC, kGuardLink + 1);
}

int moved(int file) noexcept
{
  const Descriptor low(file);
  return copied(file);
}

[[noreturn]] void refuse(const std::string& what)
{
  throw Error(ErrorCode::NoDevice,
    "palp-guard: " + what + "; no device with motors is driven without it, so install all of palp");
}

// a Ctrl-Z, a hang-up or a full terminal of the program's is none of its business
pid_t spawn(const std::string& program, const std::array<std::pair<int, int>, 4>& files)
{
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  for (int file = 0; file < kGuardBlock; ++file)
  {
    posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
  }
  for (const auto& [from, to] : files)
  {
    posix_spawn_file_actions_adddup2(&actions, from, to);
  }
  posix_spawn_file_actions_addclosefrom_np(&actions, kGuardLink + 1);
  posix_spawnattr_t attributes{};
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  sigset_t blocked;
  sigfillset(&blocked);
  posix_spawnattr_setsigmask(&attributes, &blocked);
  std::string name = program;
  std::array<char*, 2> arguments{ name.data(), nullptr };
  const char* bus = std::getenv("DBUS_SYSTEM_BUS_ADDRESS"); // NOLINT(concurrency-mt-unsafe)
  std::string where = std::string("DBUS_SYSTEM_BUS_ADDRESS=") + (bus != nullptr ? bus : "");
  std::array<char*, 2> environment{ bus != nullptr ? where.data() : nullptr, nullptr };
  pid_t process = -1;
  const int error = posix_spawn(
    &process, program.c_str(), &actions, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
  {
    refuse(program + " cannot be started (" + std::generic_category().message(error) + ")");
  }
  return process;
}

} // namespace

Guard::Guard(int device, GuardWire wire, const ZeroPacket& zero)
{
  Descriptor memory(moved(memfd_create("palp-guard", MFD_CLOEXEC)));
  std::array<int, 2> ends{ -1, -1 };
  const bool piped = pipe2(ends.data(), O_CLOEXEC) == 0;
  Descriptor theirs(piped ? moved(ends[0]) : -1);
  Descriptor ours(piped ? moved(ends[1]) : -1);
  Descriptor self(moved(static_cast<int>(syscall(SYS_pidfd_open, getpid(), 0))));
  Descriptor shared(copied(device));
  if (memory.get() < 0 || !piped || self.get() < 0 || shared.get() < 0 ||
    ftruncate(memory.get(), sizeof(GuardBlock)) != 0)
  {
    refuse("no descriptors are left to share the device with");
  }
  void* mapped =
    mmap(nullptr, sizeof(GuardBlock), PROT_READ | PROT_WRITE, MAP_SHARED, memory.get(), 0);
  if (mapped == MAP_FAILED)
  {
    refuse("no memory is left to share with it");
  }
  block_ = new (mapped) GuardBlock;
  block_->limit = std::chrono::nanoseconds(kLimit).count();
  block_->wire = wire;
  block_->zero = zero;
  beat();
  try
  {
    process_ = spawn((prefix() / "bin/palp-guard").string(),
      { { { memory.get(), kGuardBlock }, { shared.get(), kGuardDevice },
        { self.get(), kGuardProgram }, { theirs.get(), kGuardLink } } });
  }
  catch (...)
  {
    munmap(mapped, sizeof(GuardBlock));
    throw;
  }
  link_ = copied(ours.get());
  constexpr auto kPatience = std::chrono::seconds(5); // of a machine with much else to do
  for (const auto last = std::chrono::steady_clock::now() + kPatience; block_->watched == 0;)
  {
    if (!lives() || std::chrono::steady_clock::now() > last)
    {
      kill(process_, SIGKILL);
      end();
      refuse("it was started and does not answer");
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  beat();
}

bool Guard::lives() const noexcept
{
  constexpr std::int64_t kPatience = 500'000'000; // [ns], of a machine under load
  if (block_->watched != 0 && nanoseconds(CLOCK_MONOTONIC) - block_->guardianBeat > kPatience)
  {
    return false;
  }
  pollfd link{ link_, POLLOUT, 0 };
  return poll(&link, 1, 0) <= 0 || (link.revents & POLLERR) == 0;
}

Guard::~Guard()
{
  end();
}

void Guard::end() noexcept
{
  constexpr auto kPatience = std::chrono::milliseconds(500);
  block_->closed = 1;
  close(link_);
  const auto last = std::chrono::steady_clock::now() + kPatience;
  for (pid_t ended = 0; ended == 0 || (ended < 0 && errno == EINTR);)
  {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    if (std::chrono::steady_clock::now() > last)
    {
      kill(process_, SIGKILL); // it is stopped
    }
    ended = waitpid(process_, nullptr, WNOHANG);
  }
  munmap(block_, sizeof(GuardBlock));
}

} // namespace palp
