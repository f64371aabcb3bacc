#pragma once

#include "haptics/force/nodules/homogeneous_press.h"
#include "haptics/force/nodules/nodule.h"
#include "haptics/force/nodules/nodule_rules.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// A difference that people just notice.
struct JustNoticeable
{
  const char* name;          ///< of what they compare
  double fraction;           ///< Weber's [-]
  const char* source;        ///< who measured it
  bool isCompliance = false; ///< depth by force, which falls where the force rises

  /// What of a contrast people compare, both pressed equally deep: force and modulus differ by the
  /// contrast itself [-].
  /// @param contrast  force over that beside, less 1; above -1 [-]
  [[nodiscard]] constexpr double difference(double contrast) const noexcept
  {
    return isCompliance ? -contrast / (1.0 + contrast) : contrast;
  }
};

/// From the best of conditions to those of a tool.
inline constexpr std::array kJustNoticeable{
  JustNoticeable{ "force", 0.07, "Pang, Tan, Durlach 1991" },
  JustNoticeable{ "modulus by finger", 0.15, "Bergmann Tiest, Kappers 2009" },
  JustNoticeable{ "compliance", 0.22, "Tan 1995", true },
  JustNoticeable{ "modulus by stylus", 0.45,
    "3 times that by finger, without the feel of the surface; Bergmann Tiest, Kappers 2009" },
};

/// How much of the force a nodule right below a tool adds or takes, at one depth.
class NoduleContrast
{
public:
  /// @param law     as HomogeneousPress
  /// @param place   where and how deep; the depth more than 0
  /// @throws Error  BadValue: as HomogeneousPress
  NoduleContrast(const ForceLaw& law, const ContactGeometry& place);

  /// Force with the nodule over that without, less 1: below 0 for a soft one [-].
  /// @param nodule  within the body, checked
  [[nodiscard]] double operator()(const Nodule& nodule) const;

  [[nodiscard]] NoduleRules rules(const Nodule& nodule) const;

  /// Of the body below the tool [m]; infinite on a half-space.
  [[nodiscard]] double thickness() const noexcept
  {
    return thickness_;
  }

private:
  HomogeneousPress press_; // whose last knot is the depth
  double thickness_;       // of the body [m]
};

/// The smallest nodule whose contrast people notice.
struct Detectable
{
  Nodule nodule;
  double contrast; ///< as NoduleContrast [-]
};

/// The smallest nodule of a stiffness below a cover that people notice, one for each difference;
/// none where not even the largest one comes to it: that the body holds, that kClosestNodule
/// allows, of a radius of 0.1 m.
///
/// @param cover        depth of the nodule's highest point [m]
/// @param ratio        its Young's modulus over that of the tissue [-]
/// @param noticed      up or down
/// @throws Error       BadValue: as checkedNodule; no nodule fits below the cover
[[nodiscard]] std::vector<std::optional<Detectable>> smallestDetectable(
  const NoduleContrast& contrast, double cover, double ratio,
  std::span<const JustNoticeable> noticed);

} // namespace palp
