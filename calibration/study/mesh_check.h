#pragma once

#include "calibration/study/case.h"

#include <optional>
#include <stop_token>

namespace palp::fem
{

/// Halving the elements changes no force that is kept by more than this, by the estimate of
/// MeshCheck, which takes about a quarter of the time [-].
constexpr double kMeshError = 0.01;

/// A case with elements twice as large, pressed to the same depths: tells the error of the mesh.
class MeshCheck
{
public:
  /// @param study  its body fits with elements twice as large, see fem::check
  explicit MeshCheck(const Case& study);

  /// By how much halving the elements would change the force: a third of its change from the
  /// larger elements to the case's own. Forces converge with the second order where the contact
  /// is resolved, a fourth, and slower where it is not. Where the contact spans few elements, that
  /// may hit zero by chance: no less than 7 % over the square of their number, and more under
  /// a tool steeper than 45 degrees.
  ///
  /// @param step  of the case itself, deeper than before
  /// @return      [-]; infinite where the larger elements have no solution, and from there on
  [[nodiscard]] double changeOnHalving(const IndentationStep& step, const std::stop_token& stop);

private:
  Body body_;
  Indenter indenter_;
  bool lost_ = false;
};

/// The same depth on elements of a half to an eighth of the case's, for a contact that spans too
/// few.
/// @return  nothing where they do not suffice either, or when stopped
[[nodiscard]] std::optional<IndentationStep> onFinerElements(
  const Case& study, double depth, const std::stop_token& stop);

} // namespace palp::fem
