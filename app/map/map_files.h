#pragma once

#include "app/map/stiffness_map.h"
#include "app/press/body.h"
#include "pipeline/model/surface_map.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

inline constexpr const char* kMapTable = "stiffness_map.csv";
inline constexpr const char* kMapSurface = "stiffness_map.vtp";

/// The points of a surface that is looked at, with their normals; empty where it has no triangle.
[[nodiscard]] std::vector<SurfacePoint> surfacePoints(vtkPolyData& mesh);

/// A map as colors [N/mm] on a surface.
/// @param points  of the surface
[[nodiscard]] SurfaceMap colorsOf(
  const StiffnessMap& map, std::span<const SurfacePoint> points, bool isStale = false);

/// Writes stiffness_map.csv, a row per place, and stiffness_map.vtp, the body at rest with the
/// point array "Stiffness [N/mm]", NaN where it is unknown.
///
/// @param folder  there
/// @param rated   a column tells which rules of validity a contact breaks
/// @throws Error  BadFile: cannot be written
void writeMap(
  const std::filesystem::path& folder, const StiffnessMap& map, const SceneBody& body, bool rated);

} // namespace palp
