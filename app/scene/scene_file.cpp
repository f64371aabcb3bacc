#include "app/scene/scene_file.h"

#include "app/curves/force_curve.h"
#include "app/input/coating_text.h"
#include "app/input/json_object.h"
#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/input/tip_text.h"
#include "app/program/data_files.h"
#include "app/scene/scene_entries.h"
#include "app/scene/scene_mesh.h"
#include "app/scene/scene_motion.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace palp
{
namespace
{

void readTissue(JsonObject object, PressOptions& press)
{
  TissueOptions& tissue = press.tissue;
  parseAt(object, "coating",
    [&](const std::string& text) { tissue.options.coatings = parseCoatings(text); });
  parseAt(object, "name", [&](const std::string& text) { tissue.take(text); }); // E and nu win
  parseAt(object, "young",
    [&](const std::string& text)
    { tissue.young = parseQuantity(text, Quantity::Pressure, "--young"); });
  parseAt(
    object, "poisson",
    [&](const std::string& text) { tissue.poisson = parseNumber(text, "--poisson"); },
    &JsonObject::number);
  parseAt(object, "relaxation",
    [&](const std::string& text) { tissue.options.relaxation = parseRelaxation(text); });
  parseAt(
    object, "friction",
    [&](const std::string& text) { tissue.options.friction = parseFriction(text); },
    &JsonObject::number);
  parseAt(object, "damping", [&](const std::string& text) { press.damping = parseDamping(text); });
  object.finish();
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

void readExports(JsonObject& object, ScenePlan& plan)
{
  const auto wanted = kinds<int>(object, "exports", kExports);
  const auto has = [&](int which)
  { return std::find(wanted.begin(), wanted.end(), which) != wanted.end(); };
  plan.allSamples = has(4);
  plan.samples = has(0) || plan.allSamples;
  plan.refined = has(3);
  plan.deformed = has(1) || plan.refined;
  plan.picture = has(2);
  const std::string size = object.text("size", "1280x960");
  checkAt(object, "size", [&] { plan.size = parseSize(size, "--size"); });
}

// of a list, where words could be taken for more than one cell of it
void checkName(const JsonObject& object, const std::string& name, const ScenePlan& plan)
{
  if (name.empty() || name.find_first_of(",\"\n\r") != name.npos)
  {
    object.refuse("name", "must be a name without commas, quotes and ends of lines, as in liver");
  }
  if (std::ranges::find(plan.organs, name, &OrganPlan::name) != plan.organs.end())
  {
    object.refuse("name", "'" + name + "' stands twice; name each organ once");
  }
}

void readOrgan(JsonObject object, ScenePlan& plan, const std::filesystem::path& folder)
{
  OrganPlan organ{ .name = object.text("name", ""), .press = plan.press };
  checkName(object, organ.name, plan);
  readChoice(object, "role", kOrganRoles, organ.role);
  parseAt(object, "color", [&](const std::string& text) { organ.color = parseColor(text); });
  readTissue(object.object("tissue"), organ.press);
  checkAt(object, "tissue/", [&] { (void)organ.press.tissue.law(); });
  plan.organs.push_back(std::move(organ));
  plan.meshes.push_back(readMesh(object, folder));
}

void readBodies(JsonObject& object, ScenePlan& plan, const std::filesystem::path& folder)
{
  plan.meshes.clear();
  for (const JsonObject& mesh : object.objects("meshes"))
  {
    plan.meshes.push_back(readMesh(mesh, folder));
  }
  if (!plan.meshes.empty() && object.has("organs"))
  {
    object.refuse("organs", "stands in place of meshes, which are one body; give one of both");
  }
  for (const JsonObject& organ : object.objects("organs"))
  {
    readOrgan(organ, plan, folder);
  }
  if (plan.meshes.empty())
  {
    object.refuse("meshes", R"(give at least one surface, as in [{"bundled": "liver"}])");
  }
  if (!plan.organs.empty() && feltOrgans(plan.organs).empty())
  {
    object.refuse("organs", "none is pressed; give one of them the role 'press'");
  }
}

void checkTraining(const JsonObject& object, const ScenePlan& plan)
{
  if (!plan.organs.empty() ||
    std::ranges::any_of(plan.meshes,
      [](const MeshSource& mesh) { return !mesh.nodules.empty() || mesh.stiffness.isGiven(); }))
  {
    object.refuse("training",
      "hides nodules in one body without any, nor a map of stiffness; give meshes without them");
  }
  if (plan.press.tissue.options.mode != LawMode::Corrected)
  {
    object.refuse("training", "takes the law 'corrected', which alone feels nodules; give it");
  }
  if (plan.window == plan.training->marks.has_value())
  {
    object.refuse("training",
      plan.window ? "has marks, which a window makes; leave them out"
                  : "has no marks, by which a press without a window is graded; give them");
  }
  if (plan.window ? !plan.records() : !plan.samples)
  {
    object.refuse("training",
      plan.window ? "is graded by samples, which only curves keep; give plots, as in force-time"
                  : "is repeated from its samples; give them in exports");
  }
}

// what stands in one part and is needed by another
void checkTogether(const JsonObject& object, const ScenePlan& plan)
{
  for (std::size_t i = 0; i < plan.meshes.size(); ++i)
  {
    const bool isOne = plan.organs.empty();
    const LawOptions& law = (isOne ? plan.press : plan.organs[i].press).tissue.options;
    const std::string key = isOne ? "meshes" : "organs/" + std::to_string(i);
    if (const std::string other = mapRefusal(plan.meshes[i], law); !other.empty())
    {
      object.refuse(key, "stiffness: " + other);
    }
    if (plan.meshes[i].nodules.empty() || (law.mode == LawMode::Corrected && law.coatings.empty()))
    {
      continue;
    }
    object.refuse(
      key, "nodules take the law 'corrected' and no coating; give these, or leave the nodules out");
  }
  plan.training ? checkTraining(object, plan) : void();
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
  readMotion(object, plan, folder); // first: what follows depends on the window
  readTissue(object.object("tissue"), plan.press);
  parseAt(object, "tool", [&](const std::string& text) { plan.press.tissue.tip = parseTip(text); });
  readLaw(object.object("law"), plan);
  readDent(object.object("dent"), plan, folder);
  plan.press.tissue.options.rated = plan.validity;
  checkAt(object, "tissue/", [&] { (void)plan.press.tissue.law(); });
  readBodies(object, plan, folder);
  if (object.has("training"))
  {
    plan.training = readTraining(object.object("training"));
  }
  if (object.has("overlays"))
  {
    plan.overlays = kinds<Overlay>(object, "overlays", kOverlays);
  }
  plan.plots = kinds<PlotKind>(object, "plots", kPlotNames);
  plan.plotFiles = object.texts("plot_files", plan.plotFiles);
  for (const std::string& ending : plan.plotFiles)
  {
    (void)object.choice("plot_files", ending, kPlotEndings);
  }
  for (const std::string& file : object.texts("references", {}))
  {
    plan.referenceFiles.push_back((folder / file).lexically_normal());
    plan.references.push_back(readForceCurve(plan.referenceFiles.back()));
  }
  if (object.has("camera"))
  {
    plan.camera = readCamera(object.object("camera"));
  }
  readExports(object, plan);
  object.finish();
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
  return listed(names);
}

} // namespace

ScenePlan parseScene(const std::string& text, const std::filesystem::path& file)
{
  const std::string name = file.filename().string();
  const nlohmann::json document = parseJson(text, name);
  return readPlan({ document, name }, file.parent_path());
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
  ScenePlan plan = parseScene(readText(file, "a scene file"), file);
  plan.sources.push_back(file);
  return plan;
}

} // namespace palp
