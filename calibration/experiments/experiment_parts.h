#pragma once

#include "calibration/experiments/experiments.h"
#include "calibration/fem/indenter.h"
#include "calibration/study/study.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <limits>

// what the experiments share

namespace palp::fem::parts
{

inline constexpr Material kTissue{ .youngModulus = 50e3, .poissonRatio = 0.33 }; // Sec. 3.2
inline constexpr double kNoticed = 100.0 * Validity::kJustNoticeable;            // [%] of a force
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// step, 2 step, ... to last [m]; half as many where it is to be quick
[[nodiscard]] std::vector<double> depthSteps(double step, double last, Resolution resolution);

/// The sphere, or the 45 degree cone with a tangent cap of 0.3 mm.
[[nodiscard]] Tip tool(bool sphere, double radius);

/// The paper's block of 100 x 100 mm.
[[nodiscard]] Case paperBlock(const Tip& tip, double height, StrainEnergy energy,
  std::vector<double> depths, Resolution resolution);

/// Element size under a tool [m].
[[nodiscard]] double elementSize(const Tip& tip, Resolution resolution);

/// Presses a body as deep as solutions go; kMissing beyond [N].
[[nodiscard]] std::vector<double> forcesOn(const Body& body, const Tip& tip, StrainEnergy energy,
  const std::vector<double>& depths, const std::stop_token& stop);

/// The largest value that is there; 0 where none is.
[[nodiscard]] double largest(const std::vector<double>& values);

/// Where errors first pass a limit, on straight lines from (0, 0); infinite where they never do, or
/// not before the first that is not there.
[[nodiscard]] double passing(
  const std::vector<double>& depths, const std::vector<double>& errors, double limit);

/// Where errors first pass 7 %, in words: "at 4.1 mm", or "nowhere to 8 mm".
[[nodiscard]] std::string passesAt(
  const std::vector<double>& depths, const std::vector<double>& errors);

/// An experiment without rows.
[[nodiscard]] Experiment experimentOf(std::string name, std::vector<std::string> columns);

/// An experiment whose abscissa is the depth.
[[nodiscard]] Experiment overDepth(std::string name, const std::vector<double>& depths);

void addColumn(Experiment& experiment, std::string name, const std::vector<double>& values);

/// Begins a figure without curves; addCurve() adds to the last one.
void addFigure(Experiment& experiment, Figure figure);

/// @param curve  label, style and color
void addCurve(Experiment& experiment, Curve curve, const Points& points);

/// A column over the first one, where there are values; over the depth from (0, 0).
[[nodiscard]] Points pointsOf(const Experiment& experiment, const std::string& column);

} // namespace palp::fem::parts
