// A program that answers, in each way that one can.
#include "haptics/error.h"
#include "pipeline/process/child_process.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace
{

std::string crash(int signal)
{
  std::raise(signal);
  return {};
}

std::string waitForEver()
{
  for (;;)
  {
    pause();
  }
}

std::string workForEver()
{
  for (std::atomic<int> i = 0;; ++i)
  {
  }
}

std::string print()
{
  std::cout << "out" << std::endl;
  std::cerr << "err" << std::endl;
  return "done";
}

std::string takeTenGigabytes()
{
  std::vector<std::string> hoard;
  for (int i = 0; i < 1000; ++i)
  {
    hoard.emplace_back(10'000'000, 'x');
  }
  return "got ten gigabytes";
}

// larger than any pipe, with every byte
std::string manyBytes()
{
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    bytes[i] = static_cast<char>(i * 7 + i / 251);
  }
  return bytes;
}

// what somebody would do who got this process to run code of theirs: the names of what worked
std::string exploit()
{
  std::string worked;
  const auto attempt = [&](const char* name, long result)
  {
    if (result >= 0)
    {
      worked += std::string(name) + ' ';
    }
  };
  attempt("socket", socket(AF_INET, SOCK_STREAM, 0));
  attempt("local socket", socket(AF_UNIX, SOCK_STREAM, 0));
  attempt("read another file", open("/etc/passwd", O_RDONLY));
  attempt("write a file", open("/tmp/palp-exploit", O_WRONLY | O_CREAT, 0600));
  attempt("list a folder", open("/", O_RDONLY | O_DIRECTORY));
  attempt("fork", syscall(SYS_fork));
  attempt("clone", syscall(SYS_clone, SIGCHLD, 0, 0, 0, 0));
  attempt("run a program", execl("/bin/true", "true", nullptr));
  attempt("signal another", kill(getppid(), 0));
  attempt("trace another", ptrace(PTRACE_ATTACH, getppid(), 0, 0));
  attempt("make code",
    mprotect(mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0), 4096,
      PROT_READ | PROT_EXEC));
  attempt("remove", unlink("/tmp/palp-exploit"));
  attempt("descriptor 9", lseek(9, 0, SEEK_CUR));
  worked += environ && *environ ? "environment " : "";
  return worked;
}

// a file that it may read
std::string readAllowed()
{
  std::ifstream in("/proc/version");
  return std::string{ std::istreambuf_iterator<char>(in), {} }.empty() ? "nothing" : "read";
}

// as the kernel tells of this process
std::string privileges()
{
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line) && !line.starts_with("NoNewPrivs:"))
  {
  }
  return line;
}

} // namespace

int main(int, char** argv)
{
  const std::map<std::string, std::function<std::string()>> ways{
    { "bytes", manyBytes },
    { "nothing", [] { return std::string(); } },
    { "error", []() -> std::string { throw palp::Error(palp::ErrorCode::BadMesh, "a: b; c"); } },
    { "abort", [] { return crash(SIGABRT); } },
    { "segmentation", [] { return crash(SIGSEGV); } },
    { "exit 3", []() -> std::string { std::_Exit(3); } },
    { "exit 0", []() -> std::string { std::_Exit(0); } },
    { "no memory", []() -> std::string { throw std::bad_alloc(); } },
    { "wait", waitForEver },
    { "half",
      []
      {
        palp::answerProgress(0.25);
        palp::answerProgress(0.5);
        return std::string("done");
      } },
    { "work", workForEver },
    { "print", print },
    { "greedy", takeTenGigabytes },
    { "exploit", exploit },
    { "read", readAllowed },
    { "privileges", privileges },
  };
  palp::answer(ways.at(argv[1]), { .memory = 200'000'000, .time = 1 },
    { "/proc/version", "/proc/self/status" });
}
