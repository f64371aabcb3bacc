#include "app/sweep/plan.h"

#include "app/input/mesh_file.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/manifest.h"
#include "app/sweep/sweep_range.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <system_error>

namespace palp
{
namespace
{

constexpr std::size_t kMostChecks = 1000; // of one axis

// every name of a sweep and what it can be
using Texts = std::map<std::string, std::vector<std::string>>;

Texts textsOf(const Sweep& sweep)
{
  Texts texts;
  for (const auto& [name, value] : sweep.fixed)
  {
    texts[name] = { value };
  }
  for (const SweepAxis& axis : sweep.axes)
  {
    for (std::size_t i = 0; i < axis.names.size(); ++i)
    {
      for (const auto& row : axis.rows)
      {
        texts[axis.names[i]].push_back(row[i]);
      }
    }
  }
  return texts;
}

// a name that neither the command nor another value knows would change nothing
void refuseUnknown(const Sweep& sweep, const Texts& texts, const CommandOptions& options)
{
  const std::string begin = sweep.file + ": ";
  std::set<std::string> used;
  for (const auto& [name, values] : texts)
  {
    for (const std::string& value : values)
    {
      const auto names = namesIn(value);
      used.insert(names.begin(), names.end());
    }
  }
  std::string known;
  for (const auto* part : { &options.values, &options.flags })
  {
    for (const std::string& name : *part)
    {
      addListed(known, name);
    }
  }
  for (const auto& [name, values] : texts)
  {
    if (!options.values.contains(name) && !options.flags.contains(name) && !used.contains(name))
    {
      if (options.own.contains(name))
      {
        throw Error(ErrorCode::BadFile,
          begin + inQuotes(name) +
            ": changes no number of a case, or is set by the sweep itself; leave it out");
      }
      throw Error(ErrorCode::BadFile,
        std::string(begin)
          .append(inQuotes(name))
          .append(": palp ")
          .append(sweep.kind)
          .append(" has no such option, and no value holds ")
          .append(inQuotes(std::string("{").append(name).append("}")))
          .append("; known here: ")
          .append(known));
    }
    const auto isWord = [](const std::string& value)
    { return value == "true" || value == "false"; };
    if (options.flags.contains(name) && !std::ranges::all_of(values, isWord))
    {
      throw Error(
        ErrorCode::BadFile, begin + inQuotes(name) + ": is there or not; give true or false");
    }
  }
}

SweepColumn columnOf(
  const std::string& file, const std::string& name, const std::vector<std::string>& values)
{
  const auto first = numberText(values.front());
  for (const std::string& value : values)
  {
    const auto number = numberText(value);
    if (first && number && number->unit != first->unit)
    {
      throw Error(ErrorCode::BadFile,
        file + ": " + inQuotes(name) + ": has values in different units, " +
          inQuotes(values.front()) + " and " + inQuotes(value) + "; write all of them in one");
    }
  }
  const auto isAlike = [&](const std::string& value)
  {
    const auto number = numberText(value);
    return number && number->unit == first->unit;
  };
  if (!first || !std::ranges::all_of(values, isAlike))
  {
    return { name };
  }
  return { name, first->unit, true };
}

// a sweep as its plan: files by absolute path, with what they hold
class Planner
{
public:
  Planner(const Sweep& sweep, const std::filesystem::path& beside, const CommandOptions& options)
    : sweep_(sweep)
    , head_{ .title = sweep.title,
      .kind = sweep.kind,
      .count = sweep.count(),
      .beside = beside.lexically_normal(),
      .fixed = sweep.fixed,
      .plots = sweep.plots }
  {
    const Texts texts = textsOf(sweep_);
    refuseUnknown(sweep_, texts, options);
    bool names = false; // a file
    for (const auto& [option, values] : texts)
    {
      const std::string& name = option; // which a lambda can hold
      const bool isFlag = options.flags.contains(name);
      if (isFlag || options.values.contains(name))
      {
        head_.options.insert(name);
      }
      if (isFlag)
      {
        head_.flags.insert(name);
      }
      names |= std::ranges::any_of(
        values, [&](const std::string& value) { return mayNameFile(name, value); });
    }
    for (const std::string& name : sweep_.names())
    {
      addColumn(columnOf(sweep_.file, name, texts.at(name)));
    }
    sweep_.refuseEqualRows();
    for (const SweepPlot& plot : sweep_.plots)
    {
      refuseNowhere(plot, texts);
    }
    for (std::size_t i = 0; names && i < head_.count; ++i)
    {
      addFiles(optionsOf(head_, sweep_.values(i)));
    }
  }

