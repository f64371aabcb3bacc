#include "app/sweep/sweep_range.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace palp
{
namespace
{

constexpr int kDigits = 12; // hide what steps of a tenth leave behind

std::string rounded(double value)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(
    text.data(), text.data() + text.size(), value, std::chars_format::general, kDigits);
  return { text.data(), end.ptr };
}

bool isUnit(std::string_view text)
{
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ*/%") ==
    text.npos;
}

} // namespace

std::optional<NumberText> numberText(std::string_view text)
{
  const bool begins = text.find_first_of("0123456789") <= text.find_first_not_of("+-.");
  double number = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  unit.remove_prefix(std::min(unit.size(), unit.find_first_not_of(' ')));
  if (!begins || error != std::errc{} || !std::isfinite(number) || !isUnit(unit))
  {
    return std::nullopt;
  }
  return NumberText{ number, std::string(unit) };
}

std::string SweepRange::at(double fraction) const
{
  const double value =
    logarithmic ? from * std::pow(to / from, fraction) : from + (to - from) * fraction;
  return rounded(value) + unit;
}

std::vector<std::string> evenly(const SweepRange& range, std::size_t count)
{
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i)
  {
    values.push_back(
      range.at(count == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  return values;
}

std::vector<std::vector<std::string>> latinHypercube(
  const std::vector<SweepRange>& ranges, std::size_t count, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t most) // the library's distributions differ between systems
  { return static_cast<std::size_t>(random() % most); };
  std::vector<std::vector<std::string>> rows(count);
  std::vector<std::size_t> parts(count);
  for (const SweepRange& range : ranges)
  {
    std::iota(parts.begin(), parts.end(), 0);
    for (std::size_t i = count; i > 1; --i)
    {
      std::swap(parts[i - 1], parts[below(i)]);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const double inside = static_cast<double>(random() >> 11U) * 0x1p-53;
      rows[i].push_back(
        range.at((static_cast<double>(parts[i]) + inside) / static_cast<double>(count)));
    }
  }
  return rows;
}

} // namespace palp
