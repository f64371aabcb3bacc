#include "pipeline/surface_io/label_names.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/number_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

constexpr std::array<std::string_view, 5> kValueColumns{ "labelvalue", "index", "label", "value",
  "id" };

// of the names; as many as there are columns: none
std::size_t nameColumn(const std::vector<std::string>& columns)
{
  const auto isOfNames = [](const std::string& column)
  { return lowered(column).ends_with("name"); };
  return static_cast<std::size_t>(std::ranges::find_if(columns, isOfNames) - columns.begin());
}

// of a table whose first line names its columns, the first that of the values
bool hasColumns(const std::vector<std::string>& first)
{
  return !first.empty() && std::ranges::count(kValueColumns, lowered(first.front())) > 0 &&
    nameColumn(first) < first.size();
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what)
{
  throw Error(ErrorCode::BadFile, file.string() + ": " + what);
}

struct NamedColor
{
  LabelName label;
  std::string color; // empty: there is none
};

std::vector<NamedColor> namesInJson(const std::filesystem::path& file, const std::string& text)
{
  const nlohmann::json whole = nlohmann::json::parse(text, nullptr, false);
  const bool isDataset = whole.is_object() && whole.contains("labels"); // of nnU-Net
  const nlohmann::json& table = isDataset ? whole["labels"] : whole;
  if (!table.is_object())
  {
    refuse(file, R"(not JSON of values and names; write it as {"5": "liver"})");
  }
  std::vector<NamedColor> names;
  for (const auto& [key, entry] : table.items())
  {
    const std::optional<double> value = csvNumber(key);
    if (value && entry.is_string())
    {
      names.push_back({ { .value = *value, .name = entry.get<std::string>() }, {} });
    }
    else if (!value && entry.is_number())
    {
      names.push_back({ { .value = entry.get<double>(), .name = key }, {} });
    }
    else
    {
      refuse(file, inQuotes(key) + R"( is no value with a name; write it as "5": "liver")");
    }
  }
  return names;
}

// Red, green and blue of some numbers, which may go on.
// where: stands before the message
std::string colorOf(std::string_view numbers, const std::string& where)
{
  std::istringstream words{ std::string(numbers) };
  std::array<int, 3> parts{};
  for (int& part : parts)
  {
    constexpr int most = 255;
    std::string word;
    words >> word;
    const std::optional<double> value = csvNumber(word);
    if (!value || *value < 0.0 || *value > most || *value != std::floor(*value))
    {
      throw Error(ErrorCode::BadFile,
        where + "the color " + inQuotes(trimmed(numbers)) +
          " is not red, green and blue from 0 to 255; write them as whole numbers");
    }
    part = static_cast<int>(*value);
  }
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(parts[0]),
    static_cast<unsigned>(parts[1]), static_cast<unsigned>(parts[2]));
  return text.data();
}

// what stands before the color: three numbers, or four
std::string_view withoutColor(std::string_view text)
{
  std::string_view name = text;
  int numbers = 0;
  for (std::size_t gap = name.find_last_of(" \t");
       numbers < 4 && gap != name.npos && csvNumber(name.substr(gap + 1));
       gap = name.find_last_of(" \t"))
  {
    name = trimmed(name.substr(0, gap));
    ++numbers;
  }
  return numbers < 3 ? text : name;
}

bool areNumbers(std::string_view text)
{
  std::istringstream words{ std::string(text) };
  std::string word;
  bool all = true;
  while (all && words >> word)
  {
    all = csvNumber(word).has_value();
  }
  return all;
}

// of a color table or of ITK-SNAP; none: a line of neither
std::optional<NamedColor> labelIn(std::string_view line, const std::string& where)
{
  const std::size_t gap = std::min(line.find_first_of(" \t"), line.size());
  const std::optional<double> value = csvNumber(line.substr(0, gap));
  const std::string_view rest = trimmed(line.substr(gap));
  const std::size_t open = rest.find('"');
  const std::size_t close = rest.rfind('"');
  const bool isQuoted = open != rest.npos && close > open;
  const std::string_view name =
    isQuoted ? rest.substr(open + 1, close - open - 1) : withoutColor(rest);
  if (!value || areNumbers(name))
  {
    return std::nullopt;
  }
  const std::string_view color =
    trimmed(isQuoted ? rest.substr(0, open) : rest.substr(name.size()));
  return NamedColor{ { .value = *value, .name = std::string(name) },
    color.empty() ? std::string() : colorOf(color, where) };
}

