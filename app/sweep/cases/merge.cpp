#include "app/sweep/cases/merge.h"

#include "app/program/sha256.h"
#include "app/sweep/case_folders.h"
#include "app/sweep/cases/result_rows.h"
#include "app/sweep/cases/table_writer.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <algorithm>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

// thrown away and begun again: a case has a column that none before it had, or words in one
struct BeginAgain
{
};

// a pass over all results
class Merger
{
public:
  Merger(Manifest& manifest, const MergeOptions& options)
    : manifest_(manifest)
    , options_(options)
  {
    folders_.push_back({ manifest.folder() });
    for (const fs::path& other : options.others)
    {
      folders_.push_back({ other });
    }
    for (const SweepColumn& column : manifest.head().columns)
    {
      columns_.push_back({ column.title(), column.isNumber });
    }
  }

  [[nodiscard]] const std::vector<WrittenColumn>& columns() const
  {
    return columns_;
  }

  template <typename Begin, typename Add>
  Merged pass(Begin begin, Add add)
  {
    for (;;)
    {
      try
      {
        begin();
        return passOnce(add);
      }
      catch (const BeginAgain&)
      {
      }
    }
  }

private:
  template <typename Add>
  Merged passOnce(Add add)
  {
    Merged merged;
    missing_ = 0;
    manifest_.forEach(
      [&](const PlannedCase& one)
      {
        const fs::path folder = find(one.name);
        if (folder.empty())
        {
          first_ = missing_++ == 0 ? one : first_;
        }
        if (folder.empty() || (missing_ > 0 && !options_.partial)) // only counts them
        {
          return;
        }
        manifest_.refuseEdited(one, optionsOf(manifest_.head(), one.values));
        const ResultRows result = readResult(folder, manifest_.head().kind, options_.largest);
        const std::vector<std::size_t> places = placesOf(result.titles);
        std::vector<std::string> cells(columns_.size());
        fillVaried(one, cells);
        for (const auto& row : result.rows)
        {
          for (std::size_t i = 0; i < row.size(); ++i)
          {
            cells[places[i]] = row[i];
          }
          if (!add(one, cells))
          {
            demote(result.rows);
          }
          ++merged.rows;
        }
        ++merged.cases;
      });
    refuseMissing();
    return merged;
  }

  [[nodiscard]] fs::path find(const std::string& name) const
  {
    const auto found = std::ranges::find_if(
      folders_, [&](const CaseFolders& folders) { return folders.isDone(name); });
    return found == folders_.end() ? fs::path() : found->result(name);
  }

  // where the columns of a result stand
  std::vector<std::size_t> placesOf(const std::vector<std::string>& titles)
  {
    if (titles == titles_)
    {
      return places_;
    }
    const std::size_t before = columns_.size();
    const std::size_t varied = manifest_.head().columns.size();
    places_.clear();
    for (const std::string& given : titles)
    {
      std::string title = given;
      while (isVaried(title))
      {
        title.insert(0, "result_");
      }
      auto found = std::find_if(columns_.begin() + static_cast<std::ptrdiff_t>(varied),
        columns_.end(), [&](const WrittenColumn& column) { return column.title == title; });
      if (found == columns_.end())
      {
        columns_.push_back({ title, true });
        found = columns_.end() - 1;
      }
      places_.push_back(static_cast<std::size_t>(found - columns_.begin()));
    }
    titles_ = titles;
    if (columns_.size() > before)
    {
      throw BeginAgain();
    }
    return places_;
  }

  // a case's own column may have the title of one that is varied
  [[nodiscard]] bool isVaried(const std::string& title) const
  {
    const auto& varied = manifest_.head().columns;
    return std::ranges::any_of(
      varied, [&](const SweepColumn& column) { return column.title() == title; });
  }

