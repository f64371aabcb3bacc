#pragma once

#include "haptics/force/linear/coating.h"

#include <string>
#include <string_view>

namespace palp
{

/// Reads coatings from the surface down, as in `2mm:200kPa:0.45,10mm:20kPa:0.48`: thickness,
/// Young's modulus, Poisson's ratio.
///
/// @param text    empty: none
/// @param what    name of the option or field, for the message
/// @throws Error  BadValue: not of this form, a value out of range, too many
[[nodiscard]] Coatings parseCoatings(std::string_view text, std::string_view what = "--coating");

/// The same text back, which reads as the same coatings to the last bit.
[[nodiscard]] std::string describeCoatings(const Coatings& coatings);

} // namespace palp
