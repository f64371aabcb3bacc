#include "calibration/csv_text.h"

#include <array>
#include <charconv>
#include <fstream>
#include <ostream>
#include <system_error>

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

bool replaceFile(const std::filesystem::path& file, const std::string& content)
{
  auto fresh = file;
  fresh += ".new";
  std::ofstream out(fresh, std::ios::binary);
  if (!out)
  {
    return false; // whatever is there is not ours to remove
  }
  out << content;
  out.close();
  std::error_code failed;
  if (out)
  {
    std::filesystem::rename(fresh, file, failed);
  }
  const bool replaced = out && !failed;
  if (!replaced)
  {
    std::filesystem::remove(fresh, failed);
  }
  return replaced;
}

} // namespace palp
