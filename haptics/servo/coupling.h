#pragma once

#include "haptics/force/force_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{

/// Energy of a force law up to a depth [J], by Gauss in the root of the depth: exact for the powers
/// 1, 3/2 and 2 of punch, sphere and cone.
///
/// @param law    callable as Response(double depth) noexcept, asked three times; what is not finite
///               counts nothing
/// @param depth  [m]
template <typename Law>
[[nodiscard]] double energyTo(const Law& law, double depth) noexcept
{
  constexpr double kSpread = 0.3872983346207417; // sqrt(0.15)
  const auto part = [&](double root, double weight)
  {
    const double force = law(depth * root * root).force;
    return std::isfinite(force) ? weight * 2.0 * root * depth * force : 0.0;
  };
  return part(0.5 - kSpread, 5.0 / 18.0) + part(0.5, 8.0 / 18.0) + part(0.5 + kSpread, 5.0 / 18.0);
}

/// A force law at one place, as a function of depth alone; borrows what it is made from.
class DepthLaw
{
public:
  /// @param ask  callable as Response(double depth) noexcept; must outlive this; where it has
  ///             energy(double depth) noexcept that is its energy, else energyTo
  template <typename Ask>
  DepthLaw(const Ask& ask) noexcept // a view, as string_view
    : ask_(&ask)
    , call_([](const void* self, double depth) noexcept
        { return (*static_cast<const Ask*>(self))(depth); })
    , energy_(
        [](const void* self, double depth) noexcept
        {
          const Ask& law = *static_cast<const Ask*>(self);
          if constexpr (requires { law.energy(depth); })
          {
            return law.energy(depth);
          }
          else
          {
            return energyTo(law, depth);
          }
        })
  {
  }

  [[nodiscard]] Response operator()(double depth) const noexcept
  {
    return call_(ask_, depth);
  }

  /// What a tool brings in on its way to a depth [J].
  [[nodiscard]] double energy(double depth) const noexcept
  {
    return energy_(ask_, depth);
  }

private:
  const void* ask_;
  Response (*call_)(const void*, double) noexcept;
  double (*energy_)(const void*, double) noexcept;
};

/// What the user feels of a law.
struct Rendered
{
  double force = 0.0;      ///< [N], at most the law's
  double stiffness = 0.0;  ///< dforce/ddepth [N/m], at most the limit
  double proxyDepth = 0.0; ///< depth at which the law gives this force [m]
  bool limited = false;    ///< the law is stiffer than the limit
  double kneeDepth = 0.0;  ///< up to which the law is felt as it is [m]
  double kneeForce = 0.0;  ///< [N]
};

/// Virtual coupling between a device and the proxy that touches the tissue.
///
/// The proxy goes with the device as long as the law is no stiffer than the limit: soft tissue is
/// felt exactly. From the depth at which the law becomes stiffer, the knee, a spring of the
/// limiting stiffness joins both, and the proxy lies where law and spring agree. The result is the
/// largest force that is nowhere stiffer than the limit and nowhere above a law whose stiffness
/// grows with depth, as that of every axisymmetric tip does; another law is followed where it falls
/// below it.
///
/// A rigid wall is a law whose force is infinite at any depth; a force that is NaN gives none.
///
/// @param law    force 0 at depth 0, never decreasing
/// @param depth  delta [m]; 0 or less, or NaN, gives no force
/// @param limit  [N/m], may be infinite; 0 or less, or NaN, gives no force
/// @source       virtual coupling: Colgate, Stanley, Brown 1995
/// @realtime     pure; at most 100 questions to the law; no allocation, no lock, no exception
[[nodiscard]] Rendered couple(const DepthLaw& law, double depth, double limit) noexcept;

/// Depth at which the coupling renders a force; the inverse of couple.
///
/// @param force  [N]
/// @param upTo   [m], where the search ends
/// @return       [m], in [0, upTo]
/// @realtime     as couple
[[nodiscard]] double depthOf(const DepthLaw& law, double force, double limit, double upTo) noexcept;

/// Energy that the coupling stores, which a hand can have back [J].
///
/// @param felt   of couple, by the same law
/// @param depth  of the same question [m]
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] double storedEnergy(const DepthLaw& law, const Rendered& felt, double depth) noexcept;

/// What the stability of a sampled loop depends on.
struct LoopDynamics
{
  double deviceDamping = 0.0;  ///< b of the mechanism [N s/m]
  double virtualDamping = 0.0; ///< B of the law [N s/m]
  double period = 0.001;       ///< T [s]
  double delay = 0.0;          ///< t_d, from pose to force beyond the tick [s]
  double friction = 0.0;       ///< f_c of the mechanism [N]
  double quantum = 0.0;        ///< q of its encoder [m]
  double scale = 1.0;          ///< motion of the tool by that of the hand
};

/// Speed at which a hand presses, for which friction is made a damping [m/s].
inline constexpr double kPressSpeed = 0.05;

/// Largest stiffness at which a sampled, delayed spring and damper comes to rest.
///
/// Stability with what is stated of device and hand, not passivity for any operator, for which
/// Colgate and Schenkel ask b > K T/2 + |B|: for B = 0 and t_d = 0 both are the same number.
/// Friction counts as the damping 4 f_c / (pi v) of its describing function at kPressSpeed, but for
/// no more than the 2 f_c / q at which it still holds a step of the encoder.
///
/// @return    (b + B) / (T / 2 + t_d) and the part of friction [N/m]
/// @source    Gil et al. 2004; Hulin, Albu-Schaeffer, Hirzinger, IEEE TCST 2014; friction and
///            quantum: Diolaiti, Niemeyer, Barbagli, Salisbury, IEEE T-RO 22(2), 2006
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr double stableStiffness(const LoopDynamics& loop) noexcept
{
  const double late = loop.period / 2.0 + loop.delay;
  const double speed = loop.scale * kPressSpeed;
  const double rubbing = 4.0 * loop.friction / (std::numbers::pi * speed) / late;
  const double held = loop.quantum > 0.0 ? 2.0 * loop.friction / loop.quantum : rubbing;
  return (loop.deviceDamping + loop.virtualDamping) / late + std::min(rubbing, held);
}

} // namespace palp
