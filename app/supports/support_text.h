#pragma once

#include "calibration/organ/organ_model.h"
#include "haptics/surface/surface.h"

#include <functional>
#include <memory>
#include <string>

namespace palp
{

/// Another region of the image that a body is of.
struct SupportRegion
{
  std::shared_ptr<const Surface> surface; ///< never null
  double reach = 0.0;                     ///< to what it holds [m]
};

/// @param label  value or name
using FindRegion = std::function<SupportRegion(const std::string& label)>;

/// Where a body rests, as text: `KIND:box:X0,Y0,Z0:X1,Y1,Z1` in mm holds it within a box,
/// `KIND:direction:X,Y,Z:ANGLE` where its surface faces a direction within an angle, and
/// `KIND:label:N` where it touches another label of its image. KIND is `bonded`, or `sliding`,
/// which holds it across the mean of that surface only.
///
/// @param surface  closed; it has to live as long as the result
/// @param find     none: it is of no label map
/// @throws Error   BadValue: names what is wrong, or that it holds nothing of the surface; also as
///                 find
[[nodiscard]] Support parseSupport(
  const std::string& text, const Surface& surface, const FindRegion& find = {});

} // namespace palp
