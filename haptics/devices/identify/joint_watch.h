#pragma once

#include "haptics/devices/driver.h"

#include <array>
#include <optional>
#include <string>

namespace palp
{

/// Finds an encoder that has died, by its own joint: of an arm whose axes are coupled the others
/// keep the handle moving, so that its place does not tell.
class JointWatch
{
public:
  /// @param time  [s]
  /// @return  what is wrong, with the joint from 1, and what to do; empty: nothing
  [[nodiscard]] std::string take(const std::optional<DriverJoints>& now, double time);

  /// After pushes along all axes, from which friction follows: as take(), of joints that have not
  /// counted yet. take() finds nothing before.
  [[nodiscard]] std::string neverCounted();

private:
  struct Joint
  {
    double angle = 0.0;     // that was counted last [rad]
    double push = 0.0;      // torque without its quick changes [N m]
    double withstood = 0.0; // largest torque before it first moved [N m]
    double largest = 0.0;   // ever [N m]
    double stands = 0.0;    // under more than it withstood, since it last counted [s]
    bool counts = false;
  };
  std::array<Joint, 3> joints_;
  std::optional<double> before_; // [s]
  bool knows_ = false;           // what the joints withstand
};

} // namespace palp
