#include "app/report/folder.h"

#include "calibration/replace_file.h"
#include "haptics/error.h"

#include <fstream>

namespace palp::report
{
namespace
{

using Json = nlohmann::ordered_json;

Json read(const std::filesystem::path& file)
{
  std::ifstream in(file);
  Json json = Json::parse(in, nullptr, false);
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

// what figures must have in common to stand on one page
bool isSame(const Json& a, const Json& b)
{
  const auto same = [&](const char* key)
  { return a.contains(key) && b.contains(key) && a.at(key) == b.at(key); };
  return same("effort") && same("version") && same("processor") && same("compiler");
}

} // namespace

Folder::Folder(std::filesystem::path path, bool quick, const Json& machine, bool resume)
  : path_(std::move(path))
  , machine_(machine)
{
  machine_["effort"] = quick ? "quick" : "full";
  std::error_code failed; // writing says what is wrong
  std::filesystem::create_directories(path_, failed);
  const auto file = path_ / "machine.json";
  if (!std::filesystem::exists(file))
  {
    replaceFile(file, machine_.dump(1) + '\n');
    return;
  }
  if (!resume)
  {
    throw Error(ErrorCode::BadFile,
      path_.string() +
        ": holds a report already; choose another --out, or pass --resume to go on with it");
  }
  Json before = read(file);
  if (!isSame(before, machine_))
  {
    throw Error(ErrorCode::BadFile,
      path_.string() + ": holds a report of other settings (" + word(before, "effort") + ", " +
        word(before, "version") + ", " + word(before, "processor") + "); choose another --out");
  }
  machine_ = std::move(before);
}

std::optional<Section> Folder::finished(const std::string& part) const
{
  const auto file = path_ / (part + ".json");
  if (!std::filesystem::exists(file))
  {
    return std::nullopt;
  }
  try
  {
    return sectionOf(read(file));
  }
  catch (const Json::exception&)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not a part of a report; delete it to have that part done again");
  }
}

void Folder::keep(const Section& section) const
{
  for (const Table& table : section.tables)
  {
    replaceFile(path_ / (table.name + ".csv"), csv(table));
  }
  for (const Picture& picture : section.pictures)
  {
    replaceFile(path_ / picture.name, picture.svg);
  }
  // last, for its presence says that the part is finished
  replaceFile(path_ / (section.name + ".json"), toJson(section).dump(1) + '\n');
}

} // namespace palp::report
