#pragma once

#include "data/shapes.h"
#include "haptics/error.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/data/topology.h"
#include "tests/support/process.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <vtkPolyData.h>

namespace palp::test
{

inline Mesh meshOf(const LoadedSurface& surface)
{
  return { pointsOf(*surface.mesh), trianglesOf(*surface.mesh) };
}

inline bool mentions(const LoadedSurface& surface, const std::string& words)
{
  return std::any_of(surface.notes.begin(), surface.notes.end(),
    [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

/// Message of the error that reading gives; "taken" where it gives none.
inline std::string refusalOf(const std::filesystem::path& file, UnitChoice unit = {})
{
  try
  {
    (void)readSurface(file, unit);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "taken";
}

/// The corner that every file of sample_files.h holds.
inline void expectCorner(const LoadedSurface& surface, const std::string& text)
{
  EXPECT_TRUE(surface.closed) << text;
  EXPECT_NEAR(volume(meshOf(surface)), 0.1 * 0.1 * 0.1 / 6.0, 1e-10) << text; // single precision
}

/// Files in a folder of their own.
class Files : public testing::Test
{
protected:
  std::filesystem::path write(const std::string& name, const std::string& content)
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

  std::filesystem::path write(const std::string& name, const Mesh& mesh)
  {
    const std::filesystem::path file = folder_.path() / name;
    writeSurface(file, *makePolyData(mesh.points, mesh.triangles));
    return file;
  }

  LoadedSurface load(const std::string& name, const std::string& content, UnitChoice unit = {})
  {
    return readSurface(write(name, content), unit);
  }

  TemporaryFolder folder_;
};

using SurfaceFile = Files;

} // namespace palp::test
