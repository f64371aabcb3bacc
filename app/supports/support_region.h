#pragma once

#include "app/supports/support_text.h"

#include <string>
#include <vector>

namespace palp
{

struct MeshSource;

/// Reads the regions that supports name by the label, each once, which takes as long as its image.
/// @return        what finds them; none: the body is of no label map
/// @throws Error  BadValue: no such label; as readFileOrgans and madeReady
[[nodiscard]] FindRegion readRegions(
  const MeshSource& mesh, const std::vector<std::string>& supports);

} // namespace palp
