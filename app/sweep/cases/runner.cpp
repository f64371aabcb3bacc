#include "app/sweep/cases/runner.h"

#include "app/program/progress_line.h"
#include "app/program/sha256.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_process.h"
#include "app/sweep/cases/case_record.h"
#include "app/sweep/cases/claim.h"
#include "app/sweep/cases/input_watch.h"
#include "app/sweep/cases/result_rows.h"
#include "app/sweep/cases/waiting_signals.h"
#include "haptics/error.h"
#include "haptics/files/prefix.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <deque>
#include <map>
#include <sys/wait.h>

namespace palp
{
namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr timespec kBeat{ .tv_sec = 5, .tv_nsec = 0 };           // far below Claim's silence
constexpr int kLooks = 3;                                        // for a signal that is on its way
constexpr timespec kLook{ .tv_sec = 0, .tv_nsec = 200'000'000 }; // at what another runner has

struct Work
{
  PlannedCase planned;
  std::vector<std::string> words;
  std::vector<std::string> files; // that it reads
  Claim claim;
  Clock::time_point begin;
};

struct Releasing // whatever happens
{
  const Claim& claim;
  ~Releasing()
  {
    claim.release();
  }
};

class Runner
{
public:
  Runner(Manifest& manifest, unsigned jobs, bool checks)
    : manifest_(manifest)
    , folders_{ manifest.folder() }
    , jobs_(jobs)
    , checks_(checks)
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

  static void refuseAsked(int signal)
  {
    if (signal > 0 && signal != SIGCHLD)
    {
      throw Error(ErrorCode::NoSolution,
        "interrupted; the cases that were finished stay, the same command goes on with the others");
    }
  }

  // a case that ended by what asks us to end, too, for all of the group were asked
  void endIfAsked(const Ended& ended) const
  {
    for (int i = 0; WIFSIGNALED(ended.status) && i < kLooks; ++i)
    {
      refuseAsked(signals_.wait(kLook));
    }
  }

  // until something ends, or for some time
  void pause(const timespec& most)
  {
    refuseAsked(signals_.wait(most));
    for (Ended ended = endedProcess(); ended.process >= 0; ended = endedProcess())
    {
      if (const auto found = running_.find(ended.process); found != running_.end())
      {
        const Work work = std::move(found->second);
        running_.erase(found); // its number may be another's from now on
        const Releasing claim{ work.claim };
        endIfAsked(ended);
        tryFinish(work, ended);
      }
    }
    for (const auto& [process, work] : running_)
    {
      work.claim.beat();
    }
  }

  [[nodiscard]] bool isFinished(const std::string& name) const
  {
    return folders_.isDone(name) &&
      (!checks_ || isIntact(folders_.result(name), manifest_.head().kind));
  }

  void start(std::size_t number)
  {
    PlannedCase planned = manifest_.at(number);
    if (isFinished(planned.name))
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
    else if (isFinished(planned.name)) // since we looked
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
      out = resultTable(result, head.kind);
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

  // at any moment another runner may take over what was silent for long
  void tryFinish(const Work& work, const Ended& ended)
  {
    try
    {
      finish(work, ended);
    }
    catch (const std::exception&)
    {
      if (work.claim.isOurs())
      {
        throw;
      }
      elsewhere_.push_back(work.planned.number);
    }
  }

  void finish(const Work& work, const Ended& ended)
  {
    inputs_.refuseTouched(work.files, work.planned.number);
    const fs::path log = work.claim.folder() / kLogFile;
    const bool good = ended.status == 0;
    const fs::path result = work.claim.folder() / work.planned.name;
    std::string sentence = good ? "" : lastWords(log, ended.status);
    if (const std::size_t at = sentence.find(result.string()); at != sentence.npos)
    {
      sentence.replace(at, result.string().size(), folders_.failure(work.planned.name).string());
    }
    refuseFull(sentence, work.planned.number);
    fs::create_directories(result); // a failed one may have none
    fs::rename(log, result / kLogFile);
    describe(work, result, ended, sentence);
    if (good && hasWarning(result / kLogFile))
    {
      outcome_.warned.push_back(work.planned.number);
    }
    good ? keepResult(work, result) : keepFailure(work, result, sentence);
  }

  void describe(
    const Work& work, const fs::path& result, const Ended& ended, const std::string& sentence) const
  {
    CaseRecord record{ .name = work.planned.name,
      .number = work.planned.number,
      .command = work.words,
      .seconds = std::chrono::duration<double>(Clock::now() - work.begin).count(),
      .memory = ended.memory,
      .failed = sentence };
    if (sentence.empty())
    {
      Sha256 hash;
      hash.addFile(resultTable(result, manifest_.head().kind));
      record.tableSha256 = hash.hex();
    }
    writeRecord(result, record);
  }

  void keepResult(const Work& work, const fs::path& result)
  {
    const fs::path place = folders_.result(work.planned.name);
    std::error_code ignored;
    if (!isFinished(work.planned.name)) // but damaged
    {
      fs::rename(place, work.claim.folder() / "before", ignored);
    }
    publishCase(result, place);
    fs::remove_all(folders_.failure(work.planned.name), ignored);
    ++outcome_.computed;
  }

  void keepFailure(const Work& work, const fs::path& result, const std::string& sentence)
  {
    const fs::path place = folders_.failure(work.planned.name);
    std::error_code ignored;
    fs::rename(place, work.claim.folder() / "before", ignored);
    publishCase(result, place);
    outcome_.failed.push_back(work.planned.number);
    progress_.tell("case " + std::to_string(work.planned.number) + ": " + sentence + " (" +
      (place / kLogFile).string() + ")");
  }

  Manifest& manifest_;
  CaseFolders folders_;
  std::size_t jobs_;
  bool checks_; // finished ones, too
  InputWatch inputs_;
  WaitingSignals signals_;
  ProgressLine progress_{ "cases" }; // its thread leaves the signals to us, too
  std::map<pid_t, Work> running_;
  std::deque<std::size_t> elsewhere_; // cases that another runner has
  bool waits_ = false;                // for these, and said so
  RunOutcome outcome_;
};

} // namespace

RunOutcome runCases(
  Manifest& manifest, const std::vector<std::size_t>& numbers, unsigned jobs, bool checks)
{
  return Runner(manifest, jobs, checks).run(numbers);
}

} // namespace palp
