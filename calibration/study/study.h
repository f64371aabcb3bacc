#pragma once

#include "calibration/fem/indenter.h"
#include "calibration/fem/mesh.h"
#include "haptics/files/output_folder.h"
#include "haptics/force/linear/coating.h"

#include <functional>
#include <memory>
#include <stop_token>
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
  Energy energy = Energy::NeoHookean;
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

/// Under the tool, the default included [m].
[[nodiscard]] double elementSize(const Case& study);

/// The undeformed body of a case.
[[nodiscard]] Body bodyOf(const Case& study);

/// R_d at the deformed position [m]: where the surface is lowered by the threshold; 0 where
/// nothing sinks that far, the outermost radius where everything does.
/// @source  Sec. 3.3.2
[[nodiscard]] double extentRadius(
  const std::vector<IndentationStep::Point>& profile, double threshold);

/// Depth of the surface below rest at a deformed radius, straight between points [m].
[[nodiscard]] double sinkOf(const IndentationStep& pressed, double radius);

/// How a calibration went.
struct Outcome
{
  std::vector<IndentationStep> steps; ///< one for each depth that was reached and not refused
  std::string error;                  ///< empty, or why depths are missing
  std::vector<double> refused{};      ///< depths whose force depends on the mesh [m]
};

/// The names of all files that a calibration, with its pictures, may leave.
[[nodiscard]] std::vector<std::string> calibrationFiles();

/// Halving the elements changes no force that is kept by more than this, by the estimate of
/// MeshCheck, which takes about a quarter of the time.
constexpr double kMeshError = 0.01;

/// Asked after every depth.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// Presses through all depths; where no solution is found, the depths so far remain.
/// @throws Error  BadValue: see check
[[nodiscard]] Outcome calibrate(
  const Case& study, const std::stop_token& stop = {}, const Progress& progress = {});

/// The same with files, and with every force checked by a mesh twice as coarse; a depth that fails
/// is pressed again on elements of a half to an eighth of the size. After every depth,
/// table.csv, profiles.csv, fit.json and a checkpoint are complete in the folder, whatever happens
/// next.
///
/// @param folder  stays locked; an earlier calibration in it goes when the first depth is reached
/// @param resume  go on from the folder's checkpoint, if there is one; the depths that are in the
///                table stay there, whether they are asked for again or not
/// @throws Error  BadFile: not writable, or the checkpoint is of another case, or past a depth that
///                is asked for and not in the table
[[nodiscard]] Outcome calibrateInto(OutputFolder& folder, const Case& study, bool resume,
  const std::stop_token& stop = {}, const Progress& progress = {});

/// Several cases at a time, each into its folder; a case that fails leaves the others.
///
/// @param folders  one for each case, see calibrateInto
/// @param jobs  how many at a time, 1 or more; never more than there are cases or cores
/// @param tell  called with a case's name and its failure (empty: none), one call at a time
void sweep(const std::vector<std::unique_ptr<OutputFolder>>& folders,
  const std::vector<Case>& cases, bool resume, unsigned jobs, const std::stop_token& stop,
  const std::function<void(const std::string& name, const std::string& failure)>& tell);

} // namespace palp::fem
