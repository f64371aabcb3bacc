#include "app/supports/support_region.h"

#include "app/input/press_options.h"
#include "haptics/error.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/label_names.h"
#include "pipeline/surface_io/length_unit.h"
#include "pipeline/surface_io/surface_io.h"

#include <vtkPolyData.h>

#include <map>
#include <utility>

namespace palp
{
namespace
{

SupportRegion readRegion(const MeshSource& mesh, const std::string& label)
{
  constexpr double kBeside = 1.5; // voxels, for both surfaces are smoothed
  ImagePart part = mesh.part;
  part.labels = valuesOfLabels({ label }, part.names);
  const bool isAround = part.labels == std::vector<std::string>{ "0" };
  if (isAround || part.labels == valuesOfLabels(mesh.part.labels, part.names))
  {
    throw Error(ErrorCode::BadValue,
      "--support: label:" + label + " is " +
        (isAround ? "what is around all organs" : "the organ itself") +
        ", on which it does not rest; give that of another organ of the image");
  }
  part.components = ImagePart::kAllComponents;
  const FileOrgan organ = readFileOrgans(mesh.file, part, false).organs.front();
  const LoadedSurface loaded = madeReady(organ.surface, mesh.file, mesh.unit);
  return { std::make_shared<const Surface>(pointsOf(*loaded.mesh), trianglesOf(*loaded.mesh)),
    kBeside * unitLength(loaded.unit) * organ.voxel };
}

} // namespace

FindRegion readRegions(const MeshSource& mesh, const std::vector<std::string>& supports)
{
  if (mesh.part.labels.empty())
  {
    return {};
  }
  std::map<std::string, SupportRegion> regions;
  for (const std::string& support : supports)
  {
    if (const std::string label = labelOfSupport(support);
        !label.empty() && !regions.contains(label))
    {
      regions.emplace(label, readRegion(mesh, label));
    }
  }
  return [regions = std::move(regions)](const std::string& label) { return regions.at(label); };
}

} // namespace palp
