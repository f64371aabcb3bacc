#include "tests/support/fuzz.h"

#include "haptics/error.h"
#include "tests/support/process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <set>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#ifdef PALP_SANITIZED
// what a process may take at once is limited here, as RLIMIT_DATA would take the shadow memory,
// too; short stacks of allocations save a third of the time
extern "C" const char* __asan_default_options() // NOLINT(bugprone-reserved-identifier): its name
{
  return "max_allocation_size_mb=832:allocator_may_return_null=1:malloc_context_size=4:"
         "quarantine_size_mb=16:allocator_release_to_os_interval_ms=-1";
}
#endif

namespace palp::test
{
namespace
{

// what a process tells of its work, also when it is no more
struct Shared
{
  int number;
  Result result;
};

double cpuTime()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void forgetPeak()
{
  const int file = open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
  (void)!write(file, "5", 1);
  close(file);
}

double peakGigabytes()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == "VmHWM:")
    {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1e-6 * kilobytes;
    }
  }
  return 0.0;
}

void allow(double time)
{
  const auto whole = static_cast<time_t>(time);
  const itimerval timer{ {},
    { whole, static_cast<suseconds_t>(1e6 * (time - static_cast<double>(whole))) } };
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(60); // a damaged heap can leave a process waiting
}

constexpr int kEndless = 100'000; // [min]

class Fuzzer
{
public:
  Fuzzer(const Fuzzed& kind, std::size_t memory, double time)
    : kind_(kind)
    , memory_(memory)
    , time_(time)
    , shared_(static_cast<Shared*>(
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)))
  {
  }

  ~Fuzzer()
  {
    munmap(shared_, sizeof(Shared));
  }
  Fuzzer(const Fuzzer&) = delete;
  Fuzzer& operator=(const Fuzzer&) = delete;

  Fates run(int count)
  {
    constexpr int kBatch = 2500; // files in one process: what they leak goes with it
    const char* minutes = std::getenv("PALP_FUZZ_MINUTES");
    const auto last = std::chrono::steady_clock::now() +
      std::chrono::minutes(minutes != nullptr ? std::atoi(minutes) : kEndless);
    for (int next = 0; next < count && std::chrono::steady_clock::now() < last;)
    {
      const int end = next + std::min(count - next, kBatch);
      const int done = batch(next, end);
      if (done < end)
      {
        judge(kind_, done, alone(done), fates_);
      }
      next = std::min(end, done + 1);
    }
    return fates_;
  }

private:
  // @return  the first number that was not done
  int batch(int first, int end)
  {
    int ends[2];
    if (pipe(ends) != 0)
    {
      throw std::runtime_error("no pipe");
    }
    const pid_t child = fork();
    if (child == 0)
    {
      close(ends[0]);
      limit();
      for (int number = first; number < end; ++number)
      {
        shared_->number = number;
        const Damaged damaged = damagedFile(kind_, number);
        work(damaged, kind_.read, true);
        (void)!write(ends[1], &shared_->result, sizeof(Result));
      }
      _exit(0);
    }
    close(ends[1]);
    int number = first;
    for (Result result; readWhole(ends[0], result); ++number)
    {
      judge(kind_, number, result, fates_);
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return number;
  }

  // reading and taking apart, as it is in earnest
  Result alone(int number)
  {
    const Damaged damaged = damagedFile(kind_, number);
    const std::filesystem::path answer = folder_.path() / "answer";
    Result reading;
    if (kind_.read)
    {
      const auto readOnly = [&](const std::filesystem::path& file)
      {
        const std::string bytes = kind_.read(file);
        std::ofstream(answer, std::ios::binary) << bytes;
        return bytes;
      };
      reading = apart([&] { work(damaged, readOnly, false); });
      if (reading.refused || reading.reached == Stage::Reading)
      {
        return reading;
      }
    }
    const auto readAnswer = [&](const std::filesystem::path&) { return readAll(answer); };
    using Read = std::function<std::string(const std::filesystem::path&)>;
    Result taking = apart([&] { work(damaged, kind_.read ? Read(readAnswer) : Read(), true); });
    taking.time += reading.time;
    taking.peak = std::max(taking.peak, reading.peak);
    return taking;
  }

  template <typename Work>
  Result apart(Work task)
  {
    shared_->result = {};
    const pid_t child = fork();
    if (child == 0)
    {
      limit();
      task();
      _exit(0);
    }
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    if (WIFSIGNALED(status)) // of its time and memory nothing else tells
    {
      const auto seconds = [](const timeval& time)
      { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
      shared_->result.time = seconds(used.ru_utime) + seconds(used.ru_stime);
      shared_->result.peak = 1e-6 * static_cast<double>(used.ru_maxrss); // of kilobytes
      std::snprintf(
        shared_->result.message, sizeof shared_->result.message, "%s", strsignal(WTERMSIG(status)));
      shared_->result.refused = false;
    }
    return shared_->result;
  }

  void limit() const
  {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    const rlimit none{ 0, 0 };
    setrlimit(RLIMIT_CORE, &none);
    if (!kSanitized)
    {
      const rlimit data{ memory_, memory_ };
      setrlimit(RLIMIT_DATA, &data);
    }
  }

  void work(const Damaged& damaged,
    const std::function<std::string(const std::filesystem::path&)>& read, bool taken)
  {
    Result& result = shared_->result;
    result = { .fault = damaged.fault };
    const std::filesystem::path file = folder_.path() / kind_.file;
    std::filesystem::remove(file); // one that is cut to nothing goes to the disk at once, on ext4
    std::ofstream(file, std::ios::binary) << damaged.text;
    forgetPeak();
    const double start = cpuTime();
    allow(time_);
    try
    {
      const std::string bytes = read ? read(file) : file.string();
      result.reached = Stage::Taking;
      allow(time_);
      if (taken && !(read && taken_.contains(bytes)))
      {
        kind_.take(bytes);
        taken_.insert(bytes);
      }
      result.reached = Stage::Done;
    }
    catch (const Error& error)
    {
      result.refused = true;
      std::snprintf(result.message, sizeof result.message, "%s", error.what());
    }
    catch (const std::bad_alloc&) // ends palp-read as a crash does
    {
      std::snprintf(result.message, sizeof result.message, "out of memory");
    }
    catch (const std::exception& error)
    {
      std::snprintf(result.message, sizeof result.message, "exception %s", error.what());
    }
    result.time = cpuTime() - start;
    result.peak = peakGigabytes();
  }

  static bool readWhole(int pipe, Result& result)
  {
    std::size_t done = 0;
    while (done < sizeof result)
    {
      const ssize_t n = ::read(pipe, reinterpret_cast<char*>(&result) + done, sizeof result - done);
      if (n <= 0)
      {
        return false;
      }
      done += static_cast<std::size_t>(n);
    }
    return true;
  }

  const Fuzzed& kind_;
  std::set<std::string> taken_; // answers of the reader: much damage changes none
  std::size_t memory_;
  double time_;
  Shared* shared_;
  TemporaryFolder folder_;
  Fates fates_;
};

} // namespace

Fates fuzz(const Fuzzed& kind, int count, std::size_t memory, double time)
{
  return Fuzzer(kind, memory, time).run(count);
}

} // namespace palp::test
