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
  std::optional<double> stiffness{}; ///< dF/ddepth where the force first reaches 1 N [N/m]
  double energy = 0.0; ///< work of the law's force on the way to the largest depth [J]
  Contact deepest{};   ///< where it was deepest: place, depth, thickness, curvature
};

/// Finds presses in samples as they come. A lift of less than 20 ms is a bounce of the same press.
class PressFinder
{
public:
  void add(const Sample& sample);

  /// Also the one that goes on, whose end is not known yet.
  [[nodiscard]] const std::vector<PressSummary>& presses() const noexcept
  {
    return presses_;
  }
  /// Whether the newest sample belongs to a press.
  [[nodiscard]] bool isOpen() const noexcept
  {
    return isOpen_;
  }

private:
  std::vector<PressSummary> presses_;
  Sample last_; // that touched, of the press
  bool isOpen_ = false;
};

/// Names a press that has none, by its place in the order, from 0: "press 1".
[[nodiscard]] std::string pressName(std::size_t index);

/// The rules of validity that the deepest contact breaks, in words; empty when all hold.
[[nodiscard]] std::string outsideLimits(const Validity& validity, const PressSummary& press);

/// The presses of a recording, with its names.
[[nodiscard]] std::vector<PressSummary> findPresses(const Recording& recording);

/// Writes presses.csv: one row per press, with tool and law. The same recording gives the same
/// bytes.
void writePresses(std::ostream& out, const Recording& recording);

/// The same into a file.
/// @throws Error  BadFile: cannot be written
void writePresses(const std::filesystem::path& file, const Recording& recording);

} // namespace palp
