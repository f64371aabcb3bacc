#pragma once

#include "app/input/nodule_options.h"
#include "haptics/force/force_law.h"
#include "haptics/force/maps/stiffness_field.h"
#include "haptics/force/validity.h"

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

namespace palp
{

/// A law at one place, with what lies below it.
struct PressedPlace
{
  ForceLaw law;
  std::optional<NodulesUnderTool> nodules;
  std::shared_ptr<const StiffnessField> stiffness; ///< null: the same everywhere
  Validity validity;

  /// Of the law, of how the tissue varies, and of the nodules in it.
  [[nodiscard]] Response response(const ContactGeometry& geometry) const;

  /// What lies below pushes the tool aside with [N]: away from nodules, by a map along its x and y.
  [[nodiscard]] Eigen::Vector2d aside(const ContactGeometry& geometry) const;

  /// All conditions under which that holds.
  [[nodiscard]] std::vector<Rule> rules(const ContactGeometry& geometry) const;
};

} // namespace palp
