#pragma once

#include "haptics/force/series/compliance_field.h"
#include "haptics/force/series/organ_motion.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// What `palp organ` finds of a body: its compliance at places all over its surface, in the frame
/// of its file.
struct OrganTable
{
  static constexpr int kVersion = 3;

  std::string mesh;        ///< what it is of: SHA-256 of its file, and how that was read
  std::string supports;    ///< where it rests, as text
  std::string stiffness{}; ///< how its modulus differs from place to place, as text; empty: not
  double young = 0.0;      ///< modulus that E* is of, where it differs to given values [Pa]; 0: any
  double poisson = 0.45;
  double cell = 4e-3;    ///< side of the cubes [m]
  double spacing = 4e-3; ///< of the places [m]
  std::size_t count = 0; ///< of all places; more than there are while some are still to come
  std::vector<PlacedCompliance> places;
  OrganMotionModes motion{}; ///< at some of them; empty: not known

  [[nodiscard]] bool isComplete() const noexcept
  {
    return count > 0 && places.size() == count;
  }

  /// Puts all of it into another frame.
  void place(const Eigen::Isometry3d& frame);

  /// Whether another one is the same but for what is still to come.
  [[nodiscard]] bool continues(const OrganTable& other) const;
};

/// Replaces the file as a whole.
/// @throws Error  BadFile: cannot be written
void writeOrganTable(const std::filesystem::path& file, const OrganTable& table);

/// @throws Error  BadFile: missing, no such file or of another version, a line that is none
[[nodiscard]] OrganTable readOrganTable(const std::filesystem::path& file);

/// The compliance of a body for the servo.
/// @param mesh    that is felt, as OrganTable::mesh
/// @throws Error  BadFile: of another mesh, or not finished; else as readOrganTable
[[nodiscard]] OrganTable readOrganOf(const std::filesystem::path& file, const std::string& mesh);

} // namespace palp
