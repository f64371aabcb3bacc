#include "app/sweep/case_numbers.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <charconv>

namespace palp
{

std::vector<std::size_t> shardOf(const std::string& text, std::size_t count)
{
  std::size_t part = 0;
  std::size_t parts = 0;
  const char* end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, part);
  const bool apart = first == std::errc{} && slash != end && *slash == '/';
  const auto last = apart ? std::from_chars(slash + 1, end, parts) : std::from_chars_result{};
  if (!apart || last.ec != std::errc{} || last.ptr != end || part < 1 || part > parts)
  {
    throw Error(ErrorCode::BadValue,
      "--shard: " + inQuotes(text) + " is no part of a whole; give 1/4 to 4/4 for four of them");
  }
  std::vector<std::size_t> numbers;
  for (std::size_t i = part - 1; i < count; i += parts)
  {
    numbers.push_back(i);
  }
  return numbers;
}

std::size_t numberBelow(
  const std::string& text, std::size_t count, const std::string& what, const std::string& thing)
{
  const char* end = text.data() + text.size();
  std::size_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || rest != end || number >= count)
  {
    throw Error(ErrorCode::BadValue,
      what + ": there is no " + thing + " " + inQuotes(text) + "; give 0 to " +
        std::to_string(count - 1));
  }
  return number;
}

} // namespace palp
