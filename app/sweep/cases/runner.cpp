#include "app/sweep/cases/runner.h"

#include "app/program/machine.h"
#include "app/program/progress_line.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_process.h"
#include "app/sweep/cases/claim.h"
#include "app/sweep/cases/input_watch.h"
#include "app/sweep/cases/waiting_signals.h"
#include "haptics/error.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <deque>
#include <fstream>
#include <map>

namespace palp
{
namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr timespec kBeat{ .tv_sec = 5, .tv_nsec = 0 };           // far below Claim's silence
constexpr timespec kLook{ .tv_sec = 0, .tv_nsec = 200'000'000 }; // at what another runner has

struct Work
{
  PlannedCase planned;
  std::vector<std::string> words;
  std::vector<std::string> files; // that it reads
  Claim claim;
  Clock::time_point begin;
};

class Runner
{
public:
  Runner(Manifest& manifest, unsigned jobs)
    : manifest_(manifest)
    , folders_{ manifest.folder() }
    , jobs_(jobs)
    , inputs_(manifest.head().files)
  {
    std::error_code failed;
    fs::create_directories(folders_.claims(), failed);
    if (failed)
    {
      refuseFile(folders_.claims(), failed.value());
    }
    Claim::tidy(folders_.claims());
  }

  ~Runner() // where an error or a signal ended it
  {
    for (auto& [process, work] : running_)
    {
      kill(process, SIGKILL);
    }
    while (!running_.empty() && (endedProcess().process >= 0 || errno != ECHILD))
    {
      (void)signals_.wait(kLook);
    }
    for (auto& [process, work] : running_)
    {
      work.claim.release();
    }
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  RunOutcome run(const std::vector<std::size_t>& numbers)
  {
    std::deque<std::size_t> waiting(numbers.begin(), numbers.end());
    while (!waiting.empty() || !running_.empty() || !elsewhere_.empty())
    {
      while (!waiting.empty() && running_.size() < jobs_)
      {
        start(waiting.front());
        waiting.pop_front();
        tellProgress(numbers.size());
      }
      if (running_.empty() && elsewhere_.empty())
      {
        break;
      }
      tellWaiting(waiting.empty());
      pause(elsewhere_.empty() ? kBeat : kLook);
      tellProgress(numbers.size());
      if (waiting.empty() && running_.size() < jobs_)
      {
        waiting.swap(elsewhere_);
      }
    }
    return std::move(outcome_);
  }

private:
  void tellProgress(std::size_t total)
  {
    progress_(outcome_.before + outcome_.computed, total);
  }

  // once, for it may take long
  void tellWaiting(bool lastOnes)
  {
    if (lastOnes && running_.empty() && !waits_)
    {
      waits_ = true;
      progress_.tell("case " + std::to_string(elsewhere_.front()) +
        " is being computed by another runner; waiting for it");
    }
  }

  // until something ends, or for some time
  void pause(const timespec& most)
  {
    const int signal = signals_.wait(most);
    if (signal > 0 && signal != SIGCHLD)
    {
      throw Error(ErrorCode::NoSolution,
        "interrupted; the cases that were finished stay, the same command goes on with the others");
    }
    for (Ended ended = endedProcess(); ended.process >= 0; ended = endedProcess())
    {
      if (const auto found = running_.find(ended.process); found != running_.end())
      {
        finish(found->second, ended);
        running_.erase(found);
      }
    }
    for (const auto& [process, work] : running_)
    {
      work.claim.beat();
    }
  }

  void start(std::size_t number)
  {
    PlannedCase planned = manifest_.at(number);
    if (folders_.isDone(planned.name))
    {
      ++outcome_.before;
      return;
    }
    const SweepValues options = checkedOptions(planned);
    std::optional<Claim> claim = Claim::take(folders_.claims(), planned.name);
    if (!claim)
    {
      elsewhere_.push_back(number);
    }
    else if (folders_.isDone(planned.name)) // since we looked
    {
      claim->release();
      ++outcome_.before;
    }
    else
    {
      launch(std::move(planned), options, std::move(*claim));
    }
  }

  void launch(PlannedCase planned, const SweepValues& options, Claim claim)
  {
    const SweepHead& head = manifest_.head();
    std::vector<std::string> words = caseWords(head.kind, options, head.flags);
    words.insert(words.begin(), (prefix() / "bin/palp").string());
    const fs::path result = claim.folder() / planned.name;
    fs::path out = "/dev/null";
    std::vector<std::string> full = words;
    if (head.kind == "force")
    {
      fs::create_directory(result);
      out = result / "force.csv";
    }
    else
    {
      full.insert(full.end(), { "--no-picture", "--out=" + result.string() });
    }
    const pid_t process = startProcess(full, out, claim.folder() / kLogFile);
    running_.emplace(process,
      Work{
        std::move(planned), std::move(words), filesOf(options), std::move(claim), Clock::now() });
  }

  // the case's options; it and its files are what they were when it was planned
  SweepValues checkedOptions(const PlannedCase& planned)
  {
    const SweepHead& head = manifest_.head();
    SweepValues options = optionsOf(head, planned.values);
    for (const std::string& file : filesOf(options))
    {
      inputs_.check(file);
    }
    manifest_.refuseEdited(planned, options);
    return options;
  }

  // nobody can tell which of both was read
  void refuseTouched(const Work& work) const
  {
    for (const std::string& file : work.files)
    {
      if (inputs_.isTouched(file))
      {
        throw Error(ErrorCode::BadFile,
          file + ": was edited while case " + std::to_string(work.planned.number) +
            " was computed, which is thrown away; plan again, which keeps what is finished");
      }
    }
  }

  void finish(Work& work, const Ended& ended)
  {
    const fs::path log = work.claim.folder() / kLogFile;
    if (!fs::exists(log)) // we were silent for so long that another runner took it over
    {
      elsewhere_.push_back(work.planned.number);
      return;
    }
    refuseTouched(work);
    const bool good = ended.status == 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - work.begin).count();
    const fs::path result = work.claim.folder() / work.planned.name;
    std::string sentence = good ? "" : lastWords(log, ended.status);
    if (const std::size_t at = sentence.find(result.string()); at != sentence.npos)
    {
      sentence.replace(at, result.string().size(), folders_.failure(work.planned.name).string());
    }
    fs::create_directories(result); // a failed one may have none
    fs::rename(log, result / kLogFile);
    describe(work, result / kCaseFile, seconds, ended.memory, sentence);
    if (good && warns(result / kLogFile))
    {
      outcome_.warned.push_back(work.planned.number);
    }
    good ? keepResult(work, result) : keepFailure(work, result, sentence);
    work.claim.release();
  }

