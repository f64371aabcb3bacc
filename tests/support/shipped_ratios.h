#pragma once

#include "haptics/force/large_strain.h"

#include <filesystem>

namespace palp::test
{

/// The shipped factors of large strain.
inline LargeStrainTable shippedRatios()
{
  const std::filesystem::path tables = std::filesystem::path(PALP_SOURCE_DIR) / "data/tables";
  return readLargeStrain(tables / "large_strain_sphere.csv", tables / "large_strain_cone.csv");
}

} // namespace palp::test
