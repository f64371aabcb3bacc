#pragma once

#include "haptics/force/force_law.h"
#include "haptics/force/series/compliance_field.h"
#include "haptics/numerics/cubic_spline.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace palp
{

/// What a tool is answered by a contact in series with the body that it is on.
struct SeriesResponse
{
  Response felt;         ///< stiffness as felt, with the body
  double local = 0.0;    ///< depth of the tool in the body, without what the body gives way [m]
  bool isBeyond = false; ///< a support is too near for so large a contact
};

/// A contact of one tool in series with the compliance of a body.
///
/// The complementary energy over E* of a force f = F/E* is that of the contact and
/// f^2/2 G0 + 4/15 tr A int a^2 f df, less what the pressure gains by moving to the stiffer side,
/// f^2 (b x / (1 + x/D) - x^2 / (2 q)), the most for any x up to half of the contact radius a(f) on
/// a half-space. q = 4/3 a^3, whatever the tip: a body that leans by b f turns its pressure by the
/// moment 4/3 E* a^3 b f of a punch in the contact. A sphere stays one as it turns, deep in the
/// body, too: q = R f. The depth is the derivative by the force; the lateral force is that along
/// the surface.
///
/// @source moment: Johnson, "Contact Mechanics", Cambridge 1985, Sec. 3.5 (tilted punch); to the
///         second order the contact stays the circle that it is
class SeriesLaw
{
public:
  /// @param tip      that is pressed
  /// @param modulus  E* that the bodies are told by [Pa]
  SeriesLaw(const Tip& tip, double modulus);

  /// @param contact  callable as Response(double depth) noexcept: the contact by itself; its force
  ///                 grows with the depth
  /// @param depth    of the tool [m]
  /// @realtime       pure; no allocation, no lock, no exception; as the contact
  template <typename Contact>
  [[nodiscard]] SeriesResponse operator()(
    const Contact& contact, const BodyCompliance& body, double depth) const noexcept
  {
    if (!(depth > 0.0 && std::isfinite(depth)))
    {
      return {};
    }
    const Response first = contact(depth);
    const Yield most = yieldOf(first.force / modulus_, body);
    Try last{ depth, first, 1.0 + first.stiffness / modulus_ * most.slope };
    if (!(last.slope > kLeast))
    {
      return halved(contact, body, depth);
    }
    double local = most.depth > 0.0 ? start(first, most, depth) : depth - most.depth / last.slope;
    for (int i = 0; i < kMostSteps; ++i)
    {
      const Response felt = contact(local);
      const Yield yield = yieldOf(felt.force / modulus_, body);
      const Try here{ local, felt, 1.0 + felt.stiffness / modulus_ * yield.slope };
      const double step = (depth - local - yield.depth) / here.slope;
      if (!(here.slope > kLeast) || !(local + step > 0.0))
      {
        break;
      }
      if (step * step * std::abs(local - last.local) < kNear * local * local * local)
      {
        return here.toward(last, step);
      }
      last = here;
      local += step;
    }
    return halved(contact, body, depth);
  }

  /// E* that the bodies are told by [Pa].
  [[nodiscard]] double modulus() const noexcept
  {
    return modulus_;
  }

  /// By which part of the contact's radius the pressure would move to the stiffer side [-]; what
  /// rolls by more than a third of it is no longer told by the first terms about its center.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] double aside(const BodyCompliance& body, double force) const noexcept;

  /// A force on a body, as all that is told of it begins with.
  struct Loaded
  {
    double force;   ///< over E* [m^2]
    double widened; ///< int a^2 f df [m^6]
    double aside;   ///< by which the pressure moves, x [m]
    double less;    ///< that costs the contact, x^2 / (2 q) [1/m]
  };

  /// @param force  at which the contact is held [N]
  /// @realtime     pure; no allocation, no lock, no exception; the next likewise
  [[nodiscard]] Loaded load(const BodyCompliance& body, double force) const noexcept;

  /// What the body adds to the complementary energy [J].
  [[nodiscard]] double energy(const BodyCompliance& body, const Loaded& load) const noexcept;

  /// On the tool, toward where the body gives way more: by that energy, so that whatever the body
  /// depends on counts [N].
  ///
  /// @param load    of the body where the tool stands
  /// @param aside   the body where the tool stands a step aside, along x, y and z
  /// @param step    [m]
  [[nodiscard]] Eigen::Vector3d lateral(const BodyCompliance& here,
    const std::array<BodyCompliance, 3>& aside, double step, const Loaded& load) const noexcept;

private:
  static constexpr int kMostSteps = 8;   // one or two are usual
  static constexpr double kLeast = 0.25; // of the slope of the depth by the local depth
  static constexpr double kNear =
    1e-6; // of the depth's cube: steps to where the force errs by 1e-7

  // by which a body gives way to a force over E*, and its derivative
  struct Yield
  {
    double depth;
    double slope;
  };

  // the depth of the contact, what it answers, and how the depth of the tool grows with it
  struct Try
  {
    double local = 0.0;
    Response felt{};
    double slope = 0.0;

    // a step on, by the parabolas that have the slopes of another try, too
    [[nodiscard]] SeriesResponse toward(const Try& last, double step) const noexcept
    {
      const double between = local - last.local;
      const double part = between != 0.0 ? 1.0 / between : 0.0;
      const double stiffer = part * (felt.stiffness - last.felt.stiffness);
      const double steeper = part * (slope - last.slope);
      const double wider = part * (felt.contactRadius - last.felt.contactRadius);
      const double way = step * (1.0 - 0.5 * steeper / slope * step);
      const double force = felt.force + way * (felt.stiffness + 0.5 * stiffer * way);
      return { { std::max(0.0, force), felt.contactRadius + wider * way,
                 (felt.stiffness + stiffer * way) / (slope + steeper * way) },
        local + way, false };
    }
  };

  // of a half-space's contact at a force over E*
  struct Radius
  {
    double value; // a [m]
    double slope; // da/df
  };

  // of what the pressure gains by moving aside: the complementary energy is f^2 times the height
  struct Gain
  {
    double aside;  // x [m]
    double far;    // 1 + x/D
    double nearer; // b x / (1 + x/D) [1/m]
    double less;   // x^2 / (2 q) [1/m]
    double power;  // of the force in q
    double wider;  // of the force in x where that is held; else 0
    bool isHeld;   // by half of the contact
  };

  [[nodiscard]] Radius radiusOf(double force) const noexcept;
  [[nodiscard]] Radius radiusAt(double root) const noexcept; // of the cube root of f
  [[nodiscard]] double widenedAt(double root, double radius) const noexcept; // int a^2 f df
  // over E*, without what moving costs the contact
  [[nodiscard]] static double energyOf(const Loaded& load, const BodyCompliance& body) noexcept;
  [[nodiscard]] Gain gainOf(
    double force, const Radius& width, const BodyCompliance& body) const noexcept;
  [[nodiscard]] Yield yieldOf(double force, const BodyCompliance& body) const noexcept;
  [[nodiscard]] double start(const Response& first, const Yield& most, double depth) const noexcept;

  // where steps do not get there: over a near support, whose pull has an end
  template <typename Contact>
  [[nodiscard]] SeriesResponse halved(
    const Contact& contact, const BodyCompliance& body, double depth) const noexcept
  {
    const auto at = [&](double local)
    {
      const Response here = contact(local);
      const Yield yield = yieldOf(here.force / modulus_, body);
      return std::array{ local + yield.depth, 1.0 + here.stiffness / modulus_ * yield.slope };
    };
    constexpr int kBisections = 40;
    constexpr double kOutermost = 4.0; // of the depth
    double low = 0.0;
    double high = kOutermost * depth;
    for (int i = 0; i < kBisections; ++i)
    {
      const double middle = 0.5 * (low + high);
      const auto [reached, slope] = at(middle);
      (reached < depth && slope > kLeast ? low : high) = middle;
    }
    const auto [reached, slope] = at(low);
    const Response here = contact(low);
    constexpr double kMissed = 1e-6;
    const bool isBeyond = reached < depth * (1.0 - kMissed);
    // on a line from there on, as steep as it is
    const double further = isBeyond ? (depth - reached) / kLeast : 0.0;
    return { { here.force + here.stiffness * further, here.contactRadius,
               here.stiffness / std::max(kLeast, slope) },
      low + further, isBeyond };
  }

  double modulus_; // E* [Pa]
  bool isSphere_;
  double round_;    // radius of the tip at its apex [m]; 0: sharp or flat
  SplineAxis axis_; // of the cube root of f
  std::optional<CubicSpline> radii_;
  std::optional<CubicSpline> widened_;
};

} // namespace palp
