#pragma once

#include "app/report/effort.h"
#include "app/report/references.h"
#include "calibration/baselines/stepper.h"
#include "calibration/fem/indenter.h"

namespace palp::report
{

/// Of the graphics loop, in which the paper runs elements and springs [s].
inline constexpr double kGraphicsStep = 0.02;

/// A way to get the force of a press, tried at given depths.
struct Trial
{
  std::string method;
  std::string setting;                    ///< of the method, as "h 1 mm"; empty: none
  std::string leavesOut;                  ///< what it does not know
  fem::StrainEnergy like;                 ///< the material it is made for
  std::vector<double> forces;             ///< for each depth [N]; not a number where it finds none
  std::vector<std::vector<double>> times; ///< for each depth, of repeated evaluations [us]
};

/// Laws: the paper's, the exact half-space, the corrected one, and a table of forces.
/// @throws Interrupted
[[nodiscard]] std::vector<Trial> tryLaws(
  const BlockPress& press, std::span<const double> depths, const Effort& effort);

/// Element sizes over the tool's size, coarse to fine, one for each resolution.
inline constexpr std::array kResolutions{ 1.0, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16 };

/// Our own finite elements; an evaluation is the step from the depth before.
/// @param size      of an element under the tool, over the tool's size
/// @param surfaces  takes the pressed body at each depth, where wanted
/// @throws Interrupted
[[nodiscard]] Trial tryElements(const BlockPress& press, fem::StrainEnergy energy, double size,
  std::span<const double> depths, const Effort& effort,
  std::vector<fem::IndentationStep>* surfaces = nullptr);

/// Bodies of tetrahedra and of springs stepped in time, Fig. 12, each held at a depth until its
/// force stands still; an evaluation is one step.
/// @param wanted  which of the depths are tried
/// @throws Interrupted
[[nodiscard]] Trial trySteps(const BlockPress& press, fem::Baseline baseline,
  std::span<const double> depths, const std::function<bool(double)>& wanted, const Effort& effort);

/// A surface as a method has it: distance from the axis and sink of its points [m].
using Drawn = std::vector<std::pair<double, double>>;

/// A way to get the surface under a press, tried at the depths of references.
struct SurfaceTrial
{
  std::string method;
  std::string setting;
  std::string leavesOut;
  std::vector<Drawn> surfaces;            ///< for each reference surface
  std::vector<std::vector<double>> times; ///< likewise, of repeated updates [us]
};

/// Of the plane that tryDent() draws.
inline constexpr int kDrawnSide = 101; // points along a side of the plane
inline constexpr int kDrawnPoints = kDrawnSide * kDrawnSide;

/// The dent that the window draws; an evaluation is contact, force, dent and normals.
/// @param fitted  the curve that was fitted to elements, else the paper's
/// @throws Interrupted
[[nodiscard]] SurfaceTrial tryDent(const BlockPress& press,
  std::span<const ReferenceSurface> references, bool fitted, const Effort& effort);

/// Our own neo-Hookean elements, as tryElements().
/// @throws Interrupted
[[nodiscard]] SurfaceTrial tryElementSurface(const BlockPress& press,
  std::span<const ReferenceSurface> references, double size, const Effort& effort);

/// The body of Fig. 12: 1,600 vertices on top.
[[nodiscard]] fem::TetMesh baselineBody(double height);

} // namespace palp::report
