#include "app/check/checked_surface.h"

#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/program/progress_line.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <algorithm>
#include <array>
#include <vtkPolyData.h>

namespace palp
{

CheckedSurface checkFile(const std::filesystem::path& file, UnitChoice unit, const ImagePart& part)
{
  FileSurface read = readFileSurface(file, part);
  const LoadedSurface loaded = madeReady(read, file, unit);
  CheckedSurface checked{ .file = file,
    .points = std::move(read.points),
    .triangles = std::move(read.triangles),
    .space = read.space,
    .notes = loaded.notes };
  for (Eigen::Vector3d& point : checked.points)
  {
    point *= unitLength(loaded.unit);
  }
  const ProgressLine progress("looking for faults");
  checked.health = healthOf(checked.points, checked.triangles);
  return checked;
}

CheckedSurface checkOpened(const MeshSource& source, const MeshFile& opened)
{
  const std::filesystem::path file = source.feltFile();
  const auto refuse = [&](const char* what)
  { throw Error(ErrorCode::BadFile, printable(file.string()) + ": " + what); };
  if (!std::filesystem::exists(file))
  {
    refuse("is there no longer, to be checked; bring it back, or open another one");
  }
  const FileStamps before = stampsOf(file);
  if (describeFile(file).sha256 != opened.sha256)
  {
    refuse("is another file than the one that is open; open it again to check it");
  }
  CheckedSurface checked =
    checkFile(file, source.unit, source.haptic.empty() ? source.part : ImagePart{});
  checkUnchanged(file, before);
  return checked;
}

CheckedRepair repairedSurface(const CheckedSurface& checked, double largestHole)
{
  const ProgressLine progress("repairing");
  RepairedMesh mesh = repairedMesh(checked.points, checked.triangles, largestHole);
  MeshHealth health = healthOf(mesh.points, mesh.triangles);
  return { std::move(mesh), std::move(health) };
}

void writeRepaired(
  const std::filesystem::path& file, const CheckedRepair& repaired, const CheckedSurface& checked)
{
  writeSurface(file, *makePolyData(repaired.mesh.points, repaired.mesh.triangles), checked.space);
}

void checkRepairName(const std::filesystem::path& file)
{
  constexpr std::array kinds{ ".vtp", ".stl", ".ply", ".obj" };
  if (std::ranges::count(kinds, file.extension().string()) == 0)
  {
    throw Error(ErrorCode::BadValue,
      printable(file.string()) +
        ": not a kind of file written here; give .vtp, .stl, .ply or .obj");
  }
}

double parseLargestHole(const std::string& text, const std::string& name)
{
  return parseWithin(text, Quantity::Length, { 0.0, 10.0, "0mm to 10m" }, name);
}

} // namespace palp
