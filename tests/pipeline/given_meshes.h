#pragma once

#include "pipeline/surface_io/surface_io.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace palp::test
{

/// Those in the folder that the environment's PALP_TEST_MESHES names; none without it.
inline std::vector<std::filesystem::path> givenMeshes()
{
  std::vector<std::filesystem::path> files;
  if (const char* folder = std::getenv("PALP_TEST_MESHES"))
  {
    std::error_code failure; // of a folder that is not there
    for (const auto& entry : std::filesystem::directory_iterator(folder, failure))
    {
      if (entry.path().extension() == ".obj" || entry.path().extension() == ".stl")
      {
        files.push_back(entry.path());
      }
    }
  }
  return files;
}

/// In the unit that PALP_TEST_UNIT names, else in that which its size tells.
inline vtkSmartPointer<vtkPolyData> readGiven(const std::filesystem::path& file)
{
  const char* unit = std::getenv("PALP_TEST_UNIT");
  return readSurface(file, unit ? unitNamed(unit) : UnitChoice{}).mesh;
}

} // namespace palp::test
