#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// What was told to an arm along one axis and where it was, exchange by exchange.
struct Swing
{
  std::vector<double> sent; ///< when each force went out, ascending [s]
  std::vector<std::array<double, 3>>
    force;                      ///< along the axis, then the others; held until the next [N]
  std::vector<double> time;     ///< of the position that came back, ascending [s]
  std::vector<double> position; ///< [m]
};

/// A mass with viscous and Coulomb friction under a constant load.
struct SwingModel
{
  double mass = 0.0;     ///< [kg]
  double damping = 0.0;  ///< [N s/m]
  double friction = 0.0; ///< [N]
  double load = 0.0;     ///< as of its weight [N]
  double delay = 0.0;    ///< of the force [s], of 0 to 8 ms
  double residual = 0.0; ///< of the forces, root mean square over their own
};

/// Fits m x'' + b x' + f sign(x') + c = (F + p G + q H)(t - d) to swings of one axis, with G and H
/// along the others: of an arm whose axes are coupled they move this one, too, and what holds them
/// in the middle would be taken for damping.
///
/// In its weak form: multiplied by sin^2 over windows in which the motion keeps its direction, and
/// integrated by parts, so that no position is differentiated; linear in all but the delay, which
/// is looked for in steps of 0.25 ms. No window holds an exchange that came late: its times are not
/// to be believed.
///
/// @param step   of the encoder [m]
/// @param delay  where it is known from elsewhere, as from other axes [s]
/// @return      zeros where there are fewer than eight windows
/// @source      modulating functions: Shinbrot, Trans. ASME 79, 1957
[[nodiscard]] SwingModel fitSwings(
  std::span<const Swing> swings, double step, std::optional<double> delay = std::nullopt);

/// Part of the exchanges that took 1.5 times as long as half of them and 0.5 ms more.
[[nodiscard]] double lateShare(std::span<const Swing> swings);

} // namespace palp