  [[nodiscard]] const SweepHead& head() const
  {
    return head_;
  }

  [[nodiscard]] PlannedCase caseAt(std::size_t number) const
  {
    PlannedCase one{ number, {}, sweep_.values(number) };
    one.name = caseName(sweep_.kind, optionsOf(head_, one.values), head_.files);
    return one;
  }

  void check(std::size_t number, const CheckCase& check) const
  {
    try
    {
      check(caseWords(sweep_.kind, optionsOf(head_, sweep_.values(number)), head_.flags));
    }
    catch (const Error& error)
    {
      throw Error(
        error.code(), sweep_.file + ": case " + std::to_string(number) + ": " + error.what());
    }
  }

  // the numbers of cases in which every row of every axis stands
  [[nodiscard]] std::vector<std::size_t> samples() const
  {
    std::vector<std::size_t> numbers{ 0 };
    std::size_t stride = head_.count;
    for (const SweepAxis& axis : sweep_.axes)
    {
      stride /= axis.rows.size();
      const std::size_t checks = std::min(axis.rows.size(), kMostChecks);
      for (std::size_t i = 1; i < checks; ++i)
      {
        numbers.push_back(
          i * (axis.rows.size() - 1) / std::max<std::size_t>(1, checks - 1) * stride);
      }
    }
    return numbers;
  }

private:
  // the value of another name may become one of these
  static bool mayNameFile(const std::string& name, const std::string& value)
  {
    return !fileOf(name, value).empty() || !fileOf("tip", value).empty();
  }

  void addColumn(const SweepColumn& column)
  {
    for (const SweepColumn& other : head_.columns)
    {
      if (other.title() == column.title())
      {
        throw Error(ErrorCode::BadFile,
          sweep_.file + ": " + inQuotes(other.name) + " and " + inQuotes(column.name) +
            ": would both be the column " + inQuotes(column.title()) +
            " of the merged table; rename one");
      }
    }
    head_.columns.push_back(column);
  }

  // what a column of results holds is not known yet
  void refuseNowhere(const SweepPlot& plot, const Texts& texts) const
  {
    for (const SweepColumn& column : head_.columns)
    {
      const auto asked = plot.where.find(column.title());
      const auto isAsked = [&](const std::string& value)
      { return column.cell(value) == asked->second; };
      if (asked != plot.where.end() && std::ranges::none_of(texts.at(column.name), isAsked))
      {
        throw Error(ErrorCode::BadFile,
          sweep_.file + ": plot " + inQuotes(plot.name) + ": no " + column.title() + " is " +
            inQuotes(asked->second) + "; they are written as " +
            inQuotes(column.cell(texts.at(column.name).front())));
      }
    }
  }

  void addFiles(const SweepValues& options)
  {
    for (const std::string& file : filesOf(options))
    {
      if (!head_.files.contains(file))
      {
        head_.files[file] = describeFile(file).sha256;
      }
    }
  }

  const Sweep& sweep_;
  SweepHead head_;
};

} // namespace

namespace
{

// what tells one plan in a folder from another; empty: there is none
std::string planned(const std::filesystem::path& folder)
{
  std::error_code none;
  const std::filesystem::path file = CaseFolders{ folder }.plan();
  if (!std::filesystem::exists(file, none))
  {
    return "";
  }
  if (!Manifest::isOne(file))
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": is no plan of a sweep and would be lost; give another folder");
  }
  return describeFile(file).sha256;
}

} // namespace

PlanTold planSweep(const Sweep& sweep, const std::filesystem::path& beside,
  const CommandOptions& options, const CheckCase& check, const std::filesystem::path& folder)
{
  Planner planner(sweep, beside, options);
  for (const std::size_t number : planner.samples())
  {
    planner.check(number, check);
  }
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
  {
    refuseFile(folder, failed.value());
  }
  const CaseFolders folders{ folder };
  const bool earlier = std::filesystem::exists(folders.results());
  const std::string before = planned(folder);
  PlanTold told{ .count = planner.head().count };
  Manifest::write(folder, planner.head(),
    [&](std::size_t number)
    {
      PlannedCase one = planner.caseAt(number);
      told.done += earlier && folders.isDone(one.name) ? 1 : 0;
      return one;
    });
  if (!before.empty() && planned(folder) != before)
  {
    for (const char* numbered : { kSlurmFile, kParallelFile, kJobLog }) // as the cases were before
    {
      std::filesystem::remove(folder / numbered, failed);
    }
  }
  return told;
}

} // namespace palp
