#pragma once

#include "app/press/recording.h"
#include "haptics/contact/contact.h"
#include "haptics/force/validity.h"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// One press, from touch to release.
struct PressSummary
{
  std::string name;                  ///< for people
  double begin = 0.0;                ///< time of the first sample that touches [s]
  double end = 0.0;                  ///< and of the last [s]
  double force = 0.0;                ///< the largest of the law [N]
  std::optional<double> stiffness{}; ///< dF/ddepth at once where the force first reaches 1 N [N/m]
  double energy = 0.0; ///< work of the law's force on the way to the largest depth [J]; of a
                       ///< recording that begins in the tissue, from its first sample on
  Contact deepest{};   ///< where it was deepest: place, depth, thickness, curvature
  int organ = 0;       ///< that was pressed, as in a Sample
};

constexpr double kBounce = 0.02; ///< that a tool is apart at least, to have released [s]

/// Names a press that has none, by its place in the order, from 0: "press 1".
[[nodiscard]] std::string pressName(std::size_t index);

/// The rules of validity that a contact breaks, in words; empty when all hold.
/// @param scene  the organ that is touched
[[nodiscard]] std::string outsideLimits(
  const Scene& scene, const Validity& validity, const Contact& contact);

/// The presses of a recording, with its names; of one that has begun, up to where it is.
///
/// The tool releases where samples show it apart, for kBounce or more: a shorter lift is a bounce
/// of the same press. Where time passes between two samples that touch, with none between them, it
/// releases only if there was time for it: to give back the first depth as fast as the depth
/// changed before, to be apart for kBounce, and to press the second one as fast as it changes
/// after. These speeds are the largest over 10 ms or a sample, within as much time as passes
/// without one. So a servo that skips ends no press. Nor do samples that thinning left out, since
/// it keeps what is apart. Velocities do not count: a table has none.
/// Another organ is another press, and so is another place, further away than the tool is wide.
[[nodiscard]] std::vector<PressSummary> findPresses(const Recording& recording);

/// Writes presses.csv: one row per press, with tool and law. The same recording gives the same
/// bytes.
void writePresses(std::ostream& out, const Recording& recording);

/// The same into a file.
/// @throws Error  BadFile: cannot be written
void writePresses(const std::filesystem::path& file, const Recording& recording);

} // namespace palp
