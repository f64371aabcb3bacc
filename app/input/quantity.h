#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// Kinds of physical quantity that the command line and the files of settings know.
enum class Quantity
{
  Length,    ///< um mm cm m
  Pressure,  ///< Pa kPa MPa GPa
  Angle,     ///< deg rad
  Force,     ///< N mN
  Time,      ///< s ms
  Damping,   ///< N*s/m
  Stiffness, ///< N/m N/mm
  Speed,     ///< mm/s cm/s m/s
  Frequency, ///< Hz kHz
};

/// Reads a number with its unit, as in `10mm`, `1.5e+06 Pa`, `45deg`; C locale whatever the user's.
///
/// @param what   name of the option or field, for the message
/// @param usual  unit of a number that has none, where the reader is told it; empty: refused
/// @return       SI
/// @throws Error BadValue: no number, no unit (the message gives the fix),
///               or another quantity's unit
[[nodiscard]] double parseQuantity(
  std::string_view text, Quantity kind, std::string_view what, std::string_view usual = {});

/// The text that reads back as the same number, to the last bit: in the unit that messages
/// recommend, or, where that rounds, in the SI unit.
/// @param value  SI
[[nodiscard]] std::string quantityText(double value, Quantity kind);

/// What an option takes.
struct Bounds
{
  double least;             ///< SI
  double most;              ///< SI
  std::string_view inWords; ///< as in `0.1mm to 1000m`
};

/// Reads a number with its unit within bounds.
/// @throws Error BadValue: as parseQuantity(), or out of range
[[nodiscard]] double parseWithin(
  std::string_view text, Quantity kind, const Bounds& bounds, std::string_view what);

/// @param damping  b [N s/m]
/// @param what     the option's name, for the message
/// @throws Error   BadValue: not 0 to 1000 N s/m
[[nodiscard]] double checkedDamping(double damping, std::string_view what);

/// Reads a bare number.
/// @throws Error BadValue
[[nodiscard]] double parseNumber(std::string_view text, std::string_view what);

/// Reads bare numbers with commas between them, as in `1,2`.
/// @throws Error BadValue: also where a place is empty
[[nodiscard]] std::vector<double> parseNumbers(std::string_view text, std::string_view what);

/// Reads LOW:HIGH, bare numbers, as of the values of an image.
/// @throws Error BadValue: also where the first is the higher
[[nodiscard]] std::array<double, 2> parseBand(std::string_view text, std::string_view what);

/// The same as text, to the last bit.
[[nodiscard]] std::string bandText(const std::array<double, 2>& band);

/// Reads values or names of labels with commas between them, as in `1,liver`; a name that holds one
/// in quotes.
/// @throws Error BadValue: a place is empty
[[nodiscard]] std::vector<std::string> parseLabels(std::string_view text, std::string_view what);

/// The same as text.
[[nodiscard]] std::string labelsText(const std::vector<std::string>& labels);

/// A sequence of values that remembers them in the unit they were given in.
struct Range
{
  std::vector<double> si;    ///< SI values
  std::vector<double> given; ///< the same values in the given unit, free of conversion rounding
  double unit = 1.0;         ///< size of the given unit in SI
};

/// Reads `A:B:STEP`, both ends included; a unit on the last number counts for all.
///
/// `0:10:0.5mm` gives 21 values, `2:2:1mm` one. B is added when the steps do not meet it.
///
/// @throws Error BadValue: B below A, STEP not positive, more than a million values
[[nodiscard]] Range parseRange(std::string_view text, Quantity kind, std::string_view what);

} // namespace palp
