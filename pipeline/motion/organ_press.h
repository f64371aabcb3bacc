#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/series/organ_motion.h"
#include "haptics/pose.h"
#include "haptics/servo/sample.h"
#include "haptics/servo/scene.h"
#include "haptics/tip/tip.h"

#include <span>

namespace palp
{

/// What the tool of a sample presses its body with, where that moves as a whole. Tissue that
/// relaxes keeps its shape as its force goes down.
/// @param depth   as drawn [m]
/// @param tissue  of the organ that is pressed
[[nodiscard]] OrganLoad organLoadOf(const Sample& sample, double depth, const Scene& tissue);

/// Puts a tool and its contact where they are for who goes along with the body below them.
/// @param loads  all that press the body
void seeFromBody(const OrganMotion& motion, std::span<const OrganLoad> loads, const Tip& tip,
  Contact& contact, ToolPose& pose);

} // namespace palp
