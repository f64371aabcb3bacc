#include "haptics/files/fixed_text.h"

#include <array>
#include <charconv>

namespace palp
{

std::string fixed(double value, int digits)
{
  std::array<char, 400> text{}; // the largest double has 309 digits before the point
  const auto [end, error] =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits);
  (void)error;
  const std::string shown(text.data(), end);
  return shown.find_first_not_of("-0.") == shown.npos && shown.starts_with('-') ? shown.substr(1)
                                                                                : shown;
}

} // namespace palp
