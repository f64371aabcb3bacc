#include "app/press/sample_text.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <array>
#include <charconv>
#include <cmath>

namespace palp
{
namespace
{

constexpr int kShift = 3; // decimal places from m to mm

double parsed(std::string_view text, std::string_view shown)
{
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
  {
    throw Error(ErrorCode::BadValue, inQuotes(shown) + " is not a number; write it as -1.25");
  }
  return value;
}

} // namespace

std::string exactMillimeters(double meters)
{
  if (meters == 0.0 || !std::isfinite(meters))
  {
    return shortest(meters);
  }
  // "d.ddde-02": the shortest digits, and where the point stands
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(
    text.data(), text.data() + text.size(), std::abs(meters), std::chars_format::scientific);
  (void)error; // 32 characters hold every double
  const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t exponentAt = all.find('e');
  std::string digits(all.substr(0, exponentAt));
  std::erase(digits, '.');
  int exponent = kShift;
  const bool isPositive = all[exponentAt + 1] == '+';
  int written = 0;
  std::from_chars(&all[exponentAt + 2], end, written);
  exponent += isPositive ? written : -written;
  if (exponent < 0)
  {
    digits.insert(0, "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0'));
  }
  else if (const auto whole = static_cast<std::size_t>(exponent) + 1; digits.size() > whole)
  {
    digits.insert(whole, ".");
  }
  else
  {
    digits.append(whole - digits.size(), '0');
  }
  return (meters < 0.0 ? "-" : "") + digits;
}

double fromExactMillimeters(std::string_view text)
{
  if (text.find_first_of("eEnN") != text.npos) // nan, inf
  {
    return units::fromMillimeters(parsed(text, text));
  }
  return parsed(std::string(text).append("e-").append(std::to_string(kShift)), text);
}

} // namespace palp
