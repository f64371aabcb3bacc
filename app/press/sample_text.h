#pragma once

#include <string>
#include <string_view>

// What the writer and the reader of samples.csv share.

namespace palp
{

// comment lines, the last with numbers after its parts
inline constexpr std::string_view kContactOnly =
  "# contact only: of the rest, the sample before and the one after each contact";
inline constexpr std::string_view kSecondDevice = "# second device: ";
inline constexpr std::string_view kThinned = "# of a long recording: before ";
inline constexpr std::string_view kThinnedTo =
  " s only the samples of the least and the largest depth and force within each ";

/// A length in mm whose digits are those of its meters, so that no bit is lost on the way.
[[nodiscard]] std::string exactMillimeters(double meters);

/// The meters of such a text, or of any number in mm.
/// @throws Error  BadValue: no number
[[nodiscard]] double fromExactMillimeters(std::string_view text);

} // namespace palp
