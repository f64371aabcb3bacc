#pragma once

#include "calibration/fem/indenter.h"
#include "calibration/fem/mesh.h"
#include "haptics/force/linear/coating.h"
#include "haptics/units.h"

#include <functional>
#include <string>
#include <vector>

namespace palp::fem
{

/// Which body stands for the tissue.
enum class BodyModel
{
  Axisymmetric, ///< cylinder of equal area, fine mesh: for tables
  Block,        ///< the paper's volumetric block, square, coarse
};

/// Young's modulus that differs from place to place, alike all around the axis.
struct ModulusMap
{
  std::string words{}; ///< for people; empty: there is none
  /// By the distance from the axis and the depth [m]; above 0 [Pa].
  std::function<double(double radius, double depth)> young{};
};

/// Everything that determines a calibration.
struct Case
{
  std::string name = "case";
  double width = 0.1;   ///< of the block [m]
  double length = 0.1;  ///< [m]
  double height = 0.05; ///< [m], that of the coatings included
  Tip tip = SphereTip{ 0.01 };
  Material material{ 50e3, 0.33 };
  Coatings coatings{}; ///< on top of it; axisymmetric only
  Inclusion nodule{};  ///< on the axis; axisymmetric, without coatings
  ModulusMap map{};    ///< in the place of the material's; axisymmetric, without the others
  StrainEnergy energy = StrainEnergy::NeoHookean;
  std::vector<double> depths{}; ///< increasing [m]
  double threshold = 0.5e-3;    ///< displacement at the edge of the deformed region [m]
  BodyModel model = BodyModel::Axisymmetric;
  Base base = Base::Bonded; ///< slipping: axisymmetric only
  /// Under the tool [m], 0.01 mm to height / 5, in the block at most width / 29 as well;
  /// 0: 0.5 mm, in the block a tenth of the tool's radius where that is allowed.
  double elementSize = 0.0;
};

/// A cone gets a tangent spherical cap, as no mesh follows a sharp apex; the edge of a flat is
/// rounded, and the sides of a punch are inclined by 5 degrees. Other tools stay.
/// @param cap  radius of cap or edge [m], of an edge at most 6 % of the flat; 0: all stay
[[nodiscard]] Tip withCap(const Tip& tip, double cap);

/// @throws Error  BadValue: a geometry that cannot be computed, before any work is done
void check(const Case& study);

constexpr double kSmallestElement = units::fromMillimeters(0.01); ///< [m]

/// Under the tool, the default included [m].
[[nodiscard]] double elementSize(const Case& study);

/// Radius at which the tool is as high as it is deep [m]: no contact reaches further.
[[nodiscard]] double contactReach(const Tip& tip, double depth);

/// The undeformed body of a case.
[[nodiscard]] Body bodyOf(const Case& study);

} // namespace palp::fem
