#include "pipeline/formats/images/nrrd_fields.h"

#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

namespace palp
{

namespace
{

// where a header says that its voxels are; of one without them beside it
std::filesystem::path dataOf(const std::filesystem::path& file, const NrrdFields& fields)
{
  const std::string name = fieldOf(fields, "data file") + fieldOf(fields, "datafile");
  if (!isNrrdHeader(file))
  {
    if (!name.empty())
    {
      refuse(
        file, "its voxels are in another file; name its header .nhdr, or save it as one .nrrd");
    }
    return file;
  }
  const std::filesystem::path beside = name;
  if (name.empty() || name.starts_with("LIST") || name.find('%') != name.npos)
  {
    refuse(file, "it names no file of its voxels, or several; save it as one .nrrd");
  }
  if (beside.has_parent_path())
  {
    refuse(file, "its data are not beside it; put both into one folder");
  }
  std::filesystem::path data = file.parent_path() / beside;
  if (std::error_code none; !std::filesystem::is_regular_file(data, none))
  {
    refuse(file, "its data, " + inQuotes(name) + ", are not beside it; copy both");
  }
  return data;
}

// of a key's value, in which lines and backslashes are told by a backslash
std::string unescaped(std::string_view text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isEscape =
      text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\');
    i += isEscape ? 1 : 0;
    result += isEscape && text[i] == 'n' ? '\n' : text[i];
  }
  return result;
}

} // namespace

bool isNrrdHeader(const std::filesystem::path& file)
{
  return lowered(file.extension().string()) == ".nhdr";
}

NrrdHeader readNrrdHeader(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  NrrdHeader header;
  std::string line;
  constexpr std::size_t most = 1 << 20;
  for (std::getline(in, line); std::getline(in, line) && !line.empty() && line != "\r";)
  {
    if (line.size() > most || header.fields.size() > most)
    {
      refuse(file, "no header of an NRRD; export it again");
    }
    line.erase(std::min(line.find('\r'), line.size()));
    const std::size_t colon = line.find(':');
    if (line.starts_with('#') || colon == line.npos)
    {
      continue;
    }
    std::size_t value = line.find_first_not_of(" =", colon + 1);
    value = std::min(value, line.size());
    const bool isKey = colon + 1 < line.size() && line[colon + 1] == '=';
    std::string rest = isKey ? unescaped(line.substr(value)) : line.substr(value);
    if (!header.fields.emplace(line.substr(0, colon), std::move(rest)).second)
    {
      refuse(file, "its header has " + inQuotes(line.substr(0, colon)) + " twice; export it again");
    }
  }
  const bool isAlone = isNrrdHeader(file); // and may end as a file does
  if (!in && !isAlone)
  {
    refuse(file, "cut off in its header; export or copy it again");
  }
  header.begin = isAlone ? 0 : static_cast<std::uintmax_t>(in.tellg());
  header.data = dataOf(file, header.fields);
  return header;
}

std::string fieldOf(const NrrdFields& fields, const std::string& name)
{
  const auto found = fields.find(name);
  return found == fields.end() ? "" : found->second;
}

double numberOf(const std::string& text, double otherwise)
{
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc() && end == text.data() + text.size() ? number : otherwise;
}

std::vector<double> numbersIn(std::string text)
{
  std::ranges::replace_if(
    text, [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;)
  {
    numbers.push_back(numberOf(word, std::numeric_limits<double>::quiet_NaN()));
  }
  return numbers;
}

} // namespace palp
