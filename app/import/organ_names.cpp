#include "app/import/organ_names.h"

#include "app/import/organ_level.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <cctype>
#include <functional>

namespace palp
{
namespace
{

// with a number behind it where it is taken
std::string numbered(
  const std::string& first, const std::function<bool(const std::string&)>& isTaken)
{
  std::string name = first;
  for (int number = 2; isTaken(name); ++number)
  {
    name = first + "_" + std::to_string(number);
  }
  return name;
}

// whole letters of UTF-8
std::string shortened(const std::string& text, std::size_t bytes)
{
  std::size_t length = std::min(bytes, text.size());
  while (length > 0 && length < text.size() && (text[length] & 0xC0) == 0x80)
  {
    --length;
  }
  return text.substr(0, length);
}

} // namespace

void nameFiles(
  std::vector<FileOrgan>& organs, std::vector<std::string>& files, const std::string& other)
{
  const auto isOdd = [](unsigned char c) { return c < ' ' || c == ',' || c == '"'; };
  const auto isPlain = [](unsigned char c) // or of a letter beyond ASCII
  { return c >= 0x80 || std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_'; };
  for (FileOrgan& organ : organs)
  {
    constexpr std::size_t kLongest = 60; // bytes
    organ.name = !organ.name.empty() ? shortened(organ.name, kLongest)
      : organ.label.empty()          ? other
                                     : "label " + organ.label;
    std::ranges::replace_if(organ.name, isOdd, '_');
    const auto isNamed = [&](const std::string& name)
    {
      return std::ranges::any_of(
        organs.data(), &organ, [&](const FileOrgan& earlier) { return earlier.name == name; });
    };
    std::string first = lowered(organ.name);
    organ.name = numbered(organ.name, isNamed); // in the scene each is named once
    std::ranges::replace_if(first, std::not_fn(isPlain), '_');
    first.insert(0, first.starts_with('.') ? "_" : "");
    const auto isTaken = [&](const std::string& file)
    {
      return std::ranges::any_of(files,
        [&](const std::string& earlier) // their coarser levels are files of their own
        { return earlier == file || earlier + kHaptic == file || file + kHaptic == earlier; });
    };
    files.push_back(numbered(first, isTaken));
  }
}

} // namespace palp
