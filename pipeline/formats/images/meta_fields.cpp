#include "pipeline/formats/images/meta_fields.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

namespace palp
{
MetaFields readMetaFields(const std::filesystem::path& file, std::uintmax_t& end)
{
  constexpr std::size_t most = 1 << 16; // [bytes], of a header
  std::string text(most, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), most);
  text.resize(static_cast<std::size_t>(in.gcount()));
  MetaFields fields;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t stop = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, stop - begin);
    const std::size_t equals = line.find_first_of("=:");
    if (stop == text.npos || equals == line.npos)
    {
      break;
    }
    const std::string key(trimmed(line.substr(0, equals)));
    if (!fields.try_emplace(key, trimmed(line.substr(equals + 1))).second)
    {
      refuse(file, "its header gives " + inQuotes(key) + " twice; leave the one that is right");
    }
    begin = stop + 1;
    if (key == "ElementDataFile")
    {
      end = begin;
      return fields;
    }
  }
  refuse(file,
    fields.contains("NDims") || fields.contains("ObjectType")
      ? "cut off, its header names no ElementDataFile; export or copy it again"
      : "not a MetaImage file, whatever its name; rename or convert it");
}

std::vector<double> numbersOf(
  const std::filesystem::path& file, const MetaFields& fields, const std::string& key)
{
  std::vector<double> values;
  const auto field = fields.find(key);
  std::istringstream words(field == fields.end() ? "" : field->second);
  for (std::string word; words >> word;)
  {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    {
      refuse(file, key + " is " + inQuotes(field->second) + ", not numbers; export it again");
    }
    values.push_back(value);
  }
  return values;
}

bool readThree(const std::filesystem::path& file, const MetaFields& fields,
  std::initializer_list<const char*> keys, std::array<double, 3>& values)
{
  for (const char* key : keys)
  {
    const std::vector<double> found = numbersOf(file, fields, key);
    if (!found.empty() && found.size() != 3)
    {
      refuse(file, std::string(key) + " has not three numbers; export it again");
    }
    if (!found.empty())
    {
      std::copy_n(found.begin(), 3, values.begin());
      return true;
    }
  }
  return false;
}

bool isTrue(const MetaFields& fields, const char* key)
{
  const auto field = fields.find(key);
  return field != fields.end() && (field->second.starts_with('T') || field->second == "1");
}

} // namespace palp