  // columns that hold words after all
  void demote(const std::vector<std::vector<std::string>>& rows)
  {
    for (const auto& row : rows)
    {
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        WrittenColumn& column = columns_[places_[i]];
        column.isNumber = column.isNumber && numberOf(row[i]);
      }
    }
    throw BeginAgain();
  }

  void fillVaried(const PlannedCase& one, std::vector<std::string>& cells) const
  {
    const auto& varied = manifest_.head().columns;
    for (std::size_t i = 0; i < varied.size(); ++i)
    {
      cells[i] = varied[i].cell(one.values[i]);
    }
  }

  void refuseMissing() const
  {
    const bool none = missing_ == manifest_.head().count;
    if (missing_ == 0 || (options_.partial && !none))
    {
      return;
    }
    const fs::path failure = folders_.front().failure(first_.name);
    throw Error(ErrorCode::NoSolution,
      manifest_.folder().string() + ": " + std::to_string(missing_) + " of " +
        counted(manifest_.head().count, "case") + " without a result, the first is case " +
        std::to_string(first_.number) +
        (fs::exists(failure) ? ", which failed (" + (failure / kLogFile).string() + ")" : "") +
        "; palp sweep run them" + (none ? "" : ", or merge the others with --partial"));
  }

  Manifest& manifest_;
  const MergeOptions& options_;
  std::vector<CaseFolders> folders_;
  std::vector<WrittenColumn> columns_;
  std::vector<std::string> titles_; // of the result before, mostly those of all
  std::vector<std::size_t> places_;
  std::size_t missing_ = 0; // cases
  PlannedCase first_{};     // of these
};

} // namespace

namespace
{

std::string hashOfNames(Manifest& manifest)
{
  Sha256 hash;
  manifest.forEach([&](const PlannedCase& one) { hash.add(one.name); });
  return hash.hex();
}

// results of other cases would be left out in silence
void refuseOthers(Manifest& manifest, const MergeOptions& options)
{
  const SweepHead& head = manifest.head();
  for (const fs::path& other : options.others)
  {
    Manifest others(other);
    const SweepHead& its = others.head();
    const auto same = [](const SweepColumn& a, const SweepColumn& b) { return a.name == b.name; };
    if (its.kind != head.kind || its.fixed != head.fixed ||
      !std::ranges::equal(its.columns, head.columns, same))
    {
      throw Error(ErrorCode::BadValue,
        other.string() + ": is of another sweep, " + inQuotes(its.title) +
          "; merge folders in which the same one was planned");
    }
    if (its.count != head.count || hashOfNames(others) != hashOfNames(manifest))
    {
      throw Error(ErrorCode::BadValue,
        other.string() + ": plans other cases, " + std::to_string(its.count) + " beside " +
          std::to_string(head.count) +
          "; plan the same sweep in both folders, which keeps what is finished");
    }
  }
}

void refuseOwn(const Manifest& manifest, const MergeOptions& options, const fs::path& out)
{
  bool owned = CaseFolders{ manifest.folder() }.owns(out);
  for (const fs::path& other : options.others)
  {
    owned = owned || CaseFolders{ other }.owns(out);
  }
  for (const auto& [input, hash] : manifest.head().files)
  {
    std::error_code none;
    owned = owned || fs::equivalent(input, out, none);
  }
  if (owned)
  {
    throw Error(ErrorCode::BadValue,
      out.string() + ": is a part of the sweep, which would be lost; choose another --out");
  }
}

} // namespace

Merged mergeResults(Manifest& manifest, const MergeOptions& options, const fs::path& out)
{
  refuseOthers(manifest, options);
  refuseOwn(manifest, options, out);
  if (out.extension() != ".csv" && out.extension() != ".vtt")
  {
    throw Error(ErrorCode::BadValue,
      "--out: " + inQuotes(out.filename().string()) +
        " is neither a table of numbers nor one of VTK; give a file that ends in .csv or .vtt");
  }
  if (fs::exists(out) && !options.overwrite)
  {
    throw Error(ErrorCode::BadValue,
      out.string() + ": is there already; pass --overwrite to replace it, or choose another --out");
  }
  Merger merger(manifest, options);
  Merged merged;
  replaceFile(out,
    [&](const fs::path& fresh)
    {
      std::unique_ptr<TableWriter> writer;
      merged = merger.pass(
        [&]
        {
          writer.reset();
          writer =
            (out.extension() == ".csv" ? makeCsvWriter : makeVtkWriter)(fresh, merger.columns());
        },
        [&](const PlannedCase&, const std::vector<std::string>& cells)
        { return writer->add(cells); });
      writer->finish();
    });
  return merged;
}

std::vector<std::vector<std::string>> readResults(Manifest& manifest, const MergeOptions& options)
{
  Merger merger(manifest, options);
  std::vector<std::vector<std::string>> rows;
  merger.pass([&] { rows.assign(1, {}); },
    [&](const PlannedCase& one, const std::vector<std::string>& cells)
    {
      rows.emplace_back(1, std::to_string(one.number));
      rows.back().insert(rows.back().end(), cells.begin(), cells.end());
      return true;
    });
  rows.front().emplace_back(kCaseColumn);
  for (const WrittenColumn& column : merger.columns())
  {
    rows.front().push_back(column.title);
  }
  return rows;
}

} // namespace palp
