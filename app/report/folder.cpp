#include "app/report/folder.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace palp::report
{
namespace
{

using Json = nlohmann::ordered_json;

Json read(const std::filesystem::path& file)
{
  Json json = Json::parse(readText(file, "a report's part"), nullptr, false);
  if (!json.is_object())
  {
    throw Error(
      ErrorCode::BadFile, file.string() + ": damaged; delete it to have that part done again");
  }
  return json;
}

// whatever a file holds, for a message
std::string word(const Json& json, const char* key)
{
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "unknown";
}

std::optional<Section> sectionIn(const Json& json)
{
  try
  {
    return json.is_object() ? std::optional(sectionOf(json)) : std::nullopt;
  }
  catch (const Json::exception&)
  {
    return std::nullopt;
  }
}

// what figures must have in common to stand on one page
bool isSame(const Json& a, const Json& b)
{
  const auto same = [&](const char* key)
  { return a.contains(key) && b.contains(key) && a.at(key) == b.at(key); };
  return same("effort") && same("version") && same("processor") && same("compiler");
}

constexpr const char* kMachine = "machine.json";

// all files of the report in a folder
std::vector<std::string> filesIn(const std::filesystem::path& folder)
{
  std::vector<std::string> names{ kMachine, "report.html" };
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
  {
    std::ifstream in(entry.path());
    const bool json = entry.path().extension() == ".json" && entry.path().filename() != kMachine;
    const auto section = json ? sectionIn(Json::parse(in, nullptr, false)) : std::nullopt;
    if (section)
    {
      names.push_back(entry.path().filename().string());
      std::ranges::transform(section->tables, std::back_inserter(names),
        [](const Table& table) { return table.name + ".csv"; });
      std::ranges::transform(section->figures, std::back_inserter(names),
        [](const Figure& figure) { return figure.name + ".svg"; });
      std::ranges::transform(section->pictures, std::back_inserter(names), &Picture::name);
    }
  }
  return names;
}

// A report's files have the names of those that other commands write, so it has a folder of its
// own; what a user puts beside a report stays.
const std::filesystem::path& requireOwn(const std::filesystem::path& folder)
{
  std::error_code missing;
  if (std::filesystem::exists(folder / kMachine, missing))
  {
    return folder;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
  {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("."))
    {
      throw Error(ErrorCode::BadFile,
        folder.string() + ": holds " + printable(name) +
          ", which is of no report; choose another --out, for a report has a folder of its own");
    }
  }
  return folder;
}

} // namespace

Folder::Folder(const std::filesystem::path& path, bool quick, const Json& machine, Before before)
  : before_(before)
  , output_(requireOwn(path),
      before == Before::Replace ? filesIn(path) : std::vector<std::string>{},
      before == Before::Replace ? OutputFolder::Earlier::Replace : OutputFolder::Earlier::Keep)
  , machine_(machine)
{
  machine_["effort"] = quick ? "quick" : "full";
  const auto file = output_.path() / kMachine;
  if (before == Before::Replace || !std::filesystem::exists(file))
  {
    replaceFile(output_.stage() / kMachine, machine_.dump(1) + '\n'); // appears with the first part
    return;
  }
  if (before == Before::Refuse)
  {
    throw Error(ErrorCode::BadFile,
      path.string() +
        ": holds a report already; choose another --out, or pass --resume to go on with it or "
        "--overwrite to replace it");
  }
  Json earlier = read(file);
  if (!isSame(earlier, machine_))
  {
    throw Error(ErrorCode::BadFile,
      path.string() + ": holds a report of other settings (" + word(earlier, "effort") + ", " +
        word(earlier, "version") + ", " + word(earlier, "processor") + "); choose another --out");
  }
  machine_ = std::move(earlier);
}

std::optional<Section> Folder::finished(const std::string& part) const
{
  const auto file = output_.path() / (part + ".json");
  if (before_ == Before::Replace || !std::filesystem::exists(file))
  {
    return std::nullopt;
  }
  std::optional<Section> section = sectionIn(read(file));
  if (!section)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not a part of a report; delete it to have that part done again");
  }
  return section;
}

void Folder::keep(const Section& section)
{
  const std::filesystem::path stage = output_.stage();
  for (const Table& table : section.tables)
  {
    replaceFile(stage / (table.name + ".csv"), csv(table));
  }
  for (const Picture& picture : section.pictures)
  {
    replaceFile(stage / picture.name, picture.svg);
  }
  const std::string name = section.name + ".json";
  const std::string json = toJson(section).dump(1) + '\n';
  if (before_ != Before::Resume) // of this report there is nothing yet: all in one step
  {
    replaceFile(stage / name, json);
  }
  output_.publish();
  // last, for its presence says that the part is finished
  replaceFile(output_.path() / name, json);
  before_ = Before::Resume;
}

} // namespace palp::report
