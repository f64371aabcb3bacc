#pragma once

#include <string>
#include <vector>

namespace palp
{

/// How an organ stands in the scene of an import.
struct OrganLook
{
  const char* role;   ///< press, through or show
  const char* color;  ///< as 3D Slicer paints such a part, #rrggbb
  const char* tissue; ///< a name of shippedTissues(); null: none that was measured
};

/// By a word in its name: "left kidney", "Liver_vessels".
/// @source  colors: 3D Slicer's GenericAnatomyColors
[[nodiscard]] OrganLook lookOf(const std::string& name);

/// Those of a scene, of which one at least is pressed.
[[nodiscard]] std::vector<OrganLook> looksOf(const std::vector<std::string>& names);

} // namespace palp
