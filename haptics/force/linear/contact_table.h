#pragma once

#include "haptics/tip/tip.h"

#include <array>
#include <cstddef>
#include <vector>

namespace palp
{

/// Contact of a tip with a half-space against the depth, baked for reading in constant time.
///
/// With it come the moments of the depth function g(s) over the contact, of which the force on
/// a half-space and on a layer are made.
class ContactTable
{
public:
  static constexpr int kMoments = 4;

  struct Entry
  {
    double force = 0.0;                        ///< F / E* on a half-space [m^2]
    double radius = 0.0;                       ///< a [m]
    double radiusSlope = 0.0;                  ///< da / ddepth [-]; 0 once the base is in contact
    std::array<double, kMoments> moments = {}; ///< k: int_0^a g(s) (s/a)^(2k) ds [m^2]
  };

  /// @param tip  checked
  explicit ContactTable(const Tip& tip);

  /// @param depth    [m], more than 0; at most baseDepth() is read
  /// @param moments  how many of them are asked for; 1 is all that a half-space needs
  /// @return       smooth and monotone in depth, relative error of the force below 1e-6, within
  ///               4 % of the depth at which a corner of a profile is reached below 6e-5
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Entry operator()(double depth, std::size_t moments = kMoments) const noexcept;

  /// Depth at which the whole base is in contact; for a sphere where a is R but for 1e-9 [m].
  [[nodiscard]] double baseDepth() const noexcept
  {
    return baseDepth_;
  }

private:
  struct Knot
  {
    Entry value;
    Entry slope; // from knot to knot
  };

  double baseDepth_;
  double firstLog_ = 0.0;   // log of the first knot's depth
  double perStep_ = 0.0;    // one over that of log(depth)
  std::vector<Knot> knots_; // none where the base touches at once
  Entry base_;              // at baseDepth()
};

} // namespace palp
