#include "app/input/quantity.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <string>

namespace palp
{
namespace
{

struct Unit
{
  std::string_view name;
  long double size; // in SI; long double so that 10 mm is exactly the double 0.01
};

constexpr std::array kLength{ Unit{ "mm", 1e-3L }, Unit{ "um", 1e-6L }, Unit{ "cm", 1e-2L },
  Unit{ "m", 1.0L } };
constexpr std::array kPressure{ Unit{ "kPa", 1e3L }, Unit{ "Pa", 1.0L }, Unit{ "MPa", 1e6L },
  Unit{ "GPa", 1e9L } };
constexpr long double kDegree = std::numbers::pi_v<long double> / 180.0L;
constexpr std::array kAngle{ Unit{ "deg", kDegree }, Unit{ "rad", 1.0L }, Unit{ "°", kDegree } };
constexpr std::array kForce{ Unit{ "N", 1.0L }, Unit{ "mN", 1e-3L } };
constexpr std::array kTime{ Unit{ "s", 1.0L }, Unit{ "ms", 1e-3L } };
constexpr std::array kDamping{ Unit{ "N*s/m", 1.0L }, Unit{ "Ns/m", 1.0L }, Unit{ "N·s/m", 1.0L } };
constexpr std::array kStiffness{ Unit{ "N/m", 1.0L }, Unit{ "N/mm", 1e3L } };
constexpr std::array kSpeed{ Unit{ "mm/s", 1e-3L }, Unit{ "cm/s", 1e-2L }, Unit{ "m/s", 1.0L } };
constexpr std::array kFrequency{ Unit{ "kHz", 1e3L }, Unit{ "Hz", 1.0L } };

// the first unit is the one that messages recommend
std::span<const Unit> unitsOf(Quantity kind)
{
  switch (kind)
  {
    case Quantity::Length:
      return kLength;
    case Quantity::Pressure:
      return kPressure;
    case Quantity::Angle:
      return kAngle;
    case Quantity::Force:
      return kForce;
    case Quantity::Time:
      return kTime;
    case Quantity::Damping:
      return kDamping;
    case Quantity::Stiffness:
      return kStiffness;
    case Quantity::Speed:
      return kSpeed;
    case Quantity::Frequency:
      return kFrequency;
  }
  return {};
}

[[noreturn]] void refuse(std::string_view what, std::string_view text, const std::string& why)
{
  throw Error(
    ErrorCode::BadValue, shortened(std::string(what)) + ": " + inQuotes(text) + " " + why);
}

struct Split
{
  double number;
  std::string_view rest; // what follows the number
};

Split splitNumber(std::string_view text, std::string_view what)
{
  std::string_view digits = trimmed(text);
  digits.remove_prefix(digits.starts_with('+') ? 1 : 0);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::string_view rest = digits.substr(static_cast<std::size_t>(end - digits.data()));
  if (error != std::errc{} || !std::isfinite(number) || rest.starts_with('.'))
  {
    refuse(what, text, "is not a number; write it like 10 or 1.5e+06");
  }
  if (rest.starts_with(','))
  {
    refuse(what, text, "has a comma; write decimals with a point, like 12.5");
  }
  return { number, trimmed(rest) };
}

[[noreturn]] void refuseBare(std::string_view what, std::string_view text, std::string_view number,
  const Unit& likely, std::span<const Unit> units)
{
  refuse(what, text,
    "has no unit; write " + std::string(number) + std::string(likely.name) + " (" +
      listed(units, &Unit::name) + ")");
}

const Unit& unitNamed(std::string_view name, Quantity kind, std::string_view what,
  std::string_view text, std::string_view number)
{
  const std::span<const Unit> units = unitsOf(kind);
  const bool micro = name == "\u00B5m" || name == "\u03BCm"; // the sign, the Greek letter
  for (const Unit& unit : units)
  {
    if (unit.name == (micro ? "um" : name))
    {
      return unit;
    }
  }
  if (name.empty())
  {
    refuseBare(what, text, number, units.front(), units);
  }
  refuse(
    what, text, "has the unit " + inQuotes(name) + "; use one of " + listed(units, &Unit::name));
}

double toSi(double number, const Unit& unit)
{
  return static_cast<double>(static_cast<long double>(number) * unit.size);
}

} // namespace

double parseQuantity(
  std::string_view text, Quantity kind, std::string_view what, std::string_view usual)
{
  const Split split = splitNumber(text, what);
  const Unit& unit = unitNamed(split.rest.empty() ? usual : split.rest, kind, what, text, text);
  return toSi(split.number, unit);
}

std::string quantityText(double value, Quantity kind)
{
  const std::span<const Unit> units = unitsOf(kind);
  const Unit& usual = units.front();
  const auto size = static_cast<double>(usual.size);
  // a rounded quotient often misses the number by a digit that its float neighbors do not have
  for (const double number : { std::round(value / size * 1e9) / 1e9, value / size })
  {
    if (toSi(number, usual) == value)
    {
      return shortest(number).append(usual.name);
    }
  }
  const auto si = std::ranges::find(units, 1.0L, &Unit::size);
  return shortest(value).append(si->name);
}

double parseWithin(
  std::string_view text, Quantity kind, const Bounds& bounds, std::string_view what)
{
  const auto isWithin = [&](double value) { return value >= bounds.least && value <= bounds.most; };
  if (const Split split = splitNumber(text, what); split.rest.empty())
  {
    const std::span<const Unit> units = unitsOf(kind);
    const auto meant = std::ranges::find_if(
      units, [&](const Unit& unit) { return isWithin(toSi(split.number, unit)); });
    refuseBare(what, text, text, meant != units.end() ? *meant : units.front(), units);
  }
  const double value = parseQuantity(text, kind, what);
  if (!isWithin(value))
  {
    refuse(what, text, "is out of range; give " + std::string(bounds.inWords));
  }
  return value;
}

double checkedDamping(double damping, std::string_view what)
{
  constexpr double kMost = 1000.0; // [N s/m], of an oil damper
  if (!(damping >= 0.0 && damping <= kMost))
  {
    std::ostringstream text;
    text << what << ": " << damping << " N*s/m; give 0 to " << kMost << " N*s/m";
    throw Error(ErrorCode::BadValue, text.str());
  }
  return damping;
}

double parseNumber(std::string_view text, std::string_view what)
{
  const Split split = splitNumber(text, what);
  if (!split.rest.empty())
  {
    refuse(what, text, "has a unit; give the bare number");
  }
  return split.number;
}

std::vector<double> parseNumbers(std::string_view text, std::string_view what)
{
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    if (trimmed(one).empty())
    {
      refuse(what, text, "lacks a number; give numbers with a comma between them");
    }
    const Split split = splitNumber(one, what);
    if (split.rest.find_first_of("0123456789") != split.rest.npos)
    {
      refuse(what, text, "has no comma between its numbers; write them like -45, 12.5, 30");
    }
    numbers.push_back(parseNumber(one, what));
    begin = end + 1;
  }
  return numbers;
}

