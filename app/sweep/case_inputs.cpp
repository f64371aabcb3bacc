#include "app/sweep/case_inputs.h"

#include "app/program/sha256.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <algorithm>

namespace palp
{
namespace
{

constexpr std::size_t kNameDigits = 32; // 128 bits: no two of 10^7 cases in 10^24 sweeps
constexpr const char* kProfile = "profile:";
constexpr std::size_t kMostOpen = 32;     // values within values
constexpr std::size_t kLongest = 100'000; // [bytes], of what a command takes as one word

void refuseLong(const std::string& name, const std::string& text)
{
  if (text.size() > kLongest)
  {
    throw Error(ErrorCode::BadValue,
      inQuotes(name) + " is longer than " + std::to_string(kLongest) +
        " bytes; write less in one value");
  }
}

// fills in one text; `open` are the names on the way to it
std::string fill(const SweepValues& values, const std::string& text, std::vector<std::string>& open)
{
  std::string full;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t brace = std::min(text.find('{', at), text.size());
    full.append(text, at, brace - at);
    if (text.substr(brace, 2) == "{{")
    {
      full += '{';
      at = brace + 2;
      continue;
    }
    const std::size_t end = text.find('}', brace);
    if (brace == text.size() || end == text.npos)
    {
      return full.append(text, brace);
    }
    const std::string name = text.substr(brace + 1, end - brace - 1);
    const auto found = values.find(name);
    if (found == values.end())
    {
      throw Error(ErrorCode::BadValue,
        inQuotes("{" + name + "}") + " stands for no value; give one of that name");
    }
    if (std::ranges::find(open, name) != open.end())
    {
      throw Error(ErrorCode::BadValue,
        inQuotes(name) + " needs itself, a circle; give it a value without " +
          inQuotes("{" + open.back() + "}"));
    }
    open.push_back(name);
    if (open.size() > kMostOpen)
    {
      throw Error(ErrorCode::BadValue,
        inQuotes(open.front()) + " needs values within values more than " +
          std::to_string(kMostOpen) + " deep; write some of them out");
    }
    full += fill(values, found->second, open);
    refuseLong(open.front(), full);
    open.pop_back();
    at = end + 1;
  }
  return full;
}

} // namespace

SweepValues filledIn(const SweepValues& values)
{
  SweepValues full;
  std::vector<std::string> open;
  for (const auto& [name, text] : values)
  {
    open.assign(1, name);
    refuseLong(name, full.emplace_hint(full.end(), name, fill(values, text, open))->second);
  }
  return full;
}

std::vector<std::string> namesIn(const std::string& text)
{
  std::vector<std::string> names;
  for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1))
  {
    if (text.substr(at, 2) == "{{")
    {
      ++at;
      continue;
    }
    const std::size_t end = text.find('}', at);
    if (end != text.npos)
    {
      names.push_back(text.substr(at + 1, end - at - 1));
    }
  }
  return names;
}

std::string fileOf(const std::string& option, const std::string& value)
{
  if (option == "tip")
  {
    return value.starts_with(kProfile) ? value.substr(std::string(kProfile).size()) : "";
  }
  static const std::set<std::string> kFiles{ "history", "mesh", "path", "points", "table" };
  return kFiles.contains(option) ? value : "";
}

std::vector<std::string> filesOf(const SweepValues& options)
{
  std::vector<std::string> files;
  for (const auto& [option, value] : options)
  {
    if (std::string file = fileOf(option, value); !file.empty())
    {
      files.push_back(std::move(file));
    }
  }
  return files;
}

std::string besideFolder(
  const std::string& option, const std::string& value, const std::filesystem::path& folder)
{
  const std::string file = fileOf(option, value);
  return file.empty()
    ? value
    : value.substr(0, value.size() - file.size()) + (folder / file).lexically_normal().string();
}

std::string caseName(const std::string& kind, const SweepValues& options,
  const std::map<std::string, std::string>& files)
{
  std::string text = "palp " PALP_VERSION " " + kind + '\n';
  for (const auto& [option, value] : options)
  {
    const std::string file = fileOf(option, value);
    text.append(option).append("=");
    if (file.empty())
    {
      text.append(value);
    }
    else
    {
      text.append(value, 0, value.size() - file.size()).append("SHA-256 ").append(files.at(file));
    }
    text += '\n';
  }
  return sha256Of(text).substr(0, kNameDigits);
}

std::vector<std::string> caseWords(
  const std::string& kind, const SweepValues& options, const std::set<std::string>& flags)
{
  std::vector<std::string> words{ kind };
  for (const auto& [option, value] : options)
  {
    if (option == "mesh")
    {
      words.insert(words.begin() + 1, value); // an absolute path, so no option
    }
    else if (!flags.contains(option))
    {
      words.push_back(std::string("--").append(option).append("=").append(value));
    }
    else if (value == "true")
    {
      words.push_back("--" + option);
    }
  }
  return words;
}

} // namespace palp
