#pragma once

#include "pipeline/formats/regions/image_labels.h"

#include <span>
#include <string>
#include <vector>

namespace palp
{

/// Labels that lie in a body of others, as a tumor does in a liver, and are not filled: with most
/// of their sides they meet those.
///
/// @param all   of the image, the background too
/// @param body  those of the body, in one layer
[[nodiscard]] std::vector<Label> labelsHeld(
  const PatientImage& volume, std::span<const Label> all, std::span<const Label> body);

/// For people: which labels leave hollows in a body, and what makes it solid; empty: there are
/// none.
[[nodiscard]] std::string heldInWords(std::span<const Label> held, std::span<const Label> body);

} // namespace palp
