#pragma once

#include <algorithm>
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
  static constexpr std::size_t kFine = 192;  ///< rows down to the depth that they are made for
  static constexpr std::size_t kCount = 240; ///< with those from there to 1 m
  static constexpr std::size_t kBlock = 24;  ///< rows between two questions of adapt()

  /// What becomes of a law whose stiffness falls with depth.
  enum class Softening
  {
    LeftOut, ///< it is taken as constant there, so that no row is below 0
    Kept,    ///< by rows below 0, so that the force is the law's at every edge
  };

  /// @param law      force 0 and any stiffness at depth 0
  /// @param deepest  [m], more than 0, at most 1; the finer the rows, the less it is
  ContactRows(const std::function<ElasticForce(double)>& law, double deepest,
    Softening softening = Softening::LeftOut);

  /// Gives these rows the stiffness of another place, whose ratio to the usual one is taken as a
  /// parabola through the ends of each block and the next one, and its force at a depth; below that
  /// they stay as they are.
  ///
  /// @param usual  rows that these are a copy of
  /// @param law    callable as ElasticForce(double depth) noexcept, of that place
  /// @realtime     pure; no allocation, no lock, no exception
  template <typename Law>
  void adapt(const ContactRows& usual, double toDepth, const Law& law) noexcept
  {
    const auto ratioAt = [&](std::size_t edge)
    { return usual.total[edge] > 0.0 ? law(edges[edge]).stiffness / usual.total[edge] : 1.0; };
    std::array<double, 3> ratios{ ratioAt(1), ratioAt(kBlock), ratioAt(2 * kBlock) };
    ratios[0] -= (ratios[1] - ratios[0]) / (kBlock - 1); // at the surface itself both are 0
    scaleBlock(usual, 0, ratios);
    std::size_t end = kBlock;
    for (; end < kCount && edges[end] < toDepth; end += kBlock)
    {
      ratios = { ratios[1], ratios[2], ratioAt(std::min(end + 2 * kBlock, kCount)) };
      scaleBlock(usual, end, ratios);
    }
    scaleTo(law(toDepth).force, toDepth, end);
  }

  std::array<double, kCount + 1> edges{}; ///< between which the rows are met [m]
  std::array<double, kCount + 1> total{}; ///< dF/ddepth there [N/m]
  std::array<double, kCount> depth{};     ///< d_j [m], never falling
  std::array<double, kCount> stiffness{}; ///< k_j [N/m], 0 or more unless softening is kept

private:
  void scaleBlock(
    const ContactRows& usual, std::size_t begin, const std::array<double, 3>& ratios) noexcept;
  void scaleTo(double force, double atDepth, std::size_t rows) noexcept;
};

} // namespace palp
