#pragma once

#include "haptics/material.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// A tissue or a phantom that was measured.
struct TissuePreset
{
  std::string name;             ///< as in hcc
  std::string title;            ///< for people
  Material material;            ///< E [Pa] and nu
  std::optional<double> low{};  ///< of the range of E [Pa]; none: not known
  std::optional<double> high{}; ///< of the range of E [Pa]; none: not known
  std::string spread;           ///< what the range is, as in "mean and SD of 30 people"
  std::string method;           ///< how it was measured
  std::string source;           ///< publication
  std::string note;             ///< what else is known; may be empty
};

/// What the measured shear modulus of tissue is multiplied by to give Young's, since it hardly
/// changes its volume: E = 2 G (1 + nu), nu = 1/2, as all elastography takes it.
inline constexpr double kYoungOverShear = 3.0;

/// Reads tissues, whose modulus stands as `young`, or as measured `shear`.
///
/// @param file    stands before each message
/// @throws Error  BadFile: names the entry and the key: missing, unknown, outside its range, a
///                modulus outside its own range, a name that stands twice
[[nodiscard]] std::vector<TissuePreset> parseTissues(
  const std::string& text, const std::string& file);

/// Those of data/tissues.json.
/// @throws Error  BadFile: not there, or as parseTissues
[[nodiscard]] std::vector<TissuePreset> shippedTissues();

/// @param what    name of the option or field, for the message
/// @throws Error  BadValue: tells the nearest names
[[nodiscard]] const TissuePreset& tissueNamed(
  std::string_view name, std::span<const TissuePreset> tissues, std::string_view what);

/// A tissue in a line: E with its range, what that is, and where it stands.
[[nodiscard]] std::string describeTissue(const TissuePreset& tissue);

} // namespace palp