  static bool warns(const fs::path& log)
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

  static void describe(const Work& work, const fs::path& file, double seconds, double memory,
    const std::string& sentence)
  {
    const nlohmann::ordered_json about{ { "case", work.planned.number }, { "command", work.words },
      { "seconds", seconds }, { "memory_MiB", std::ceil(memory / 1024.0 / 1024.0) },
      { "processor", processorName() }, { "failed", sentence } };
    if (!(std::ofstream(file) << about.dump(2) << '\n').flush())
    {
      refuseFile(file, errno);
    }
  }

  void keepResult(const Work& work, const fs::path& result)
  {
    publish(result, folders_.result(work.planned.name));
    std::error_code ignored;
    fs::remove_all(folders_.failure(work.planned.name), ignored);
    ++outcome_.computed;
  }

  void keepFailure(const Work& work, const fs::path& result, const std::string& sentence)
  {
    const fs::path place = folders_.failure(work.planned.name);
    std::error_code ignored;
    fs::rename(place, work.claim.folder() / "before", ignored);
    publish(result, place);
    outcome_.failed.push_back(work.planned.number);
    progress_.tell("case " + std::to_string(work.planned.number) + ": " + sentence + " (" +
      (place / kLogFile).string() + ")");
  }

  // one of two runners is first; both have the same
  static void publish(const fs::path& result, const fs::path& place)
  {
    std::error_code failed;
    fs::create_directories(place.parent_path(), failed);
    for (const auto& entry : fs::directory_iterator(result))
    {
      if (const int reason = syncToDisk(entry.path()))
      {
        refuseFile(place, reason);
      }
    }
    if (rename(result.c_str(), place.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST)
    {
      refuseFile(place, errno);
    }
    syncToDisk(place.parent_path());
  }

  Manifest& manifest_;
  CaseFolders folders_;
  std::size_t jobs_;
  InputWatch inputs_;
  WaitingSignals signals_;
  ProgressLine progress_{ "cases" }; // its thread leaves the signals to us, too
  std::map<pid_t, Work> running_;
  std::deque<std::size_t> elsewhere_; // cases that another runner has
  bool waits_ = false;                // for these, and said so
  RunOutcome outcome_;
};

} // namespace

RunOutcome runCases(Manifest& manifest, const std::vector<std::size_t>& numbers, unsigned jobs)
{
  return Runner(manifest, jobs).run(numbers);
}

} // namespace palp
