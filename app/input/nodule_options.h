#pragma once

#include "haptics/force/nodules/nodule_rules.h"
#include "haptics/force/nodules/nodules.h"

#include <optional>
#include <string_view>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// A nodule beside the axis of a tool.
struct OffsetNodule
{
  Nodule nodule;
  double offset = 0.0; ///< from the tool's axis to the nodule's [m]
};

/// Reads a nodule, as in `4mm:5mm:10` or `4mm:5mm:10:8mm`: radius, depth of its highest point,
/// stiffness over that of the tissue, distance from the tool's axis.
///
/// @param what    name of the option or field, for the message
/// @throws Error  BadValue: not of this form, or as checkedNodule
[[nodiscard]] OffsetNodule parseNodule(std::string_view text, std::string_view what = "--nodule");

/// Nodules that all lie on one side of a tool, on a line.
class NodulesUnderTool
{
public:
  struct Felt
  {
    NoduleResponse response;
    double lateral = 0.0; ///< force on the tool, away from the nodules [N]
  };

  /// @throws Error  BadValue: as HomogeneousPress, Nodules, checkApart
  NodulesUnderTool(const std::vector<OffsetNodule>& nodules, const ForceLaw& law,
    const ContactGeometry& place, double deepest);

  [[nodiscard]] Felt at(double depth) const noexcept;

  /// @param plain  the law's answer without nodules there
  [[nodiscard]] NoduleRules rules(double depth, const Response& plain) const noexcept;

private:
  std::vector<Nodule> nodules_;
  std::vector<double> offsets_; // [m]
  std::vector<double> squares_; // of the offsets [m^2]
  double thickness_;            // [m]
  ConstitutiveModel constitution_;
  std::optional<Nodules> energy_;
};

/// Nodules in the tissue, as an option that may stand several times.
struct NoduleOptions
{
  std::vector<OffsetNodule> nodules{};

  void addTo(CLI::App& command);

  /// Nothing where no nodule was given.
  /// @throws Error  BadValue: another law than the corrected one, or as NodulesUnderTool
  [[nodiscard]] std::optional<NodulesUnderTool> under(
    const ForceLaw& law, const ContactGeometry& place, double deepest) const;
};

} // namespace palp
