#include "app/sweep/cases/status.h"

#include "app/sweep/case_folders.h"
#include "app/sweep/cases/case_record.h"
#include "app/sweep/cases/claim.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace palp
{
namespace
{

namespace fs = std::filesystem;
using Names = std::unordered_set<std::string>;

constexpr std::size_t kMostTimes = 200; // that are read for the median
constexpr std::size_t kMostTold = 20;   // failures

// nothing where there is none
fs::directory_iterator entriesOf(const fs::path& folder)
{
  std::error_code why;
  fs::directory_iterator entries(folder, why);
  if (why && why != std::errc::no_such_file_or_directory)
  {
    refuseUnread(folder, why);
  }
  return entries;
}

void addNames(const fs::path& folder, Names& names)
{
  for (const auto& entry : entriesOf(folder))
  {
    if (std::string name = entry.path().filename(); entry.is_directory() && !isHidden(name))
    {
      names.insert(std::move(name));
    }
  }
}

// without a look at each of them
Names namesBelow(const fs::path& folder)
{
  Names names;
  for (const auto& entry : entriesOf(folder))
  {
    addNames(entry.path(), names);
  }
  return names;
}

double medianTime(const CaseFolders& folders, const Names& done)
{
  std::vector<double> times;
  const std::size_t step = std::max<std::size_t>(1, done.size() / kMostTimes);
  std::size_t at = 0;
  for (const std::string& name : done)
  {
    if (const auto record = at++ % step == 0 ? readRecord(folders.result(name)) : std::nullopt)
    {
      times.push_back(record->seconds);
    }
  }
  if (times.empty())
  {
    return 0.0;
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

std::string inWords(double seconds)
{
  const double minutes = seconds / 60.0;
  const double hours = minutes / 60.0;
  const auto rounded = [](double value, const char* unit)
  { return std::to_string(std::lround(std::ceil(value))) + unit; };
  return seconds < 120.0 ? rounded(seconds, " s")
    : minutes < 120.0    ? rounded(minutes, " min")
                         : rounded(hours, " h");
}

} // namespace

SweepStatus statusOf(Manifest& manifest)
{
  const CaseFolders folders{ manifest.folder() };
  const Names done = namesBelow(folders.results());
  const Names failed = namesBelow(folders.failures());
  Names running;
  addNames(folders.claims(), running);
  std::erase_if(
    running, [&](const std::string& name) { return !Claim::isHeld(folders.claims(), name); });
  SweepStatus status{ .count = manifest.head().count };
  manifest.forEach(
    [&](const PlannedCase& one)
    {
      if (done.contains(one.name))
      {
        ++status.done;
      }
      else if (running.contains(one.name))
      {
        ++status.running;
      }
      else if (failed.contains(one.name))
      {
        const auto record = readRecord(folders.failure(one.name));
        status.failed.push_back({ one.number, record ? record->failed : "its record is damaged",
          folders.failure(one.name) / kLogFile });
      }
    });
  status.secondsEach = medianTime(folders, done);
  return status;
}

std::string describe(const SweepStatus& status, const SweepHead& head)
{
  std::string text = head.title + ": " + std::to_string(status.done) + " of " +
    counted(status.count, "case") + " done, " + std::to_string(status.running) + " running, " +
    std::to_string(status.failed.size()) + " failed, " + std::to_string(status.waiting()) +
    " waiting";
  const std::size_t left = status.running + status.waiting();
  if (left > 0 && status.secondsEach > 0.0)
  {
    const std::size_t atATime = std::max<std::size_t>(1, status.running);
    text += "; about " +
      inWords(status.secondsEach * static_cast<double>(left) / static_cast<double>(atATime)) +
      " left with " + std::to_string(atATime) + " at a time";
  }
  text += '\n';
  for (std::size_t i = 0; i < std::min(kMostTold, status.failed.size()); ++i)
  {
    const FailedCase& one = status.failed[i];
    text += "case " + std::to_string(one.number) + " failed: " + one.sentence + " (" +
      one.log.string() + ")\n";
  }
  if (status.failed.size() > kMostTold)
  {
    text += "and " + std::to_string(status.failed.size() - kMostTold) + " more\n";
  }
  return text;
}

} // namespace palp
