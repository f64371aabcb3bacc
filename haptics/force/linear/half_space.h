#pragma once

#include "haptics/force/linear/contact_table.h"
#include "haptics/tip/tip.h"

#include <memory>

namespace palp
{

/// What a linear body with a contact modulus of 1 answers.
struct LinearContact
{
  double force = 0.0;     ///< F / E* [m^2]
  double radius = 0.0;    ///< a [m]
  double stiffness = 0.0; ///< dF/ddepth / E* [m], 2 a on a half-space
};

/// Exact linear solution for a rigid frictionless tip on a half-space.
///
/// Closed forms for the six shapes, a baked table for a profile. Once the whole base is in
/// contact the tip is a shaft and the force grows as under a flat punch.
///
/// @source Sneddon 1965; blunt cone: Ciavarella 1999; dF/ddepth: Pharr, Oliver and Brotzen 1992
class HalfSpace
{
public:
  /// @param tip  checked
  explicit HalfSpace(const Tip& tip);

  /// @param depth  delta [m], more than 0
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] LinearContact operator()(double depth) const noexcept;

private:
  Tip tip_;
  double baseRadius_;                         // [m]
  double baseDepth_;                          // at which the base is in contact [m]
  std::shared_ptr<const ContactTable> table_; // of a profile, else null
};

} // namespace palp
