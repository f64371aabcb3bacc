#include "pipeline/child_process.h"

#include "haptics/error.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palp
{
namespace
{

// the first byte tells what follows
constexpr char kResult = 'R';
constexpr char kError = 'E'; // then the code in one byte, and the message

// sanitizers reserve more than any limit
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif

void writeAll(int pipe, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t n = write(pipe, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno != EINTR)
    {
      return; // the parent is gone
    }
    done += n > 0 ? static_cast<std::size_t>(n) : 0;
  }
}

std::string readAll(int pipe)
{
  std::string bytes;
  char buffer[1 << 16];
  for (;;)
  {
    const ssize_t n = read(pipe, buffer, sizeof buffer);
    if (n > 0)
    {
      bytes.append(buffer, static_cast<std::size_t>(n));
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

[[noreturn]] void serve(const std::function<std::string()>& work, ChildLimits limits, int pipe)
{
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.time);
  if (kLimitMemory)
  {
    limit(RLIMIT_DATA, limits.memory);
  }
  for (const int signal : { SIGXCPU, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGALRM })
  {
    std::signal(signal, SIG_DFL);
  }
  // a damaged heap can leave the child waiting for a lock, which takes no processor time
  constexpr std::uint64_t kPatience = 3; // of the time on the processor, for a busy machine
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  alarm(static_cast<unsigned>(kPatience * limits.time));
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  int status = 0;
  try
  {
    writeAll(pipe, kResult + work());
  }
  catch (const Error& error)
  {
    writeAll(pipe, std::string{ kError, static_cast<char>(error.code()) } + error.what());
  }
  catch (const std::exception&)
  {
    status = 1; // out of memory
  }
  _exit(status); // and nothing of the parent is flushed or closed here
}

} // namespace

std::optional<std::string> runInChild(const std::function<std::string()>& work, ChildLimits limits)
{
  int ends[2] = { -1, -1 };
  pid_t child = -1;
  if (pipe2(ends, O_CLOEXEC) == 0)
  {
    child = fork();
  }
  if (child < 0)
  {
    const int why = errno;
    close(ends[0]);
    close(ends[1]);
    throw Error(ErrorCode::BadFile,
      std::string("reader: cannot be started (") + std::strerror(why) + "); close some programs");
  }
  if (child == 0)
  {
    close(ends[0]);
    serve(work, limits, ends[1]);
  }
  close(ends[1]);
  const std::string answer = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty())
  {
    return std::nullopt;
  }
  if (answer[0] == kError)
  {
    throw Error(static_cast<ErrorCode>(answer[1]), answer.substr(2));
  }
  return answer.substr(1);
}

} // namespace palp
