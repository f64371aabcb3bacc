#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"

#include <memory>

namespace palp
{

/// All the servo thread knows of the world. Replaced whole, through Latest<Scene>.
struct Scene
{
  std::shared_ptr<const Surface> surface; ///< null: nothing to touch
  ForceLaw law{ SphereTip{ .radius = 0.01 }, Material{ .youngModulus = 50e3, .poissonRatio = 0.33 } };
  ContactRule rule = ContactRule::Exact;
  double damping = 0.0;    ///< b [N s/m], 0 or more
  double forceLimit = 4.0; ///< [N], at most what the device can bear
};

} // namespace palp
