#pragma once

#include "haptics/force/force_law.h"
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
  std::string mode = "paper";
  std::string base = "bonded";
  std::string constitution = "neo-hookean";
  std::string coating; ///< as parseCoatings
  bool rated = true;   ///< the law also tells how far it is off, which takes the same table

  void addTo(CLI::App& command);

  /// @throws Error  BadFile: the shipped table of large strain, where it is needed; BadValue: as
  ///                parseCoatings, or coatings under another law than the corrected one
  [[nodiscard]] LawSettings settings() const;
};

/// The same in words, as in `corrected, bonded base, neo-hookean`.
[[nodiscard]] std::string describeLaw(const LawSettings& settings);

/// The place that is pressed, where no surface tells it; as text with units.
struct PlaceOptions
{
  std::string thickness;     ///< empty: half-space
  std::string surfaceRadius; ///< R0, or two principal ones R1:R2; empty: flat
  std::string tilt;          ///< empty: upright

  void addTo(CLI::App& command);

  /// @return         the place at a depth of 0
  /// @throws Error  BadValue: names the option, what is wrong and how to write it
  [[nodiscard]] ContactGeometry place() const;

  [[nodiscard]] bool given() const noexcept
  {
    return !thickness.empty() || !surfaceRadius.empty() || !tilt.empty();
  }
};

/// The conditions of a law that a place breaks, for people; empty when it holds.
[[nodiscard]] std::string brokenNames(const Rules& rules);

} // namespace palp
