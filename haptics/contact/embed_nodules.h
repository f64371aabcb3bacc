#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/nodules/nodule_field.h"
#include "haptics/surface/surface.h"

#include <memory>
#include <span>

namespace palp
{

/// Nodules in a body, felt by the tool of a law: where each lies below the surface, and the tables
/// of its force, which takes some tenths of a second for each.
///
/// @param nodules  in the frame of the surface
/// @return         null where there are none
/// @throws Error   BadValue: a nodule that does not lie within the body, two that overlap, or as
///                 NoduleField; named by its number as `nodules/0`
[[nodiscard]] std::shared_ptr<const NoduleField> embedNodules(
  const Surface& surface, const ForceLaw& law, std::span<const PlacedNodule> nodules);

/// The place of a contact as nodules take it.
[[nodiscard]] inline NoduleContact noduleContactOf(const Contact& contact) noexcept
{
  return { .center = contact.center, .normal = contact.normal, .depth = contact.depth };
}

} // namespace palp
