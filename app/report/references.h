#pragma once

#include "calibration/fem/constitutive.h"
#include "haptics/material.h"
#include "haptics/tip/tip.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace palp::report
{

/// What the paper calls soft tissue, Secs. 3.2 and 4.3.
inline constexpr Material kTissue{ .youngModulus = 50e3, .poissonRatio = 0.33 };

/// A press that programs of others have computed: a tool into a bonded block of 100 x 100 mm.
struct BlockPress
{
  std::string name;       ///< as "sphere R6 H30", sizes in mm
  Tip tip;                ///< as pressed there: a cone has a cap of 0.3 mm
  Tip sharp;              ///< as the paper's law has it
  double height;          ///< of the block [m]
  double size;            ///< R, or the radius of the cone's base [m]
  std::string table;      ///< our own calibration of it, in data/tables
  std::string neoHookean; ///< files in data/reference
  std::string linear;
  std::string corotated;
};

/// Spheres of 6 and 10 mm and the cone of 45 degrees, on blocks of 30 and 50 mm.
[[nodiscard]] const std::array<BlockPress, 4>& presses();

/// Force over depth as an independent program has it.
struct ReferenceForces
{
  std::vector<double> depths; ///< [m]
  std::vector<double> forces; ///< [N]
};

/// @throws Error  BadFile
[[nodiscard]] ReferenceForces referenceForces(const BlockPress& press, fem::StrainEnergy energy);

/// Surface of a pressed block as an independent program has it: neo-Hookean.
struct ReferenceSurface
{
  double depth;               ///< [m]
  std::vector<double> radius; ///< deformed, increasing [m]
  std::vector<double> sink;   ///< [m]

  /// Straight between points [m].
  [[nodiscard]] double sinkAt(double at) const;
};

/// @throws Error  BadFile
[[nodiscard]] std::vector<ReferenceSurface> referenceSurfaces(const BlockPress& press);

/// A range of depths in which methods are compared.
struct Regime
{
  const char* name;
  double from; ///< depth over the tool's size, beyond this
  double to;   ///< up to and with this
};

/// @source  Sec. 4.3: 7 % at 3.3 mm under a sphere of 6 mm
inline constexpr std::array kRegimes{ Regime{ "shallow", 0.0, 0.25 },
  Regime{ "JND limit", 0.25, 0.55 }, Regime{ "depth = R", 0.55, 1.0 } };

/// How far forces lie off the reference, in per cent.
struct ForceError
{
  double largest = 0.0; ///< of the largest reference force of the regime, Eq. (9)
  double rms = 0.0;     ///< the same
  double local = 0.0;   ///< largest, of the reference force at the same depth
};

/// @param forces  for each depth of the reference, of which those in the regime count; not a number
///                where a method was not tried
[[nodiscard]] ForceError forceError(const ReferenceForces& reference,
  std::span<const double> forces, const Regime& regime, double size);

/// Whether a depth belongs to a regime.
[[nodiscard]] bool isIn(const Regime& regime, double depth, double size);

} // namespace palp::report
