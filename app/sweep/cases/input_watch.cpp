#include "app/sweep/cases/input_watch.h"

#include "app/input/mesh_file.h"
#include "haptics/error.h"

#include <algorithm>

namespace palp
{

InputWatch::InputWatch(const std::map<std::string, std::string>& hashes)
  : hashes_(hashes)
{
}

// with the one behind it
std::string InputWatch::shown(const std::string& file)
{
  std::string words;
  for (const std::filesystem::path& one : filesBehind(file))
  {
    words += (words.empty() ? "" : " or ") + one.string();
  }
  return words;
}

std::vector<std::string> InputWatch::edited(const std::map<std::string, std::string>& hashes)
{
  std::vector<std::string> files;
  for (const auto& [file, hash] : hashes)
  {
    const auto behind = filesBehind(file);
    const bool isThere = std::ranges::all_of(behind,
      [](const std::filesystem::path& one) { return std::filesystem::is_regular_file(one); });
    if (isThere && describeFile(file).sha256 != hash)
    {
      files.push_back(shown(file));
    }
  }
  return files;
}

void InputWatch::check(const std::string& file)
{
  const FileStamps now = stampsOf(file);
  if (const auto seen = seen_.find(file); seen != seen_.end() && seen->second == now)
  {
    return;
  }
  const auto planned = hashes_.find(file);
  if (planned == hashes_.end() || describeFile(file).sha256 != planned->second)
  {
    throw Error(ErrorCode::BadFile,
      shown(file) + ": was edited after planning; plan again, which keeps what is finished");
  }
  seen_[file] = now;
}

void InputWatch::refuseTouched(const std::vector<std::string>& files, std::size_t number) const
{
  for (const std::string& file : files)
  {
    if (stampsOf(file) != seen_.at(file))
    {
      throw Error(ErrorCode::BadFile,
        shown(file) + ": was edited while case " + std::to_string(number) +
          " was computed, which is thrown away; plan again, which keeps what is finished");
    }
  }
}

} // namespace palp
