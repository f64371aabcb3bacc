#include "app/scene/scene_mesh.h"

#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/scene/scene_entries.h"
#include "app/stiffness/stiffness_text.h"
#include "app/supports/support_text.h"
#include "haptics/units.h"
#include "pipeline/surface_io/length_unit.h"

#include <string>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

void readFrame(JsonObject object, MeshSource& mesh)
{
  mesh.origin = triple(object, "origin", Quantity::Length, kSceneReach);
  mesh.rotation =
    triple(object, "rotation", Quantity::Angle, { -360.0_deg, 360.0_deg, "-360deg to 360deg" });
  object.finish();
}

PlacedNodule readNodule(JsonObject object)
{
  for (const auto& [key, example] : { std::pair("center", R"(["0mm", "0mm", "-12mm"])"),
         { "radius", "\"5mm\"" }, { "ratio", "8" } })
  {
    object.has(key) ? void()
                    : object.refuse(key, std::string("is missing; give it, as in ") + example);
  }
  PlacedNodule nodule{ triple(object, "center", Quantity::Length, kSceneReach), 0.0, 0.0 };
  const std::string radius = object.text("radius", "");
  checkAt(
    object, "radius", [&] { nodule.radius = parseQuantity(radius, Quantity::Length, "--radius"); });
  const std::string ratio = object.number("ratio", "");
  checkAt(object, "ratio", [&] { nodule.ratio = parseNumber(ratio, "--ratio"); });
  object.finish();
  return nodule;
}

ImagePart readPart(JsonObject& object)
{
  ImagePart part;
  parseAt(
    object, "series", [&](const std::string& text) { part.series = text; }, &JsonObject::number);
  parseAt(
    object, "level", [&](const std::string& text) { part.level = parseNumber(text, "--level"); },
    &JsonObject::number);
  parseAt(
    object, "values", [&](const std::string& text) { part.band = parseBand(text, "--values"); });
  parseAt(
    object, "label", [&](const std::string& text) { part.labels = parseLabels(text, "--label"); },
    &JsonObject::number);
  if ((part.level ? 1 : 0) + (part.band ? 1 : 0) + (part.labels.empty() ? 0 : 1) > 1)
  {
    object.refuse("label", "more than one of level, values and label is given; give one");
  }
  return part;
}

} // namespace

MeshSource readMesh(JsonObject object, const std::filesystem::path& folder)
{
  MeshSource mesh;
  mesh.bundled = object.text("bundled", "");
  if (mesh.bundled.find('/') != std::string::npos)
  {
    object.refuse("bundled", "is the name of a bundled surface, as in liver; give a path as file");
  }
  const std::string file = object.text("file", "");
  const std::string haptic = object.text("haptic", "");
  mesh.part = readPart(object);
  parseAt(object, "unit", [&](const std::string& text) { mesh.unit = parseUnit(text); });
  readFrame(object.object("frame"), mesh);
  for (const JsonObject& nodule : object.objects("nodules"))
  {
    mesh.nodules.push_back(readNodule(nodule));
  }
  parseAt(object, "stiffness",
    [&](const std::string& text)
    {
      mesh.stiffness = parseStiffness(text);
      std::filesystem::path& map = mesh.stiffness.file;
      map = map.empty() ? map : (folder / map).lexically_normal();
    });
  if (const std::string organ = object.text("organ", ""); !organ.empty())
  {
    mesh.organ = (folder / organ).lexically_normal();
  }
  for (const std::string& text : object.texts("supports", {}))
  {
    const std::filesystem::path points = pointsOfSupport(text);
    mesh.supports.push_back(
      points.empty() ? text : withPoints(text, (folder / points).lexically_normal().string()));
  }
  object.finish();
  if (mesh.bundled.empty() == file.empty())
  {
    object.refuse("file", "give either a file or the name of a bundled surface");
  }
  if (!haptic.empty() && file.empty())
  {
    object.refuse("haptic", "is of a file; a bundled surface has its own");
  }
  mesh.haptic = haptic.empty() ? std::filesystem::path{} : (folder / haptic).lexically_normal();
  mesh.file = file.empty() ? std::filesystem::path{} : (folder / file).lexically_normal();
  return mesh;
}

} // namespace palp
