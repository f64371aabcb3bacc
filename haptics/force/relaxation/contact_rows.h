#pragma once

#include <array>
#include <cstddef>
#include <functional>

namespace palp
{

/// An elastic law at one depth.
struct ElasticForce
{
  double force;     ///< F [N]
  double stiffness; ///< dF/ddepth [N/m]
};

/// An elastic law as springs side by side, each of which is met at a depth of its own:
/// F = sum k_j (depth - d_j)+.
///
/// What happens over time, relaxation and friction, happens in each spring by itself, and is exact
/// for any history where the law is that of a tip of revolution.
///
/// @source  Popov, Hess 2015 (method of dimensionality reduction); Argatov, Popov 2016 (with
///          Maxwell's springs it is Ting's solution)
class ContactRows
{
public:
  static constexpr std::size_t kFine = 96;   ///< rows down to the depth that they are made for
  static constexpr std::size_t kCount = 144; ///< with those from there to 1 m
  static constexpr std::size_t kBlock = 12;  ///< rows between two questions of adapt()

  /// @param law      force 0 and any stiffness at depth 0; stiffness must not fall with depth, and
  ///                 where it does it is taken as constant
  /// @param deepest  [m], more than 0, at most 1; the finer the rows, the less it is
  ContactRows(const std::function<ElasticForce(double)>& law, double deepest);

  /// Gives these rows the stiffness of another place, whose ratio to the usual one is taken as
  /// linear in each block; below a depth it stays.
  ///
  /// @param usual  rows that these are a copy of
  /// @param law    callable as double(double depth) noexcept: dF/ddepth there [N/m]
  /// @realtime     pure; no allocation, no lock, no exception
  template <typename Law>
  void adapt(const ContactRows& usual, double toDepth, const Law& law) noexcept
  {
    const auto ratioAt = [&](std::size_t edge)
    { return usual.total[edge] > 0.0 ? law(edges[edge]) / usual.total[edge] : 1.0; };
    double below = ratioAt(kBlock);
    const double second = ratioAt(2 * kBlock);
    double above = 2.0 * below - second; // at the surface, where both are 0
    for (std::size_t begin = 0;;)
    {
      scaleBlock(usual, begin, above, below);
      begin += kBlock;
      if (begin == kCount || edges[begin] >= toDepth)
      {
        return;
      }
      above = below;
      below = begin == kBlock ? second : ratioAt(begin + kBlock);
    }
  }

  std::array<double, kCount + 1> edges{}; ///< between which the rows are met [m]
  std::array<double, kCount + 1> total{}; ///< dF/ddepth there [N/m], never falling
  std::array<double, kCount> depth{};     ///< d_j [m], never falling
  std::array<double, kCount> stiffness{}; ///< k_j [N/m], 0 or more

private:
  void scaleBlock(const ContactRows& usual, std::size_t begin, double above, double below) noexcept;
};

} // namespace palp
