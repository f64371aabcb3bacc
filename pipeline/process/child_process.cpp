#include "pipeline/process/child_process.h"

#include "haptics/error.h"
#include "haptics/threads/followed_work.h"
#include "pipeline/process/sandbox.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

// the first byte tells what follows
constexpr char kResult = 'R';
constexpr char kError = 'E'; // then the code in one byte, and the message
constexpr char kDone = 'D';  // then percent in one byte, and another such message

// sanitizers reserve more than any limit, make calls of their own, and take several times as long
#ifdef PALP_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

bool writeAll(int pipe, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t n = write(pipe, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR)
    {
      return false; // the parent is gone
    }
    done += n > 0 ? static_cast<std::size_t>(n) : 0;
  }
  return true;
}

// tells what an answer begins with of its progress
void takeProgress(std::string& answer)
{
  std::size_t told = 0;
  for (; told + 1 < answer.size() && answer[told] == kDone; told += 2)
  {
    FollowedWork* work = FollowedWork::ofThisThread();
    work != nullptr ? work->tell(answer[told + 1] / 100.0) : void();
  }
  answer.erase(0, told);
}

std::string readAll(int pipe, bool isAnswer)
{
  std::string bytes;
  std::vector<char> buffer(1 << 20);
  for (;;)
  {
    const ssize_t n = read(pipe, buffer.data(), buffer.size());
    if (n > 0)
    {
      bytes.append(buffer.data(), static_cast<std::size_t>(n));
      isAnswer ? takeProgress(bytes) : void();
    }
    else if (n == 0 || errno != EINTR)
    {
      return bytes;
    }
  }
}

void limit(int resource, std::uint64_t most)
{
  const rlimit limits{ .rlim_cur = most, .rlim_max = most };
  setrlimit(resource, &limits);
}

// what is answered of a crash: made before it, as then nothing can be
struct LastWords
{
  int output = -1;
  std::string text;
};

LastWords& lastWords()
{
  static LastWords words;
  return words;
}

extern "C" void sayLastWords(int)
{
  const LastWords& words = lastWords();
  const auto size = static_cast<ssize_t>(words.text.size());
  const bool said = size > 0 && write(words.output, words.text.data(), words.text.size()) == size;
  _exit(said ? 0 : 1);
}

// @return  the child, or nothing with errno
std::optional<pid_t> spawn(
  const std::vector<std::string>& command, int output, bool keepsEnvironment)
{
  std::vector<char*> arguments(command.size() + 1); // the last one ends the list
  std::ranges::transform(command, arguments.begin(),
    [](const std::string& argument) { return const_cast<char*>(argument.c_str()); });
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  pid_t child = -1;
  char* none[] = { nullptr };
  const int failure = posix_spawn(
    &child, arguments[0], &files, &attributes, arguments.data(), keepsEnvironment ? environ : none);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  errno = failure;
  return failure == 0 ? std::optional(child) : std::nullopt;
}

// a program that nobody waits for any longer is ended, not left alone
std::string outputWhileWanted(pid_t child, int pipe, bool isAnswer)
{
  FollowedWork* work = FollowedWork::ofThisThread();
  const std::stop_callback end(
    work != nullptr ? work->token() : std::stop_token(), [child] { kill(child, SIGKILL); });
  return readAll(pipe, isAnswer);
}

// standard output of a program that ended well, else nothing
std::optional<std::string> run(
  const std::vector<std::string>& command, bool keepsEnvironment, bool isAnswer)
{
  int ends[2] = { -1, -1 };
  const bool piped = pipe2(ends, O_CLOEXEC) == 0;
  constexpr int kRoom = 1 << 20;             // [bytes]
  (void)fcntl(ends[0], F_SETPIPE_SZ, kRoom); // else both wait for each other every 64 KiB
  const std::optional<pid_t> child =
    piped ? spawn(command, ends[1], keepsEnvironment) : std::nullopt;
  const int why = errno;
  close(ends[1]);
  if (!child)
  {
    close(ends[0]);
    throw Error(ErrorCode::BadFile,
      command[0] + ": cannot be started (" + std::generic_category().message(why) + "); " +
        (why == ENOENT || why == EACCES ? "build or install it, or name its prefix in PALP_PREFIX"
                                        : "close some programs"));
  }
  std::string output = outputWhileWanted(*child, ends[0], isAnswer);
  close(ends[0]);
  int status = 0;
  while (waitpid(*child, &status, 0) < 0 && errno == EINTR)
  {
  }
  checkWanted();
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? std::optional(std::move(output))
                                                       : std::nullopt;
}

} // namespace

std::optional<std::string> outputOf(const std::vector<std::string>& command)
{
  return run(command, true, false);
}

std::optional<std::string> answerOf(const std::vector<std::string>& command)
{
  std::optional<std::string> answer = run(command, kSanitized, true);
  if (!answer || answer->empty())
  {
    return std::nullopt;
  }
  if (answer->front() == kError)
  {
    throw Error(static_cast<ErrorCode>((*answer)[1]), answer->substr(2));
  }
  answer->erase(0, 1);
  return answer;
}

void answer(const std::function<std::string()>& work, ChildLimits limits,
  const std::vector<std::filesystem::path>& readable)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd asker{ .fd = STDOUT_FILENO, .events = 0, .revents = 0 };
  if (poll(&asker, 1, 0) > 0 && (asker.revents & POLLERR) != 0)
  {
    _exit(1); // who asked ended before that
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, (kSanitized ? 4 : 1) * limits.time);
  limit(RLIMIT_NOFILE, 16);
  if (!kSanitized)
  {
    limit(RLIMIT_DATA, limits.memory);
    limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_NPROC, 0);
  }
  // a damaged heap can leave a process waiting for a lock, which takes no processor time
  constexpr std::uint64_t kPatience = 6; // of the time on the processor, for a busy machine
  alarm(static_cast<unsigned>(kPatience * limits.time));
  const int output = dup(STDOUT_FILENO);
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  if (!kSanitized)
  {
    enterSandbox(output, readable);
  }
  lastWords().output = output;
  for (const int crash : { SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV })
  {
    std::signal(crash, sayLastWords);
  }
  bool answered = false;
  try
  {
    const std::string result = work(); // not copied, for it may be large
    answered = writeAll(output, { kResult }) && writeAll(output, result);
  }
  catch (const Error& error)
  {
    answered =
      writeAll(output, std::string{ kError, static_cast<char>(error.code()) } + error.what());
  }
  catch (const std::exception&) // out of memory
  {
  }
  _exit(answered ? 0 : 1); // a damaged heap is not taken down in order
}

void blameForACrash(const std::filesystem::path& file)
{
  lastWords().text = file.empty() ? std::string()
                                  : std::string{ kError, static_cast<char>(ErrorCode::BadFile) } +
      file.string() + ": damaged or cut off; export or copy it again";
}

void answerProgress(double done)
{
  static char told = 0;
  const auto percent = static_cast<char>(std::clamp(100.0 * done, 0.0, 100.0));
  if (lastWords().output >= 0 && percent != told)
  {
    told = percent;
    writeAll(lastWords().output, { kDone, percent });
  }
}

} // namespace palp
