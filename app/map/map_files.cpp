#include "app/map/map_files.h"

#include "app/input/law_options.h"
#include "app/input/tip_text.h"
#include "app/press/export.h"
#include "app/press/recording.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/replace_file.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

void writeHeader(std::ostream& out, const StiffnessMap& map, const SceneBody& body)
{
  const ForceLaw& law = map.scene.law;
  out << "# palp " << PALP_VERSION << '\n' << "# surface: " << body.name << '\n';
  for (const MeshFile& file : body.files)
  {
    out << "# SHA-256 of " << file.name << ": " << file.sha256 << '\n';
  }
  out << "# tool: " << describeTip(law.tip()) << '\n'
      << "# tissue: E " << shortest(units::toKilopascals(law.material().youngModulus))
      << " kPa, nu " << shortest(law.material().poissonRatio) << '\n'
      << "# law: " << describeLaw(law.settings()) << '\n'
      << "# pressed along the inward normal, tissue that relaxes before it does, "
      << units::inMillimeters(map.asked.depth) << " deep, at places "
      << units::inMillimeters(map.asked.spacing)
      << " apart or more; force and stiffness are empty where the tool does not get as deep\n";
}

} // namespace

// normals weighted by the areas of the triangles
std::vector<SurfacePoint> surfacePoints(vtkPolyData& mesh)
{
  std::vector<SurfacePoint> points;
  for (const Eigen::Vector3d& position : pointsOf(mesh))
  {
    points.push_back({ position, Eigen::Vector3d::Zero() });
  }
  for (const Triangle& triangle : trianglesOf(mesh))
  {
    const auto corner = [&](std::size_t k) -> SurfacePoint&
    { return points[static_cast<std::size_t>(triangle[k])]; };
    const Eigen::Vector3d normal =
      (corner(1).position - corner(0).position).cross(corner(2).position - corner(0).position);
    for (std::size_t k = 0; k < 3; ++k)
    {
      corner(k).normal += normal;
    }
  }
  return points;
}

SurfaceMap colorsOf(const StiffnessMap& map, std::span<const SurfacePoint> points, bool isStale)
{
  SurfaceMap colors{ .values = vtkSmartPointer<vtkFloatArray>::New(),
    .title = isStale ? "stiffness\nof before\n[N/mm]" : "stiffness\n[N/mm]" };
  colors.values->SetName("Stiffness [N/mm]");
  colors.low = std::numeric_limits<double>::infinity();
  for (const double stiffness : stiffnessAt(map, points))
  {
    const double value = units::toNewtonsPerMillimeter(stiffness);
    colors.values->InsertNextValue(static_cast<float>(value));
    if (std::isfinite(value))
    {
      colors.low = std::min(colors.low, value);
      colors.high = std::max(colors.high, value);
    }
  }
  colors.low = std::min(colors.low, colors.high);
  return colors;
}

void writeMap(
  const std::filesystem::path& folder, const StiffnessMap& map, const SceneBody& body, bool rated)
{
  using units::toMillimeters;
  std::ostringstream out;
  writeHeader(out, map, body);
  out
    << "x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,depth_mm,force_N,stiffness_N_per_mm,thickness_mm"
    << (rated ? ",outside_limits" : "") << '\n';
  const Validity validity(map.scene.law);
  for (const MapPlace& place : map.places)
  {
    for (const double coordinate : place.point.position)
    {
      out << shortest(toMillimeters(coordinate)) << ',';
    }
    for (const double part : place.point.normal)
    {
      out << shortest(part) << ',';
    }
    if (!place.isPressed)
    {
      out << ",,," << (rated ? ",\n" : "\n");
      continue;
    }
    out << shortest(toMillimeters(place.contact.depth)) << ',' << shortest(place.response.force)
        << ',' << shortest(units::toNewtonsPerMillimeter(place.response.stiffness)) << ','
        << shortest(toMillimeters(place.contact.thickness));
    if (rated)
    {
      out << ',' << csvField(brokenNames(rulesAt(map.scene, validity, place.contact)));
    }
    out << '\n';
  }
  replaceFile(folder / kMapTable, out.view());

  const std::vector<SurfacePoint> points = surfacePoints(*body.display);
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(body.display);
  mesh->GetPointData()->AddArray(colorsOf(map, points).values);
  writeSurface(folder / kMapSurface, *mesh, spaceOf(body.files));
}

} // namespace palp
