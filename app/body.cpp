#include "app/body.h"

#include "app/data_files.h"
#include "haptics/contact/deviation.h"
#include "haptics/units.h"
#include "pipeline/poly_data.h"
#include "pipeline/surface_io.h"

#include <vtkPolyData.h>

#include <iomanip>
#include <sstream>

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
  body.haptic = surfaceOf(*body.display);
  if (bundled)
  {
    const auto coarse = surfaceOf(*readSurface(dataFile("meshes/liver_haptic.vtp")).mesh);
    const Deviation apart = deviation(*body.haptic, *coarse);
    body.haptic = coarse;
    std::ostringstream note;
    note << "the force comes from " << coarse->points().size() << " points, at most "
         << std::setprecision(2) << units::toMillimetres(apart.largest) << " mm (RMS "
         << units::toMillimetres(apart.rootMeanSquare) << " mm) from the surface shown";
    body.notes.push_back(note.str());
  }
  return body;
}

} // namespace palp
