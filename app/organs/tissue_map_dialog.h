#pragma once

#include "pipeline/tissue/stiffness_source.h"

#include <optional>

class QWidget;

namespace palp
{

/// Asks for the Young's modulus over a body, as text, until it can be read.
///
/// @param now  shown at first
/// @return     none: canceled
[[nodiscard]] std::optional<StiffnessSource> askTissueMap(
  QWidget* parent, const StiffnessSource& now);

} // namespace palp
