#include "app/input/scene_file.h"

#include "app/input/coating_text.h"
#include "app/input/json_object.h"
#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"
#include "pipeline/surface_io/length_unit.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace palp
{
namespace
{

using namespace units::literals;

const std::vector<std::string> kOverlays{ "force-arrow", "contact-circle", "extent-circle",
  "displacement-colors", "readings", "pressure-colors", "validity-colors", "control-net",
  "ghost" }; // in the order of Overlay
static_assert(kOverlayCount == 9);
const std::vector<std::string> kExports{ "samples", "deformed", "picture", "refined" };

// the message of an option, "--young: what", told of a place in the document instead; a place that
// ends in a slash goes on with the option's name
template <typename Check>
void checkAt(const JsonObject& object, std::string path, Check check)
{
  try
  {
    check();
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    const std::size_t end = message.starts_with("--") ? message.find(": ") : 0;
    if (path.ends_with('/'))
    {
      path = end > 0 ? path + message.substr(2, end - 2) : path.substr(0, path.size() - 1);
    }
    object.refuse(path, message.substr(end > 0 ? end + 2 : 0));
  }
}

// what stands under a key, if anything does, through the parser of its option
template <typename Parse>
void parseAt(JsonObject& object, const char* key, Parse parse,
  std::string (JsonObject::*read)(const char*, const std::string&) = &JsonObject::text)
{
  if (object.has(key))
  {
    const std::string text = (object.*read)(key, "");
    checkAt(object, key, [&] { parse(text); });
  }
}

Eigen::Vector3d triple(JsonObject& object, const char* key, Quantity quantity, const Bounds& bounds)
{
  const std::vector<std::string> words = object.texts(key, {});
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  if (words.empty())
  {
    return value;
  }
  if (words.size() != 3)
  {
    object.refuse(key, "must be three quantities, along or about x, y and z");
  }
  checkAt(object, key,
    [&]
    {
      for (int i = 0; i < 3; ++i)
      {
        value[i] = parseWithin(words[static_cast<std::size_t>(i)], quantity, bounds, "--entry");
      }
    });
  return value;
}

Eigen::Isometry3d readFrame(JsonObject object)
{
  const Eigen::Vector3d origin =
    triple(object, "origin", Quantity::Length, { -10.0, 10.0, "-10m to 10m" }); // as far as a path
  const Eigen::Vector3d angles =
    triple(object, "rotation", Quantity::Angle, { -360.0_deg, 360.0_deg, "-360deg to 360deg" });
  object.finish();
  using Turn = Eigen::AngleAxisd;
  return Eigen::Translation3d(origin) * Turn(angles.z(), Eigen::Vector3d::UnitZ()) *
    Turn(angles.y(), Eigen::Vector3d::UnitY()) * Turn(angles.x(), Eigen::Vector3d::UnitX());
}

MeshSource readMesh(JsonObject object, const std::filesystem::path& folder)
{
  MeshSource mesh;
  mesh.bundled = object.text("bundled", "");
  if (mesh.bundled.find('/') != std::string::npos)
  {
    object.refuse("bundled", "is the name of a bundled surface, as in liver; give a path as file");
  }
  const std::string file = object.text("file", "");
  parseAt(
    object, "level",
    [&](const std::string& text) { mesh.part.level = parseNumber(text, "--level"); },
    &JsonObject::number);
  parseAt(
    object, "label",
    [&](const std::string& text) { mesh.part.labels = parseNumbers(text, "--label"); },
    &JsonObject::number);
  parseAt(object, "unit", [&](const std::string& text) { mesh.unit = parseUnit(text); });
  mesh.frame = readFrame(object.object("frame"));
  object.finish();
  if (mesh.bundled.empty() == file.empty())
  {
    object.refuse("file", "give either a file or the name of a bundled surface");
  }
  if (mesh.part.level && !mesh.part.labels.empty())
  {
    object.refuse("label", "both are given, level and label; give the one or the other");
  }
  mesh.file = file.empty() ? std::filesystem::path{} : (folder / file).lexically_normal();
  return mesh;
}

void readTissue(JsonObject object, PressOptions& press)
{
  TissueOptions& tissue = press.tissue;
  parseAt(object, "coating",
    [&](const std::string& text) { tissue.options.coatings = parseCoatings(text); });
  parseAt(object, "young",
    [&](const std::string& text)
    { tissue.young = parseQuantity(text, Quantity::Pressure, "--young"); });
  parseAt(
    object, "poisson",
    [&](const std::string& text) { tissue.poisson = parseNumber(text, "--poisson"); },
    &JsonObject::number);
  parseAt(object, "damping", [&](const std::string& text) { press.damping = parseDamping(text); });
  object.finish();
}

// one word for a value of an enumeration
template <typename Enum>
void readChoice(JsonObject& object, const char* key, const Words& words, Enum& value)
{
  if (object.has(key))
  {
    value = static_cast<Enum>(object.choice(key, object.text(key, ""), words));
  }
}

void readLaw(JsonObject object, ScenePlan& plan)
{
  LawOptions& law = plan.press.tissue.options;
  readChoice(object, "mode", kLawModes, law.mode);
  readChoice(object, "base", kBases, law.base);
  readChoice(object, "material", kMaterials, law.constitution);
  readChoice(object, "contact", kContactRules, plan.press.contact);
  plan.validity = object.flag("validity", plan.window);
  object.finish();
}

void readDent(JsonObject object, ScenePlan& plan, const std::filesystem::path& folder)
{
  DentOptions& dent = plan.press.dent;
  Words surfaces = kDentSurfaces;
  surfaces.emplace_back("none");
  readChoice(object, "surface", surfaces, dent.surface);
  const std::string table = object.text("table", "");
  parseAt(object, "layer", [&](const std::string& text) { dent.layer = parseLayer(text); });
  parseAt(
    object, "threshold", [&](const std::string& text) { dent.threshold = parseThreshold(text); });
  object.finish();
  dent.table = table.empty() ? std::filesystem::path{} : (folder / table).lexically_normal();
}

// words of a list as what they stand for
template <typename Kind>
std::vector<Kind> kinds(JsonObject& object, const char* key, const std::vector<std::string>& words)
{
  std::vector<Kind> list;
  for (const std::string& word : object.texts(key, {}))
  {
    list.push_back(static_cast<Kind>(object.choice(key, word, words)));
  }
  return list;
}

void readExports(JsonObject& object, ScenePlan& plan)
{
  const auto wanted = kinds<int>(object, "exports", kExports);
  const auto has = [&](int which)
  { return std::find(wanted.begin(), wanted.end(), which) != wanted.end(); };
  plan.samples = has(0);
  plan.refined = has(3);
  plan.deformed = has(1) || plan.refined;
  plan.picture = has(2);
  const std::string size = object.text("size", "1280x960");
  checkAt(object, "size", [&] { plan.size = parseSize(size, "--size"); });
}

void readDevice(JsonObject& object, ScenePlan& plan, const std::filesystem::path& folder)
{
  const std::string name = object.text("device", "mouse");
  plan.device = parseDevice(name);
  const bool scripted = plan.device.isScript();
  if (scripted && plan.device.file.empty())
  {
    object.refuse("device", inQuotes(name) + " names no file; write " + name + "FILE.csv");
  }
  if (scripted)
  {
    plan.device = parseDevice(
      name.substr(0, name.find(':') + 1) + (folder / plan.device.file).lexically_normal().string());
  }
  plan.deadMan = object.flag("dead_man", false);
  plan.window = object.flag("window", !scripted);
  if (!plan.window && !scripted)
  {
    object.refuse("window", inQuotes(plan.device.name) + " moves in a window only; give true");
  }
}

// what stands in one part and is needed by another
void checkTogether(const JsonObject& object, const ScenePlan& plan)
{
  if (!plan.dents() && (plan.window || plan.deformed || plan.picture))
  {
    object.refuse("dent",
      "'none' leaves nothing to see; leave the window and the exports deformed and picture out");
  }
  if (!plan.dents() && (plan.has(PlotKind::Section) || plan.has(PlotKind::Extent)))
  {
    object.refuse("plots", "section and extent show the dent; leave them out, or name a surface");
  }
  if (plan.window && (plan.samples || plan.deformed || plan.picture))
  {
    object.refuse("exports", "a window exports when asked, from its File menu; leave this out");
  }
  if (!plan.window && !plan.samples && !plan.deformed && !plan.draws())
  {
    object.refuse("exports", "nothing would be left of the press; give samples, for one");
  }
}

ScenePlan readPlan(JsonObject object, const std::filesystem::path& folder)
{
  ScenePlan plan;
  if (!object.isNumber("palp_scene", 1.0))
  {
    object.refuse("palp_scene", "must be 1, the version of scenes that this program reads");
  }
  (void)object.text("$schema", "");
  plan.name = object.text("title", "");
  std::vector<MeshSource> meshes;
  for (const JsonObject& mesh : object.objects("meshes"))
  {
    meshes.push_back(readMesh(mesh, folder));
  }
  plan.meshes = meshes;
  readDevice(object, plan, folder); // first: what follows depends on the window
  readTissue(object.object("tissue"), plan.press);
  parseAt(object, "tool", [&](const std::string& text) { plan.press.tissue.tip = parseTip(text); });
  readLaw(object.object("law"), plan);
  readDent(object.object("dent"), plan, folder);
  if (object.has("overlays"))
  {
    plan.overlays = kinds<Overlay>(object, "overlays", kOverlays);
  }
  plan.plots = kinds<PlotKind>(object, "plots", kPlotNames);
  readExports(object, plan);
  object.finish();
  if (meshes.empty())
  {
    object.refuse("meshes", R"(give at least one surface, as in [{"bundled": "liver"}])");
  }

  plan.press.tissue.options.rated = plan.validity;
  checkAt(object, "tissue/", [&] { (void)plan.press.tissue.law(); });
  checkTogether(object, plan);
  return plan;
}

std::string shippedScenes()
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(dataFile("scenes")))
  {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".json") && !name.ends_with(".schema.json"))
    {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names)
  {
    text.append(text.empty() ? "" : ", ").append(name);
  }
  return text;
}

} // namespace

ScenePlan parseScene(const std::string& text, const std::filesystem::path& file)
{
  const std::string name = file.filename().string();
  const nlohmann::json document = parseJson(text, name);
  ScenePlan plan = readPlan({ document, name }, file.parent_path());
  if (plan.name.empty())
  {
    plan.name = name;
  }
  return plan;
}

ScenePlan readScene(const std::string& name)
{
  std::filesystem::path file = name;
  if (!std::filesystem::exists(file) && !name.ends_with(".json"))
  {
    file = dataFile("scenes") / (name + ".json");
  }
  if (!std::filesystem::exists(file))
  {
    throw Error(ErrorCode::BadFile,
      name + ": cannot be read; give a scene file or a shipped scene: " + shippedScenes());
  }
  return parseScene(readText(file, "a scene file"), file);
}

} // namespace palp
