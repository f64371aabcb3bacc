#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/linear/coating.h"
#include "haptics/force/relaxation/prony_series.h"
#include "haptics/force/validity.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

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
  Base base = Base::Unset;
  ConstitutiveModel constitution = ConstitutiveModel::NeoHookean;
  Coatings coatings{};
  PronySeries relaxation{};
  double friction = 0.0; ///< mu [-]
  bool rated = true;     ///< the law also tells how far it is off, which takes the same table

  void addTo(CLI::App& command);

  /// The same without coatings and relaxation.
  void addUncoatedTo(CLI::App& command);

  /// The same for the corrected law alone, the only one that is offered.
  void addCorrectedTo(CLI::App& command);

  /// Offers that law alone from now on, of options that were added.
  void offerCorrectedAlone(CLI::App& command);

  /// Refuses all at once that only the corrected law takes, under another law.
  ///
  /// @param others   further options of this kind that were given
  /// @param besides  what one of them takes besides that law, as in ", with --history FILE.csv"
  /// @throws Error   BadValue
  void checkTaken(
    const std::vector<std::string>& others = {}, const std::string& besides = "") const;

  /// @throws Error  BadFile: the shipped table of large strain, where it is needed; BadValue:
  ///                coatings, relaxation or friction under another law than the corrected one
  [[nodiscard]] LawSettings settings() const;

private:
  void addCorrectedLaw(CLI::App& command);
};

/// Reads parts of the modulus that decay, as in `0.3:50ms,0.2:1s`: fraction of the instantaneous
/// modulus, time.
///
/// @param text    empty: none
/// @param what    name of the option or field, for the message
/// @throws Error  BadValue: not of this form, as PronySeries::add
[[nodiscard]] PronySeries parseRelaxation(
  std::string_view text, std::string_view what = "--relaxation");

/// The same text back, in s.
[[nodiscard]] std::string describeRelaxation(const PronySeries& series);

/// Reads mu, the coefficient of friction between tool and tissue.
/// @throws Error  BadValue: not 0 to 5
[[nodiscard]] double parseFriction(std::string_view text, std::string_view what = "--friction");

/// A law in words, as in `corrected, base bonded, neo-hookean`.
[[nodiscard]] std::string describeLaw(const LawSettings& settings);

/// The factors of a law that act at a place, as in `shape x0.8998, thickness x1.1768`; empty: none.
[[nodiscard]] std::string actingFactors(const ForceLaw& law, const ContactGeometry& place);

/// The place that is pressed, where no surface tells it.
struct GeometryOptions
{
  ContactGeometry geometry{}; ///< at a depth of 0; as it is: upright on a flat half-space
  bool given = false;         ///< by an option

  void addTo(CLI::App& command);
};

/// The conditions of a law that a place breaks, for people; empty when it holds.
[[nodiscard]] std::string brokenNames(std::span<const Rule> rules);

} // namespace palp
