#include "haptics/files/csv_text.h"

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

} // namespace palp
