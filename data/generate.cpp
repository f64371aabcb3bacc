// Makes the shipped surfaces, or the shipped path:
//   palp_generate DIRECTORY
//   palp_generate --path FILE

#include "data/liver_mesh.h"
#include "data/press_path.h"
#include "data/shapes.h"
#include "haptics/error.h"
#include "haptics/surface/decimation/decimate.h"
#include "haptics/surface/sampling/deviation.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kDisplayEdge = 2.12_mm; // about 20,000 points
constexpr std::size_t kHapticPoints = 2500;
constexpr double kBlockSpacing = 2.5_mm;

void write(const std::filesystem::path& file, const Surface& surface, const std::string& space = "")
{
  writeSurface(file, *makePolyData(surface.points(), surface.triangles()), space);
  std::cout << file.filename().string() << ": " << surface.points().size() << " points, "
            << surface.triangles().size() << " triangles\n";
}

Surface surfaceOf(Mesh mesh)
{
  return { std::move(mesh.points), std::move(mesh.triangles) };
}

void generate(const std::filesystem::path& directory)
{
  std::filesystem::create_directories(directory);
  const Surface liver = surfaceOf(makeLiver(kDisplayEdge));
  TriangleMesh coarse = decimated(liver.points(), liver.triangles(), kHapticPoints);
  const Surface haptic(std::move(coarse.points), std::move(coarse.triangles));
  write(directory / "liver.vtp", liver, "LPS");
  write(directory / "liver_haptic.vtp", haptic, "LPS");
  const Deviation apart = deviation(liver, haptic);
  std::cout << "liver_haptic.vtp: " << units::toMillimeters(apart.largest)
            << " mm from liver.vtp at most, " << units::toMillimeters(apart.rootMeanSquare)
            << " mm root mean square\n";

  const auto writeMesh = [&](const std::string& name, Mesh mesh)
  { write(directory / (name + ".vtp"), surfaceOf(std::move(mesh))); };
  writeMesh("block_50", makeBox({ 100.0_mm, 100.0_mm, 50.0_mm }, kBlockSpacing));
  writeMesh("block_30", makeBox({ 100.0_mm, 100.0_mm, 30.0_mm }, kBlockSpacing));
  writeMesh("sphere_30", makeSphere(30.0_mm, 4));
  writeMesh("sphere_50", makeSphere(50.0_mm, 5));
  writeMesh("sphere_100", makeSphere(100.0_mm, 6));
  for (int n = 40; n <= 100; n += 10)
  {
    writeMesh("grid_" + std::to_string(n), makeGrid(n, 100.0_mm));
  }
}

void writePath(const std::filesystem::path& file)
{
  std::ofstream out(file);
  out << "# A sphere of 10 mm radius presses the bundled liver 8 mm deep, slides 12 mm and lifts.\n"
         "# Made by palp_generate --path. Frame of liver.vtp: x to the left, y to the back, z to "
         "the head.\n"
         "time_s,x_mm,y_mm,z_mm,ax,ay,az\n"
      << std::fixed;
  for (const PathKnot& knot : liverPressPath())
  {
    out << std::setprecision(2) << knot.time << std::setprecision(4);
    for (const double meters : knot.apex)
    {
      out << ',' << units::toMillimeters(meters);
    }
    out << std::setprecision(6);
    for (const double component : *knot.axis)
    {
      out << ',' << component;
    }
    out << '\n';
  }
  if (!out.flush())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be written; check the folder");
  }
}

} // namespace
} // namespace palp

int main(int count, char** arguments)
{
  try
  {
    if (count == 2)
    {
      palp::generate(arguments[1]);
      return 0;
    }
    if (count == 3 && std::string(arguments[1]) == "--path")
    {
      palp::writePath(arguments[2]);
      return 0;
    }
    std::cerr << "palp_generate: give a DIRECTORY for the surfaces, or --path FILE\n";
  }
  catch (const std::exception& failure)
  {
    std::cerr << "palp_generate: " << failure.what() << '\n';
  }
  return 2;
}
