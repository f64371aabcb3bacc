#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/linear/coating.h"
#include "haptics/force/validity.h"

#include <string>

namespace CLI
{
class App;
}

namespace palp
{

/// Which law answers, and what it takes into account: options that every command shares.
struct LawOptions
{
  LawMode mode = LawMode::Paper;
  Base base = Base::Bonded;
  ConstitutiveModel constitution = ConstitutiveModel::NeoHookean;
  Coatings coatings{};
  bool rated = true; ///< the law also tells how far it is off, which takes the same table

  void addTo(CLI::App& command);

  /// @throws Error  BadFile: the shipped table of large strain, where it is needed; BadValue:
  ///                coatings under another law than the corrected one
  [[nodiscard]] LawSettings settings() const;
};

/// The same in words, as in `corrected, bonded base, neo-hookean`.
[[nodiscard]] std::string describeLaw(const LawSettings& settings);

/// The place that is pressed, where no surface tells it.
struct GeometryOptions
{
  ContactGeometry geometry{}; ///< at a depth of 0; as it is: upright on a flat half-space
  bool given = false;         ///< by an option

  void addTo(CLI::App& command);
};

/// The conditions of a law that a place breaks, for people; empty when it holds.
[[nodiscard]] std::string brokenNames(const Rules& rules);

} // namespace palp
