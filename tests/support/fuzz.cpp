#include "tests/support/fuzz.h"

#include "haptics/error.h"
#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

namespace palp::test
{
namespace
{

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true; // reserves more than any limit
#else
constexpr bool kSanitized = false;
#endif

// ---- damage

std::size_t below(Random& random, std::size_t n)
{
  return n < 2 ? 0 : std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

void overwrite(std::string& text, std::size_t at, const std::string& by)
{
  text.replace(at, std::min(by.size(), text.size() - at), by.substr(0, text.size() - at));
}

std::string bytesOf(auto value)
{
  return { reinterpret_cast<const char*>(&value), sizeof value };
}

// a number in a text becomes one that few expect
void changeNumber(std::string& text, std::size_t at, Random& random)
{
  static const std::array<std::string, 14> kNumbers{ "-1", "0", "1", "2", "99999999", "4294967296",
    "-9223372036854775808", "1e308", "1e30", "-1e9", "nan", "inf", "", "x" };
  const std::size_t begin = text.find_first_of("0123456789", at);
  if (begin != text.npos)
  {
    const std::size_t end = text.find_first_not_of("0123456789.eE+-", begin);
    text.replace(
      begin, std::min(end, text.size()) - begin, kNumbers[below(random, kNumbers.size())]);
  }
}

void damage(std::string& text, const Fuzzed& kind, Random& random)
{
  static const std::array<std::string, 12> kBytes{ bytesOf(0), bytesOf(-1), bytesOf(0x7fffffff),
    bytesOf(1e30F), bytesOf(std::nanf("")), bytesOf(1e308), std::string(1, '\0'), "\xff", "\x7f",
    " ", "\n", "-" };
  if (text.empty())
  {
    return;
  }
  // the head of a file is where damage tells most
  const std::size_t reach =
    below(random, 2) == 0 ? text.size() : std::min<std::size_t>(text.size(), 400);
  const std::size_t at = below(random, reach);
  const std::size_t length = 1 + below(random, std::min<std::size_t>(text.size() - at, 64));
  const std::string& other = kind.whole[below(random, kind.whole.size())];
  switch (below(random, 9))
  {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << below(random, 8)));
      break;
    case 1:
      text[at] = static_cast<char>(below(random, 256));
      break;
    case 2:
      overwrite(text, at, kBytes[below(random, kBytes.size())]);
      break;
    case 3:
      text.erase(at, length);
      break;
    case 4:
      text.insert(at, text.substr(below(random, text.size()), length));
      break;
    case 5:
      changeNumber(text, at, random);
      break;
    case 6:
      text.resize(at);
      break;
    case 7:
      text.resize(at);
      text += other.substr(std::min(other.size(), at + below(random, 8)));
      break;
    default:
      text.insert(at, std::string(length * 100, text[at]));
      break;
  }
}

struct Damaged
{
  std::string text;
  const Fault* fault = nullptr; // null: several, or of an unknown cause
};

Damaged damagedFile(const Fuzzed& kind, int number)
{
  Random random(static_cast<unsigned>(number));
  const std::string& whole = kind.whole[below(random, kind.whole.size())];
  const auto stored = [&](const std::string& text) { return kind.pack ? kind.pack(text) : text; };
  if (below(random, 5) < 2)
  {
    const Fault& fault = kind.faults[below(random, kind.faults.size())];
    if (auto text = fault.make(fault.packed ? stored(whole) : whole, random))
    {
      return { fault.packed ? *text : stored(*text), &fault };
    }
  }
  const bool within = below(random, 2) == 0;
  std::string text = within ? whole : stored(whole);
  for (std::size_t i = 1 + below(random, 3); i > 0; --i)
  {
    damage(text, kind, random);
  }
  return { within ? stored(text) : text };
}

// ---- one process for many files

enum class Stage : int
{
  Reading,
  Taking,
  Done,
};

struct Result
{
  Stage reached = Stage::Reading;
  bool refused = false;
  double time = 0.0; // [s]
  double peak = 0.0; // [GB]
  char message[1000] = {};
};

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
    constexpr int kBatch = 1000; // files in one process: what they leak goes with it
    for (int next = 0; next < count;)
    {
      const int end = std::min(count, next + kBatch);
      const int done = batch(next, end);
      if (done < end)
      {
        judge(done, alone(done));
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
        work(damagedFile(kind_, number).text, kind_.read, true);
        (void)!write(ends[1], &shared_->result, sizeof(Result));
      }
      _exit(0);
    }
    close(ends[1]);
    int number = first;
    for (Result result; readWhole(ends[0], result); ++number)
    {
      judge(number, result);
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return number;
  }

  // reading and taking apart, as it is in earnest
  Result alone(int number)
  {
    const std::string text = damagedFile(kind_, number).text;
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
      reading = apart([&] { work(text, readOnly, false); });
      if (reading.refused || reading.reached == Stage::Reading)
      {
        return reading;
      }
    }
    const auto readAnswer = [&](const std::filesystem::path&) { return readAll(answer); };
    using Read = std::function<std::string(const std::filesystem::path&)>;
    Result taking = apart([&] { work(text, kind_.read ? Read(readAnswer) : Read(), true); });
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