std::array<double, 2> parseBand(std::string_view text, std::string_view what)
{
  const std::size_t colon = text.find(':');
  if (colon == text.npos)
  {
    refuse(what, text, "is no range; write it as LOW:HIGH, like 200:3000");
  }
  const std::array band{ parseNumber(text.substr(0, colon), what),
    parseNumber(text.substr(colon + 1), what) };
  if (!(band[0] <= band[1]))
  {
    refuse(what, text, "is empty; write the lower value first, like 200:3000");
  }
  return band;
}

std::string bandText(const std::array<double, 2>& band)
{
  return shortest(band[0]) + ':' + shortest(band[1]);
}

std::vector<std::string> parseLabels(std::string_view text, std::string_view what)
{
  std::vector<std::string> labels;
  for (const std::string& field : csvFields(text)) // names may hold commas, in quotes
  {
    labels.emplace_back(trimmed(field));
    if (labels.back().empty())
    {
      refuse(what, text, "lacks a label; give values or names with a comma between them");
    }
    if (std::ranges::count(labels, labels.back()) > 1)
    {
      refuse(what, text, "names " + labels.back() + " twice; name each label once");
    }
  }
  return labels;
}

std::string labelsText(const std::vector<std::string>& labels)
{
  std::string text;
  for (const std::string& label : labels)
  {
    text.append(text.empty() ? "" : ",").append(csvField(label));
  }
  return text;
}

Range parseRange(std::string_view text, Quantity kind, std::string_view what)
{
  const std::size_t first = text.find(':');
  const std::size_t second = first == text.npos ? first : text.find(':', first + 1);
  if (second == text.npos)
  {
    refuse(what, text, "is not A:B:STEP; write it like 0:10:0.5mm");
  }
  const std::array<Split, 3> parts{ splitNumber(text.substr(0, first), what),
    splitNumber(text.substr(first + 1, second - first - 1), what),
    splitNumber(text.substr(second + 1), what) };
  const Unit& unit = unitNamed(parts[2].rest, kind, what, text, text);
  for (int i = 0; i < 2; ++i)
  {
    const std::string_view own = parts[static_cast<std::size_t>(i)].rest;
    if (!own.empty() && own != unit.name)
    {
      refuse(what, text, "mixes units; give all three in " + std::string(unit.name));
    }
  }
  const double begin = parts[0].number;
  const double end = parts[1].number;
  const double step = parts[2].number;
  if (!(end >= begin) || !(step > 0.0))
  {
    refuse(what, text, "does not go up; give A no larger than B and a positive STEP");
  }
  // a step that misses the end by rounding alone has met it
  const double steps = (end - begin) / step;
  if (steps > 1e6)
  {
    refuse(what, text, "has more than a million values; give a larger STEP");
  }
  const auto whole = static_cast<long>(std::floor(steps + 1e-9));
  Range range{ .si = {}, .given = {}, .unit = toSi(1.0, unit) };
  const long inside = whole + (steps - static_cast<double>(whole) > 1e-9 ? 1 : 0);
  for (long k = 0; k < inside; ++k)
  {
    range.given.push_back(begin + static_cast<double>(k) * step);
  }
  range.given.push_back(end);
  for (const double value : range.given)
  {
    range.si.push_back(toSi(value, unit));
  }
  return range;
}

} // namespace palp
