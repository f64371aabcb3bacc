#include "app/sweep/cases/case_process.h"

#include "haptics/error.h"
#include "haptics/files/descriptor.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>

namespace palp
{
namespace
{

constexpr int kCannotStart = 127; // exit code, as of a shell

Descriptor openNew(const std::filesystem::path& file)
{
  Descriptor out(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (!out)
  {
    refuseFile(file, errno);
  }
  return out;
}

} // namespace

pid_t startProcess(const std::vector<std::string>& words, const std::filesystem::path& out,
  const std::filesystem::path& log)
{
  std::vector<char*> arguments(words.size() + 1); // the last one ends the list
  std::ranges::transform(words, arguments.begin(),
    [](const std::string& word) { return const_cast<char*>(word.c_str()); });
  const Descriptor output = openNew(out);
  const Descriptor errors = openNew(log);
  const Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
  sigset_t none;
  sigemptyset(&none);
  const pid_t self = getpid();
  const pid_t child = fork(); // not posix_spawn, which cannot tie its life to ours
  if (child == 0)
  {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(nothing.get(), STDIN_FILENO);
    dup2(output.get(), STDOUT_FILENO);
    dup2(errors.get(), STDERR_FILENO);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    if (getppid() == self)
    {
      execv(arguments[0], arguments.data());
    }
    _exit(kCannotStart);
  }
  if (child < 0)
  {
    throw Error(ErrorCode::BadFile,
      words[0] + ": cannot be started (" + std::generic_category().message(errno) +
        "); close some programs");
  }
  return child;
}

Ended endedProcess()
{
  Ended ended;
  rusage used = {};
  ended.process = std::max<pid_t>(-1, wait4(-1, &ended.status, WNOHANG, &used));
  ended.process = ended.process == 0 ? -1 : ended.process;
  ended.memory = 1024.0 * static_cast<double>(used.ru_maxrss);
  return ended;
}

std::string lastWords(const std::filesystem::path& log, int status)
{
  if (WIFSIGNALED(status))
  {
    const int signal = WTERMSIG(status);
    return std::string("ended by the signal ") + sigdescr_np(signal) +
      (signal == SIGKILL ? ", perhaps for want of memory" : "") + "; try it by itself";
  }
  constexpr std::string_view kBegin = "palp: ";
  std::ifstream in(log);
  std::string words = "it failed and said nothing; try it by itself";
  for (std::string line; std::getline(in, line);)
  {
    words = line.empty() ? words : line;
  }
  return printable(words.starts_with(kBegin) ? words.substr(kBegin.size()) : words);
}

void refuseFull(const std::string& sentence, std::size_t number)
{
  if (sentence.find(std::generic_category().message(ENOSPC)) != sentence.npos)
  {
    throw Error(ErrorCode::BadFile,
      "case " + std::to_string(number) + ": " + sentence +
        "; make room and run again, which keeps what is finished");
  }
}

bool hasWarning(const std::filesystem::path& log)
{
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with("palp: warning:"))
    {
      return true;
    }
  }
  return false;
}

} // namespace palp
