#include "app/sweep/manifest.h"

#include "app/sweep/case_folders.h"
#include "app/sweep/sweep_range.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <numeric>

namespace palp
{
namespace
{

using nlohmann::json;

constexpr const char* kAnyFirst = "# palp sweep ";
constexpr const char* kFirst = "# palp sweep 1: all that its cases share, then a line for each";

json toJson(const SweepHead& head)
{
  json columns = json::array();
  for (const SweepColumn& column : head.columns)
  {
    columns.push_back(
      { { "name", column.name }, { "unit", column.unit }, { "is_number", column.isNumber } });
  }
  json plots = json::array();
  for (const SweepPlot& plot : head.plots)
  {
    plots.push_back(
      { { "name", plot.name }, { "title", plot.title }, { "x", plot.x }, { "y", plot.y },
        { "curves", plot.curves }, { "colors", plot.colors }, { "where", plot.where } });
  }
  return { { "palp", PALP_VERSION }, { "title", head.title }, { "kind", head.kind },
    { "count", head.count }, { "beside", head.beside.string() }, { "columns", columns },
    { "fixed", head.fixed }, { "options", head.options }, { "flags", head.flags },
    { "files", head.files }, { "plots", plots } };
}

SweepHead headOf(const json& from)
{
  SweepHead head{ .title = from.at("title"),
    .kind = from.at("kind"),
    .count = from.at("count"),
    .beside = from.at("beside").get<std::string>() };
  for (const json& column : from.at("columns"))
  {
    head.columns.push_back({ column.at("name"), column.at("unit"), column.at("is_number") });
  }
  for (const json& plot : from.at("plots"))
  {
    head.plots.push_back({ plot.at("name"), plot.at("title"), plot.at("x"), plot.at("y"),
      plot.at("curves"), plot.value("colors", ""), plot.at("where").get<SweepValues>() });
  }
  head.fixed = from.at("fixed").get<SweepValues>();
  head.options = from.at("options").get<std::set<std::string>>();
  head.flags = from.at("flags").get<std::set<std::string>>();
  head.files = from.at("files").get<SweepValues>();
  return head;
}

// a number at the start of a line
std::size_t lineNumber(const std::string& line)
{
  std::size_t number = kMostCases;
  std::from_chars(line.data(), line.data() + line.size(), number);
  return number;
}

[[noreturn]] void refusePlan(const std::filesystem::path& folder, const std::string& what)
{
  throw Error(ErrorCode::BadFile, CaseFolders{ folder }.plan().string() + ": " + what);
}

} // namespace

std::string SweepColumn::title() const
{
  std::string words;
  for (const char c : unit)
  {
    words += c == '/' ? "_per_" : c == '*' ? "" : std::string(1, c);
  }
  return words.empty() ? name : name + "_" + words;
}

std::string SweepColumn::cell(const std::string& value) const
{
  const auto number = isNumber ? numberText(value) : std::nullopt;
  return number ? shortest(number->number) : value;
}

SweepValues optionsOf(const SweepHead& head, const std::vector<std::string>& values)
{
  SweepValues all = head.fixed;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    all[head.columns[i].name] = values[i];
  }
  SweepValues options = filledIn(all);
  std::erase_if(options, [&](const auto& entry) { return !head.options.contains(entry.first); });
  for (auto& [option, value] : options)
  {
    value = besideFolder(option, value, head.beside);
  }
  return options;
}

Manifest::Manifest(std::filesystem::path folder)
  : folder_(std::move(folder))
{
  errno = 0;
  file_.open(CaseFolders{ folder_ }.plan());
  std::string first;
  std::string shared;
  if (!std::getline(file_, first))
  {
    if (errno == EACCES)
    {
      refuseUnread(CaseFolders{ folder_ }.plan(), { EACCES, std::generic_category() });
    }
    refusePlan(folder_, "no sweep is planned there; begin with palp sweep plan SWEEP.json DIR");
  }
  if (first != kFirst)
  {
    refusePlan(folder_,
      "is of another version of sweeps, or was damaged; plan it again, which keeps what is "
      "finished");
  }
  std::getline(file_, shared);
  try
  {
    const json head = json::parse(shared.substr(2));
    if (head.at("palp") != PALP_VERSION)
    {
      refusePlan(folder_,
        "was planned by palp " + head.at("palp").get<std::string>() +
          " and this is " PALP_VERSION "; go on with that one, or plan again with this one");
    }
    head_ = headOf(head);
  }
  catch (const std::exception& error) // of JSON, or a line too short
  {
    if (dynamic_cast<const Error*>(&error) != nullptr)
    {
      throw;
    }
    refusePlan(folder_, "line 2 is damaged; plan again, what is finished stays");
  }
  std::getline(file_, first); // the titles
  begin_ = file_.tellg();
  end_ = file_.seekg(0, std::ios::end).tellg();
}

