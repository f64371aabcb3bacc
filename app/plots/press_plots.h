#pragma once

#include "app/press/calibration.h"
#include "app/press/recording.h"
#include "pipeline/charts/comparison.h"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

class vtkRenderWindow;

// what both front ends, picture and window, compare a press with

namespace palp
{

using Plots = std::vector<std::unique_ptr<Plot>>; ///< one below the other

/// F(depth) of the law in use, of the paper's and of the exact one, with the 7 % band; of a press,
/// of finite elements and of others; and the differences below.
///
/// The law in use knows thickness, curvature and tilt of the deepest contact, as it did there, and
/// what the body gives way.
///
/// @param scene        of the organ that is pressed
/// @param press        its samples, in order
/// @param calibration  gives the elements; null for none
/// @param others       depth [m] and force [N]; those without points are left out
[[nodiscard]] Plots forceComparison(const Scene& scene, std::span<const Sample> press,
  const Calibration* calibration, const std::vector<ReferenceCurve>& others = {});

/// R_d(depth) of the calibration and its quadratic fit.
[[nodiscard]] Plots extentComparison(const Calibration& calibration);

/// The cut through the contact along the scene's x, or y where the surface faces x.
///
/// @param press    up to date; nothing is drawn where it does not touch
/// @param nodules  that may be seen
[[nodiscard]] Plots sectionOf(vtkPalpDeformFilter& press, const Calibration& calibration,
  std::span<const PlacedNodule> nodules);

/// Writes what a window shows of plots, in the format that the file's name ends in: png, svg, pdf,
/// or csv with all their curves.
///
/// @throws Error  BadFile: another ending, or cannot be written; NoPicture: see writePng
void writePlots(const Plots& plots, vtkRenderWindow& window, const std::filesystem::path& file);

} // namespace palp
