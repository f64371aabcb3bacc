#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace palp
{

/// In what the coordinates of a file are written.
enum class LengthUnit
{
  Micrometer,
  Millimeter,
  Centimeter,
  Meter,
};

/// A unit that somebody named; nothing: to be found from the size.
using UnitChoice = std::optional<LengthUnit>;

/// @return  "um", "mm", "cm" or "m"
[[nodiscard]] const char* unitName(LengthUnit unit) noexcept;

/// @return  length of the unit [m]
[[nodiscard]] double unitLength(LengthUnit unit) noexcept;

/// @return  the unit of that name; nothing for any other text
[[nodiscard]] std::optional<LengthUnit> unitNamed(std::string_view name) noexcept;

/// @param text    "um", "mm", "cm", "m" or "auto"
/// @throws Error  BadValue: anything else
[[nodiscard]] UnitChoice parseUnit(std::string_view text);

/// The one unit that makes a body the size of an organ or a part of one, 5 to 600 mm.
///
/// Of an image, also one that makes it 5 mm to 2.5 m long: a small region of it, as a lesion, tells
/// nothing by its own size.
///
/// @param longestSide  of the bounding box, in the unit that is sought
/// @param file         stands before the message
/// @param field        longest side of the image, in the same; 0: of no image
/// @param isSlicers    a surface with the axes that 3D Slicer states, which writes mm: taken where
///                     they fit, whatever else does
/// @throws Error       BadValue: no unit fits, or two do; says what each would give
[[nodiscard]] LengthUnit guessUnit(
  double longestSide, const std::string& file, double field = 0.0, bool isSlicers = false);

} // namespace palp
