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

} // namespace palp