// of the newer color tables of 3D Slicer, or a list of classes as of TotalSegmentator
std::vector<NamedColor> labelsInColumns(
  const std::filesystem::path& file, const std::vector<std::string_view>& lines)
{
  const std::vector<std::string> names = csvFields(trimmed(lines.front()));
  const auto column = [&](std::string_view name)
  { return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()); };
  const std::size_t name = nameColumn(names);
  std::vector<NamedColor> labels;
  for (std::size_t i = 1; i < lines.size(); ++i)
  {
    const std::vector<std::string> fields = csvFields(trimmed(lines[i]));
    const auto fieldOf = [&](std::size_t k) { return k < fields.size() ? fields[k] : ""; };
    if (trimmed(lines[i]).empty() || fieldOf(name).empty())
    {
      continue;
    }
    const std::optional<double> number = csvNumber(fieldOf(0));
    if (!number)
    {
      throw Error(ErrorCode::BadFile,
        where(file, static_cast<int>(i) + 1) + inQuotes(fieldOf(0)) +
          " is no value of a label; write a number below " + names.front());
    }
    const std::string color = fieldOf(column("Color_R")) + ' ' + fieldOf(column("Color_G")) + ' ' +
      fieldOf(column("Color_B"));
    labels.push_back({ { .value = *number, .name = fieldOf(name) },
      trimmed(color).empty() ? std::string()
                             : colorOf(color, where(file, static_cast<int>(i) + 1)) });
  }
  return labels;
}

// of a table in lines
std::vector<NamedColor> labelsIn(const std::filesystem::path& file, const std::string& text)
{
  const std::vector<std::string_view> lines = split(text, '\n');
  if (hasColumns(csvFields(trimmed(lines.front()))))
  {
    return labelsInColumns(file, lines);
  }
  std::vector<NamedColor> labels;
  int number = 0;
  for (const std::string_view row : lines)
  {
    ++number;
    const std::string_view line = trimmed(row);
    if (line.empty() || line.starts_with('#'))
    {
      continue;
    }
    const std::optional<NamedColor> label = labelIn(line, where(file, number));
    if (!label)
    {
      throw Error(ErrorCode::BadFile,
        where(file, number) + inQuotes(line) +
          " is no label; write a value and its name, like 5 liver 221 130 101 255");
    }
    labels.push_back(*label);
  }
  return labels;
}

// older programs wrote Latin-1
std::string inUtf8(const std::string& text)
{
  try
  {
    (void)nlohmann::json(text).dump(); // which asks whether it is
    return text;
  }
  catch (const nlohmann::json::type_error&)
  {
    std::string result;
    for (const char c : text)
    {
      const auto code = static_cast<unsigned char>(c);
      code < 0x80 ? void() : result.push_back(static_cast<char>(0xc0 | code >> 6));
      result.push_back(code < 0x80 ? c : static_cast<char>(0x80 | (code & 0x3f)));
    }
    return result;
  }
}

// of two names for one value either would be wrong
void checkOnce(const std::filesystem::path& file, const std::vector<LabelName>& names)
{
  std::map<double, std::string> known;
  for (const LabelName& one : names)
  {
    if (const auto [before, isNew] = known.emplace(one.value, one.name);
        !isNew && before->second != one.name)
    {
      refuse(file,
        "its value " + shortest(one.value) + " is both " + inQuotes(before->second) + " and " +
          inQuotes(one.name) + "; leave one of them out");
    }
  }
}

std::vector<NamedColor> tableIn(const std::filesystem::path& file)
{
  const std::string text = inUtf8(readText(file, "the table of names"));
  const auto isOdd = [](unsigned char c)
  { return c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f'; };
  if (std::ranges::any_of(text, isOdd))
  {
    refuse(file, "no text; give a table of 3D Slicer, ITK-SNAP, or JSON");
  }
  return trimmed(text).starts_with('{') ? namesInJson(file, text) : labelsIn(file, text);
}

} // namespace

std::vector<LabelName> readLabelNames(const std::filesystem::path& file)
{
  std::vector<LabelName> names;
  std::size_t length = 0;
  for (NamedColor& one : tableIn(file))
  {
    length += one.label.name.size();
    names.push_back(std::move(one.label));
  }
  if (constexpr std::size_t kMost = 500'000; length > kMost) // another process gets them as words
  {
    refuse(file, "it has " + counted(names.size(), "name") + "; leave out those of other images");
  }
  if (names.empty())
  {
    refuse(file, "it names no label; write a value and its name, like 5 liver 221 130 101 255");
  }
  checkOnce(file, names);
  return names;
}

std::map<double, std::string> readLabelColors(const std::filesystem::path& file)
{
  std::map<double, std::string> colors;
  for (const NamedColor& one : tableIn(file))
  {
    one.color.empty() ? void() : void(colors.emplace(one.label.value, one.color));
  }
  return colors;
}

std::vector<std::string> valuesOfLabels(
  std::vector<std::string> labels, std::span<const LabelName> names)
{
  for (std::string& label : labels)
  {
    const auto isExact = [&](const LabelName& one) { return one.name == label; };
    const bool isOne = std::ranges::count_if(names, isExact) == 1; // whatever the case of others
    const auto isOf = [&](const LabelName& one)
    { return isOne ? isExact(one) : lowered(one.name) == lowered(label); };
    const auto count = csvNumber(label) ? 0 : std::ranges::count_if(names, isOf);
    if (count > 1)
    {
      throw Error(ErrorCode::BadValue,
        "--label: " + inQuotes(label) +
          " is the name of several values in --names; give the value");
    }
    label = count == 1 ? shortest(std::ranges::find_if(names, isOf)->value) : label;
  }
  return labels;
}

} // namespace palp