  void work(const std::string& text,
    const std::function<std::string(const std::filesystem::path&)>& read, bool taken) const
  {
    Result& result = shared_->result;
    result = {};
    const std::filesystem::path file = folder_.path() / kind_.file;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    forgetPeak();
    const double start = cpuTime();
    allow(time_);
    try
    {
      const std::string bytes = read ? read(file) : file.string();
      result.reached = Stage::Taking;
      allow(time_);
      if (taken)
      {
        kind_.take(bytes);
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

  void judge(int number, const Result& result)
  {
    const Fault* fault = damagedFile(kind_, number).fault;
    const std::string message = result.message;
    const auto wrong = [&](const std::string& what)
    {
      fates_.wrong.push_back("number " + std::to_string(number) +
        (fault ? std::string(", ") + fault->name : "") + ": " + what + ": " + message);
    };
    ++fates_.count;
    fates_.longest = std::max(fates_.longest, result.time);
    fates_.peak = std::max(fates_.peak, result.peak);
    const bool contained = !result.refused && result.reached == Stage::Reading && kind_.read;
    fates_.crashed += contained;
    fates_.refused += result.refused;
    fates_.read += result.reached == Stage::Done;
    if (!result.refused && !contained && result.reached != Stage::Done)
    {
      wrong("crash, limit or exception outside the reader");
    }
    if (result.refused)
    {
      checkSentence(message, wrong);
    }
    if (!fault)
    {
      return;
    }
    if (result.reached == Stage::Done && fault->refused)
    {
      wrong("taken");
    }
    if (result.refused || contained)
    {
      ++fates_.known;
      const bool isNamed = result.refused && std::regex_search(message, std::regex(fault->words));
      fates_.named += isNamed;
      constexpr std::size_t most = 400;
      if (!isNamed && fates_.unnamed.size() < most)
      {
        fates_.unnamed.push_back(
          std::string(fault->name) + ": " + std::to_string(number) + ": " + message);
      }
    }
  }

  // one line, which begins with the file and ends with what to do
  template <typename Wrong>
  void checkSentence(const std::string& message, Wrong wrong) const
  {
    constexpr std::size_t longest = 500;
    const bool printable = std::ranges::all_of(message, [](char c) { return c >= ' ' || c < 0; });
    if (!printable || message.size() > longest || message.find(kind_.file) == message.npos)
    {
      wrong("no sentence for people");
    }
  }

  const Fuzzed& kind_;
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

void expectGoodFates(const Fuzzed& kind, const Fates& fates)
{
  const double share = fates.known == 0 ? 1.0 : 1.0 * fates.named / fates.known;
  std::printf(
    "%-12s %6d files: %d read, %d refused, %d readers crashed; of %d known faults %.2f %% "
    "named; at most %.2f s, %.3f GB\n",
    kind.file.c_str(), fates.count, fates.read, fates.refused, fates.crashed, fates.known,
    100.0 * share, fates.longest, fates.peak);
  EXPECT_LE(fates.longest, 5.0);
  if (!kSanitized)
  {
    EXPECT_LE(fates.peak, 1.0);
  }
  EXPECT_GE(share, 0.95);
  EXPECT_TRUE(fates.wrong.empty()) << fates.wrong.size() << " wrong, the first: " << fates.wrong[0];
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; share < 0.95 && i < std::min(shown, fates.unnamed.size()); ++i)
  {
    std::printf("  not named: %s\n", fates.unnamed[i].c_str());
  }
  if (const char* log = std::getenv("PALP_FUZZ_LOG"))
  {
    std::ofstream out(log, std::ios::app);
    for (const auto* list : { &fates.wrong, &fates.unnamed })
    {
      for (const std::string& line : *list)
      {
        out << kind.file << (list == &fates.wrong ? " WRONG " : " unnamed ") << line << '\n';
      }
    }
  }
}

Fault cutOff(std::string words, std::size_t shortest, bool refused)
{
  return { "cut off",
    [shortest](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      // a number that lost its last digits is one still
      const std::size_t last = whole.find_last_of(" \t\r\n", whole.find_last_not_of(" \t\r\n"));
      if (last <= shortest)
      {
        return std::nullopt;
      }
      return whole.substr(0, shortest + below(random, last - shortest));
    },
    std::move(words), refused };
}

Fault replaced(const char* name, const std::string& pattern, const std::string& by,
  std::string words, bool refused)
{
  return { name,
    [expression = std::regex(pattern), by](
      const std::string& whole, Random& random) -> std::optional<std::string>
    {
      const std::vector<std::smatch> matches(
        std::sregex_iterator(whole.begin(), whole.end(), expression), {});
      if (matches.empty())
      {
        return std::nullopt;
      }
      const std::smatch& match = matches[below(random, matches.size())];
      return std::string(whole.begin(), match[0].first) + match.format(by) +
        std::string(match[0].second, whole.end());
    },
    std::move(words), refused };
}

Fault overwritten(const char* name, std::size_t at, std::size_t step, std::size_t count,
  const std::string& by, std::string words, bool refused)
{
  return { name,
    [=](const std::string& whole, Random& random) -> std::optional<std::string>
    {
      const std::size_t place = at + step * below(random, count);
      if (place + by.size() > whole.size())
      {
        return std::nullopt;
      }
      std::string text = whole;
      overwrite(text, place, by);
      return text;
    },
    std::move(words), refused };
}

Fault foreign(const std::string& content, std::string words)
{
  return { "another kind of file", [content](const std::string&, Random&) { return content; },
    std::move(words) };
}

} // namespace palp::test
