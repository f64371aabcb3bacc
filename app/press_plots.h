#pragma once

#include "app/calibration.h"
#include "haptics/servo/sample.h"
#include "pipeline/comparison.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

class vtkRenderWindow;

// what both front ends, picture and window, compare a press with

namespace palp
{

using Plots = std::vector<std::unique_ptr<Plot>>; ///< one below the other

/// Reads a curve of the user's, `depth_mm,force_N`, with the file's name.
/// @throws Error  BadFile
[[nodiscard]] ReferenceCurve readForceCurve(const std::filesystem::path& file);

/// Force over depth on the way to the deepest sample, thinned out; empty where nothing was touched.
[[nodiscard]] ReferenceCurve forceCurveOf(std::span<const Sample> samples);

/// F(depth) of the law in use, of the paper's and of the exact one, with the 7 % band; measured and
/// of finite elements; and the differences below.
///
/// @param calibration  gives the elements; null for none
/// @param references   first what was measured; those without points are left out
[[nodiscard]] Plots forceComparison(
  const ForceLaw& law, const Calibration* calibration, std::vector<ReferenceCurve> references);

/// R_d(depth) of the calibration and its quadratic fit.
[[nodiscard]] Plots extentComparison(const Calibration& calibration);

/// The cut through the contact along the scene's x, or y where the surface faces x.
///
/// @param press  up to date; nothing is drawn where it does not touch
[[nodiscard]] Plots sectionOf(vtkPalpDeformFilter& press, const Calibration& calibration);

/// Writes what a window shows of plots, in the format that the file's name ends in: png, svg, pdf,
/// or csv with all their curves.
///
/// @throws Error  BadFile: another ending, or cannot be written; NoPicture: see writePng
void writePlots(const Plots& plots, vtkRenderWindow& window, const std::filesystem::path& file);

} // namespace palp
