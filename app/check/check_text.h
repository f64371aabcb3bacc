#pragma once

#include "calibration/figures/table.h"
#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// Digits of the numbers in all of these.
inline constexpr int kCheckDigits = 5;

/// Whether a press is another where a surface has this fault.
[[nodiscard]] bool disturbs(Fault fault) noexcept;
[[nodiscard]] bool disturbs(const MeshHealth& health) noexcept;

/// One sentence on what of all faults disturbs a press.
[[nodiscard]] std::string verdictOf(const MeshHealth& health);

/// A row a fault, in the order of the findings: how many, where [mm], how long around the largest
/// hole [mm], what loading does with it, what it does in a press; empty where it does nothing.
/// @param frame  from the points that were looked at to where places are told
[[nodiscard]] figures::Table faultTable(
  const MeshHealth& health, const Eigen::Isometry3d& frame = Eigen::Isometry3d::Identity());

/// Lines on size, pieces and lengths of edges.
/// @param file  of the surface, which the first begins with
[[nodiscard]] std::vector<std::string> measuresOf(
  const MeshHealth& health, const std::filesystem::path& file);

/// What was done to a surface, and what could not be.
[[nodiscard]] std::string doneIn(const RepairedMesh& repaired);

} // namespace palp
