#include "haptics/files/csv_text.h"

#include "haptics/files/input_text.h"

#include <array>
#include <charconv>
#include <ostream>

namespace palp
{

std::string shortest(double value)
{
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  (void)error; // 32 characters hold every double
  return { text.data(), end };
}

void writeCsvRow(std::ostream& out, std::span<const double> values)
{
  const char* separator = "";
  for (const double value : values)
  {
    out << separator << shortest(value);
    separator = ",";
  }
  out << '\n';
}

std::string csvField(const std::string& text)
{
  if (text.find_first_of(",\"\n") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + '"';
}

std::vector<std::string> csvFields(std::string_view line)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
    {
      fields.back() += line[i++];
    }
    else if (c == '"' && (quoted || trimmed(fields.back()).empty())) // else it stands for itself
    {
      quoted = !quoted;
    }
    else if (c == ',' && !quoted)
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  return fields;
}

std::optional<double> csvNumber(std::string_view cell) noexcept
{
  std::string_view digits = trimmed(cell);
  digits.remove_prefix(digits.starts_with('+') && !digits.starts_with("+-") ? 1 : 0);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool isWhole = error == std::errc{} && stop == digits.data() + digits.size();
  return isWhole ? std::optional(value) : std::nullopt;
}

} // namespace palp
