#include "app/body.h"

#include "app/data_files.h"
#include "pipeline/poly_data.h"
#include "pipeline/surface_io.h"

#include <vtkPolyData.h>

namespace palp
{
namespace
{

std::shared_ptr<const Surface> surfaceOf(vtkPolyData& mesh)
{
  return std::make_shared<const Surface>(pointsOf(mesh), trianglesOf(mesh));
}

// sizes that tables are shipped for; beyond them the nearest one stands in
const char* bundledTable(const Tip& tip)
{
  constexpr double kBetween = 0.008; // [m], between the two radii of sphere and cone
  const bool small = baseRadius(tip) < kBetween;
  if (std::holds_alternative<ConeTip>(tip) || std::holds_alternative<BluntConeTip>(tip))
  {
    return small ? "tables/cone45_r6_h30.csv" : "tables/cone45_r10_h50.csv";
  }
  return small ? "tables/sphere_r6_h30.csv" : "tables/sphere_r10_h50.csv";
}

} // namespace

Body loadBody(const PressOptions& options)
{
  const bool bundled = options.file.empty();
  const std::filesystem::path file = bundled ? dataFile("meshes/liver.vtp") : options.file;
  LoadedSurface loaded = readSurface(file, parseUnit(options.unit));
  Body body{ .name = file.filename().string(),
    .unit = unitName(loaded.unit),
    .display = loaded.mesh,
    .haptic = nullptr,
    .notes = std::move(loaded.notes) };
  body.haptic =
    surfaceOf(bundled ? *readSurface(dataFile("meshes/liver_haptic.vtp")).mesh : *body.display);
  return body;
}

ExtentTable loadExtents(const PressOptions& options, const Tip& tip)
{
  return ExtentTable::read(options.table.empty() ? dataFile(bundledTable(tip)) : options.table);
}

} // namespace palp
