// A program that answers, in each way that one can.
#include "haptics/error.h"
#include "pipeline/child_process.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <new>
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
    { "work", workForEver },
    { "print", print },
    { "greedy", takeTenGigabytes },
  };
  palp::answer(ways.at(argv[1]), { .memory = 200'000'000, .time = 1 });
}
