#include "app/stiffness/placed_map.h"

#include "app/input/scene_plan.h"
#include "haptics/files/input_text.h"
#include "haptics/surface/area_and_volume.h"
#include "haptics/surface/closest_point.h"
#include "pipeline/tissue/stiffness_source.h"

#include <cmath>
#include <limits>
#include <utility>

namespace palp
{

namespace
{

// of one part; before: of the parts before it
TissueMap placedMap(const MappedPart& part, const Surface& body, TissueMap before)
{
  const MeshSource& source = *part.source;
  const Eigen::Isometry3d toFile = source.frame().inverse();
  Eigen::AlignedBox3d box = boxAbout(part.points);
  constexpr double kMargin = 0.01; // [m] beside the body, for what lies along its border
  // a formula need not make sense beside the body
  const double margin = source.stiffness.kind == StiffnessSource::Kind::Formula ? 0.0 : kMargin;
  box.extend(box.min() - Eigen::Vector3d::Constant(margin));
  box.extend(box.max() + Eigen::Vector3d::Constant(margin));
  const auto off = [&](const Eigen::Vector3d& position)
  {
    return distanceTo(
      body.tree(), source.frame() * position, std::numeric_limits<double>::infinity());
  };
  return [map = tissueMapOf(source.stiffness, source.unit, box, off), before = std::move(before),
           toFile](const Eigen::Vector3d& position, double young)
  {
    const double known = before ? before(position, young) : std::nan("");
    return std::isnan(known) ? map(toFile * position, young) : known;
  };
}

} // namespace

TissueMap placedMap(std::span<const MappedPart> parts, const Surface& body)
{
  TissueMap map;
  for (const MappedPart& part : parts)
  {
    map = placedMap(part, body, std::move(map));
  }
  return map;
}

std::string labelsWithoutTissue(
  const std::vector<MeshSource>& sources, std::span<const Eigen::Vector3d> points)
{
  std::string text;
  for (const MeshSource& source : sources)
  {
    const StiffnessSource& map = source.stiffness;
    if (map.kind != StiffnessSource::Kind::Labels)
    {
      continue;
    }
    const Eigen::Isometry3d toFile = source.frame().inverse();
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points)
    {
      box.extend(toFile * point);
    }
    const std::string labels = otherLabels(map.file, source.unit, map.labels, box);
    text += labels.empty()
      ? ""
      : "; in " + printable(map.file.filename().string()) + " no tissue is given to " + labels;
  }
  return text;
}

} // namespace palp
