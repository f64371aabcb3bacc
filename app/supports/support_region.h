#pragma once

#include "haptics/surface/surface.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace palp
{

struct MeshSource;

/// Another region of the image that a body is of.
struct SupportRegion
{
  std::shared_ptr<const Surface> surface; ///< never null, in the frame of the image
  double reach = 0.0;                     ///< to what it holds [m]
};

/// @param label  value or name
using FindRegion = std::function<SupportRegion(const std::string& label)>;

/// What finds regions of an image by reading it each time; none: the body is of no label map.
/// @param mesh    lives as long as the result
/// @throws Error  that function: BadValue: no such label; as readFileOrgans and madeReady
[[nodiscard]] FindRegion regionsBeside(const MeshSource& mesh);

/// What finds some, which are read at once.
/// @throws Error  as the function above
[[nodiscard]] FindRegion readRegions(
  const MeshSource& mesh, const std::vector<std::string>& labels);

} // namespace palp
