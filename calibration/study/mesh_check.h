#pragma once

#include "calibration/study/study.h"

namespace palp::fem
{

/// A case with elements twice as large, pressed to the same depths: tells the error of the mesh.
class MeshCheck
{
public:
  /// @param study  its body fits with elements twice as large, see fem::check
  explicit MeshCheck(const Case& study);

  /// By how much halving the elements would change the force: a third of its change from the
  /// larger elements to the case's own. Forces converge with the second order where the contact
  /// is resolved, a fourth, and slower where it is not. Where the contact spans few elements, that
  /// may hit zero by chance: no less than 7 % over the square of their number.
  ///
  /// @param step  of the case itself, deeper than before
  /// @return      [-]; infinite where the larger elements have no solution, and from there on
  [[nodiscard]] double changeOnHalving(const IndentationStep& step, const std::stop_token& stop);

private:
  Body body_;
  Indenter indenter_;
  bool lost_ = false;
};

} // namespace palp::fem
