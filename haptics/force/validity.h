#pragma once

#include "haptics/force/force_law.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace palp
{

/// One condition under which a law may be believed, at one place.
struct Rule
{
  static constexpr double kDoubtful = 0.8; ///< fraction from which on the limit is near

  const char* name;
  const char* unit; ///< of value and limit: "-", "rad" or "N/m"
  double value;     ///< 0 or more
  double limit;     ///< infinite where none is known
  const char* why;  ///< what the limit is, in words

  [[nodiscard]] bool holds() const noexcept
  {
    return value <= limit;
  }

  /// How much of the limit is used; above 1 the rule is broken.
  [[nodiscard]] double fraction() const noexcept
  {
    return value == 0.0 || limit == std::numeric_limits<double>::infinity() ? 0.0 : value / limit;
  }
};

using Rules = std::array<Rule, 14>;

/// A bit for each rule that does not hold, the first rule the lowest.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::uint32_t brokenRules(std::span<const Rule> rules) noexcept;

/// Tells for each sample how far the law in use may be believed.
///
/// The forces are compared with the best law known here: the corrected one, with the same base
/// and the same table of large strain.
class Validity
{
public:
  static constexpr double kJustNoticeable = 0.07; ///< of a force by hand [-], Sec. 3.2

  struct Limits
  {
    double deepest = 0.0; ///< whose force is the maximum of Eq. (9) [m]; 0: the base radius
    double stableStiffness = std::numeric_limits<double>::infinity(); ///< of the device [N/m]
  };

  explicit Validity(const ForceLaw& law);
  Validity(const ForceLaw& law, const Limits& limits);

  /// @param edgeDistance  from the contact to an open or sharp edge [m]; infinite where there is
  ///                      none
  /// @source              Eqs. (7), (9), Secs. 3.2, 4.3
  /// @realtime            pure; no allocation, no lock, no exception
  [[nodiscard]] Rules operator()(const ContactGeometry& local,
    double edgeDistance = std::numeric_limits<double>::infinity()) const noexcept;

private:
  ForceLaw law_;
  ForceLaw best_;
  Limits limits_;
  double thickness_; // limit of a / thickness
  double tilt_;      // limit for the force's magnitude [rad]
  double membrane_;  // depth to which a stiff coating does not stretch as a membrane [m]
  double thinnest_;  // body that the law tells from thinner ones [m]
};

} // namespace palp
