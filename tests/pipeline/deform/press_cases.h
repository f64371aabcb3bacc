#pragma once

#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/given_meshes.h"
#include "tests/pipeline/segmented.h"
#include "tests/pipeline/surfaces.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <random>
#include <string>
#include <vector>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

namespace palp::test
{

using namespace units::literals;

inline DentedSurface dented(vtkPolyData& mesh)
{
  return dented({ pointsOf(mesh), trianglesOf(mesh) });
}

inline DentedSurface read(const std::filesystem::path& file)
{
  return dented(*readSurface(file).mesh);
}

inline DentedSurface bundled(const char* name)
{
  return read(std::filesystem::path(PALP_SHARE "/meshes") / name);
}

/// Every point moved by up to a third of an edge.
inline DentedSurface shaken(DentedSurface regular, double edge)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> by(-edge / 3.0, edge / 3.0);
  DentedSurface surface;
  for (std::size_t i = 0; i < regular.count(); ++i)
  {
    const Eigen::Vector3d point = DentedSurface::at(regular.rest, i);
    const Eigen::Vector3d normal = DentedSurface::at(regular.normals, i);
    const Eigen::Vector3d shift(by(random), by(random), by(random));
    surface.add(point + shift - 0.9 * shift.dot(normal) * normal);
  }
  surface.triangles = regular.triangles;
  surface.finish();
  return surface;
}

/// The bundled liver as a scanner would give it, 70 mm long: voxels of 1 mm, contoured, smoothed
/// and reduced, which leaves ridges sharper than the tools and triangles of all shapes.
inline DentedSurface segmented()
{
  const auto liver = readSurface(PALP_SHARE "/meshes/liver.vtp").mesh;
  vtkPoints& points = *liver->GetPoints();
  for (vtkIdType i = 0; i < points.GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point(points.GetPoint(i));
    point *= 0.3;
    points.SetPoint(i, point.data());
  }
  points.Modified();
  const auto contoured = contouredFromVoxels(*liver, 1.0_mm);
  vtkNew<vtkQuadricDecimation> reduced;
  reduced->SetInputData(contoured);
  reduced->SetTargetReduction(0.7);
  reduced->Update();
  return dented(*reduced->GetOutput());
}

/// A surface to press by its name.
struct Case
{
  std::string name;
  std::function<DentedSurface()> make;
  const char* haptic = nullptr; ///< bundled mesh to feel; else the surface itself
};

inline void PrintTo(const Case& with, std::ostream* out)
{
  *out << with.name;
}

/// Those made here, and the given meshes.
inline std::vector<Case> cases()
{
  std::vector<Case> all{
    { "liver", [] { return bundled("liver.vtp"); }, "liver_haptic.vtp" },
    { "lobe",
      [] {
        return ellipsoid(6, { 60.0_mm, 40.0_mm, 6.0_mm });
      } },
    { "irregular",
      [] {
        return shaken(ellipsoid(5, { 80.0_mm, 60.0_mm, 35.0_mm }), 2.0_mm);
      } },
    { "sheet", [] { return shaken(plane(60, 1.5_mm), 1.5_mm); } },
    { "segmented", segmented },
  };
  for (const std::filesystem::path& file : givenMeshes())
  {
    std::string name = "file_" + file.stem().string();
    std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    all.push_back({ name, [file] { return dented(*readGiven(file)); } });
  }
  return all;
}

} // namespace palp::test
