#include "pipeline/surface_io/length_unit.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <array>
#include <span>
#include <sstream>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr std::array kUnits{ LengthUnit::Millimeter, LengthUnit::Centimeter, LengthUnit::Meter,
  LengthUnit::Micrometer };
constexpr std::span kUsualUnits(kUnits.data(), 3); // of meshes that name none
constexpr double kSmallestBody = 5.0_mm;
constexpr double kLargestBody = 600.0_mm;
constexpr double kLargestImage = 2500.0_mm; // of a whole patient

// the sides of a body are rounded in the file, so that its limits are as well
constexpr double kSlack = 1e-6;

} // namespace

const char* unitName(LengthUnit unit) noexcept
{
  switch (unit)
  {
    case LengthUnit::Micrometer:
      return "um";
    case LengthUnit::Millimeter:
      return "mm";
    case LengthUnit::Centimeter:
      return "cm";
    default:
      return "m";
  }
}

double unitLength(LengthUnit unit) noexcept
{
  switch (unit)
  {
    case LengthUnit::Micrometer:
      return 1.0_um;
    case LengthUnit::Millimeter:
      return 1.0_mm;
    case LengthUnit::Centimeter:
      return 10.0_mm;
    default:
      return 1.0;
  }
}

std::optional<LengthUnit> unitNamed(std::string_view name) noexcept
{
  for (const LengthUnit unit : kUnits)
  {
    if (name == unitName(unit))
    {
      return unit;
    }
  }
  return std::nullopt;
}

UnitChoice parseUnit(std::string_view text)
{
  const UnitChoice unit = unitNamed(text);
  if (!unit && text != "auto")
  {
    throw Error(ErrorCode::BadValue,
      "--unit: " + inQuotes(text) + " is no unit of length here; give um, mm, cm, m or auto");
  }
  return unit;
}

LengthUnit guessUnit(double longestSide, const std::string& file, double field, bool isSlicers)
{
  std::ostringstream sizes;
  UnitChoice fitting;
  int fits = 0;
  for (const LengthUnit unit : kUsualUnits)
  {
    const double side = longestSide * unitLength(unit);
    sizes << (unit == LengthUnit::Millimeter ? "" : ", ") << units::toMillimeters(side) << " mm if "
          << unitName(unit);
    const double whole = field > 0.0 ? field * unitLength(unit) : side;
    if (whole >= kSmallestBody * (1.0 - kSlack) && side <= kLargestBody * (1.0 + kSlack) &&
      whole <= kLargestImage)
    {
      if (isSlicers && unit == LengthUnit::Millimeter)
      {
        return unit;
      }
      fitting = unit;
      ++fits;
    }
  }
  if (fits != 1)
  {
    throw Error(ErrorCode::BadValue,
      file + ": " + (fits == 0 ? "no unit" : "more than one unit") +
        " gives the size of an organ or a part of one (longest side " + sizes.str() +
        "); give the unit, mm, cm or m (--unit)");
  }
  return *fitting;
}

} // namespace palp
