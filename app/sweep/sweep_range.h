#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// A number as a person writes it, with what follows it: the unit, or nothing.
struct NumberText
{
  double number;
  std::string unit;
};

/// @return  nothing where the text is not one number and a unit
[[nodiscard]] std::optional<NumberText> numberText(std::string_view text);

/// What lies between two values of one unit.
struct SweepRange
{
  double from;
  double to;
  std::string unit;
  bool logarithmic = false;

  /// @param fraction  0 for `from`, 1 for `to`
  /// @return          with its unit, rounded to twelve digits
  [[nodiscard]] std::string at(double fraction) const;
};

/// Evenly spaced, both ends included.
/// @param count  1 gives the first end
[[nodiscard]] std::vector<std::string> evenly(const SweepRange& range, std::size_t count);

/// A Latin hypercube: each range is cut into as many equal parts as there are rows, and each part
/// is met once, at a random place in it. The same seed gives the same rows on every machine.
/// @source  McKay, Beckman, Conover, Technometrics 21 (1979) 239
/// @return  rows of one value per range
[[nodiscard]] std::vector<std::vector<std::string>> latinHypercube(
  const std::vector<SweepRange>& ranges, std::size_t count, std::uint64_t seed);

} // namespace palp
