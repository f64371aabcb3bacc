#include "pipeline/surface_io/label_names.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/number_table.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + what);
}

std::vector<LabelName> namesInJson(const std::filesystem::path& file, const std::string& text)
{
  const nlohmann::json table = nlohmann::json::parse(text, nullptr, false);
  if (!table.is_object())
  {
    refuse(file, R"(not JSON of values and names; write it as {"5": "liver"})");
  }
  std::vector<LabelName> names;
  for (const auto& [key, entry] : table.items())
  {
    const std::optional<double> value = csvNumber(key);
    if (value && entry.is_string())
    {
      names.push_back({ .value = *value, .name = entry.get<std::string>() });
    }
    else if (!value && entry.is_number())
    {
      names.push_back({ .value = entry.get<double>(), .name = key });
    }
    else
    {
      refuse(file, inQuotes(key) + R"( is no value with a name; write it as "5": "liver")");
    }
  }
  return names;
}

// what stands before the color
std::string_view withoutNumbers(std::string_view text)
{
  text = trimmed(text);
  for (std::size_t gap = text.find_last_of(" \t");
       gap != text.npos && csvNumber(text.substr(gap + 1)); gap = text.find_last_of(" \t"))
  {
    text = trimmed(text.substr(0, gap));
  }
  return text;
}

// of a color table or of ITK-SNAP; none: a line of neither
std::optional<LabelName> nameIn(std::string_view line)
{
  const std::size_t gap = std::min(line.find_first_of(" \t"), line.size());
  const std::optional<double> value = csvNumber(line.substr(0, gap));
  const std::string_view rest = trimmed(line.substr(gap));
  const std::size_t open = rest.find('"');
  const std::size_t close = rest.rfind('"');
  const std::string_view name = open != rest.npos && close > open
    ? rest.substr(open + 1, close - open - 1)
    : withoutNumbers(rest);
  return value && !name.empty() && !csvNumber(name)
    ? std::optional(LabelName{ .value = *value, .name = std::string(name) })
    : std::nullopt;
}

} // namespace

std::vector<LabelName> readLabelNames(const std::filesystem::path& file)
{
  const std::string text = readText(file, "the table of names");
  if (trimmed(text).starts_with('{'))
  {
    return namesInJson(file, text);
  }
  std::vector<LabelName> names;
  int number = 0;
  for (const std::string_view row : split(text, '\n'))
  {
    ++number;
    const std::string_view line = trimmed(row);
    if (line.empty() || line.starts_with('#'))
    {
      continue;
    }
    const std::optional<LabelName> name = nameIn(line);
    if (!name)
    {
      throw Error(ErrorCode::BadFile,
        where(file, number) + inQuotes(line) +
          " is no label; write a value and its name, like 5 liver 221 130 101 255");
    }
    names.push_back(*name);
  }
  return names;
}

std::vector<std::string> valuesOfLabels(
  std::vector<std::string> labels, std::span<const LabelName> names)
{
  for (std::string& label : labels)
  {
    const auto isOf = [&](const LabelName& one) { return lowered(one.name) == lowered(label); };
    const auto named = std::ranges::find_if(names, isOf);
    if (named == names.end() || csvNumber(label))
    {
      continue;
    }
    if (std::ranges::count_if(names, isOf) > 1)
    {
      throw Error(ErrorCode::BadValue,
        "--label: " + inQuotes(label) +
          " is the name of several values in --names; give the value");
    }
    label = shortest(named->value);
  }
  return labels;
}

} // namespace palp