bool Manifest::isOne(const std::filesystem::path& file)
{
  std::string first;
  std::getline(std::ifstream(file), first);
  return first.starts_with(kAnyFirst);
}

void Manifest::write(const std::filesystem::path& folder, const SweepHead& head,
  const std::function<PlannedCase(std::size_t)>& caseAt)
{
  const std::filesystem::path file = CaseFolders{ folder }.plan();
  replaceFile(file,
    [&](const std::filesystem::path& fresh)
    {
      std::ofstream out(fresh);
      out << kFirst << "\n# " << toJson(head).dump() << "\ncase,name";
      for (const SweepColumn& column : head.columns)
      {
        out << ',' << csvField(column.name);
      }
      for (std::size_t i = 0; i < head.count && out; ++i)
      {
        const PlannedCase one = caseAt(i);
        out << '\n' << i << ',' << one.name;
        for (const std::string& value : one.values)
        {
          out << ',' << csvField(value);
        }
      }
      out << '\n';
      if (!out.flush())
      {
        refuseFile(file, errno);
      }
    });
}

PlannedCase Manifest::parse(const std::string& line) const
{
  std::vector<std::string> fields = csvFields(line);
  if (fields.size() != head_.columns.size() + 2)
  {
    refusePlan(folder_,
      "the line of case " + fields[0] +
        " was edited after planning; plan again, what is finished stays");
  }
  PlannedCase one{ lineNumber(line), fields[1], {} };
  one.values.assign(fields.begin() + 2, fields.end());
  return one;
}

void Manifest::refuseEdited(const PlannedCase& one, const SweepValues& options) const
{
  if (caseName(head_.kind, options, head_.files) != one.name)
  {
    refusePlan(folder_,
      "case " + std::to_string(one.number) +
        " was edited after planning; change the SWEEP.json and plan again, which keeps what is "
        "finished");
  }
}

PlannedCase Manifest::at(std::size_t number)
{
  if (number >= head_.count)
  {
    throw Error(ErrorCode::BadValue,
      "there is no case " + std::to_string(number) + "; give 0 to " +
        std::to_string(head_.count - 1));
  }
  std::streamoff low = begin_; // begins a line at or before the case's
  std::streamoff high = end_;
  std::string line;
  while (high - low > 1)
  {
    const std::streamoff middle = low + (high - low) / 2;
    file_.clear();
    file_.seekg(middle - 1);
    std::getline(file_, line); // to the end of the line that the middle is in
    const std::streamoff start = file_.tellg();
    if (start < 0 || start >= high || !std::getline(file_, line) || lineNumber(line) > number)
    {
      high = middle;
    }
    else
    {
      low = start;
    }
  }
  file_.clear();
  file_.seekg(low);
  std::getline(file_, line);
  if (lineNumber(line) != number)
  {
    refusePlan(folder_,
      "is edited, case " + std::to_string(number) +
        " is missing; plan again, which keeps what is finished");
  }
  return parse(line);
}

std::vector<std::size_t> Manifest::numbers(std::size_t begin, std::size_t count) const
{
  std::vector<std::size_t> numbers(std::min(count, head_.count - begin));
  std::iota(numbers.begin(), numbers.end(), begin);
  return numbers;
}

void Manifest::forEach(const std::function<void(const PlannedCase&)>& take)
{
  file_.clear();
  file_.seekg(begin_);
  std::size_t expected = 0;
  for (std::string line; std::getline(file_, line); ++expected)
  {
    if (lineNumber(line) != expected)
    {
      break;
    }
    take(parse(line));
  }
  if (expected != head_.count || !file_.eof())
  {
    refusePlan(folder_,
      "is edited at case " + std::to_string(expected) +
        "; plan again, which keeps what is finished");
  }
}

} // namespace palp
