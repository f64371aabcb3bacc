#include "app/commands/commands.h"
#include "app/input/law_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/press_places.h"
#include "app/input/quantity.h"
#include "app/input/scene_plan.h"
#include "app/map/map_files.h"
#include "app/press/recording.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "app/scene/scene_file.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

struct MapOptions
{
  MeshSource mesh{ .bundled = "liver" };
  std::string organ; // of a scene of several; empty: the only one that is pressed
  PressOptions press;
  std::vector<const CLI::Option*> ofPress; // which a scene has itself
  MapRequest request;
  std::optional<Eigen::Vector3d> center;
  std::optional<double> radius;
  std::filesystem::path out;
  bool overwrite = false;
};

double parseLength(const std::string& text, const char* what)
{
  return parseWithin(
    text, Quantity::Length, { kLeastSpacing, kMostSpacing, "0.5mm to 200mm" }, what);
}

MapRequest requestOf(const MapOptions& options)
{
  MapRequest request = options.request;
  if (options.center.has_value() != options.radius.has_value())
  {
    throw Error(
      ErrorCode::BadValue, "--around and --radius: bound the map together; give both, or neither");
  }
  if (options.center)
  {
    request.region = MapRegion{ *options.center, *options.radius };
  }
  return request;
}

void tell(const StiffnessMap& map, const std::filesystem::path& out)
{
  std::cerr << "palp: pressed " << map.pressed() << " of " << counted(map.places.size(), "place")
            << " to " << units::inMillimeters(map.asked.depth) << ": " << (out / kMapTable).string()
            << ", " << kMapSurface << '\n';
  const Validity validity(map.scene.law);
  const auto outside = std::ranges::count_if(map.places,
    [&](const MapPlace& place) {
      return place.isPressed && !brokenNames(rulesAt(map.scene, validity, place.contact)).empty();
    });
  if (outside > 0)
  {
    std::cerr << "palp: warning: at " << outside
              << " of them the law is outside its limits, column outside_limits\n";
  }
}

// what is pressed, by which law
struct MapSubject
{
  SceneBody body;
  Scene scene;
};

MapSubject subjectOf(const std::vector<MeshSource>& meshes, const PressOptions& press)
{
  MapSubject subject{ .body = loadBody(meshes), .scene = {} };
  subject.scene.law = press.tissue.law();
  subject.scene.rule = press.contact;
  subject.scene.surface = subject.body.haptic;
  feelTissue(subject.scene, subject.body);
  return subject;
}

std::size_t organIn(const ScenePlan& plan, const std::string& name)
{
  const std::vector<std::size_t> felt = feltOrgans(plan.organs);
  const auto named = std::ranges::find(plan.organs, name, &OrganPlan::name);
  if (named != plan.organs.end())
  {
    return static_cast<std::size_t>(named - plan.organs.begin());
  }
  if (name.empty() && felt.size() == 1)
  {
    return felt.front();
  }
  throw Error(ErrorCode::BadValue,
    "--pressed: " +
      (name.empty() ? std::string("the scene has several; give one")
                    : inQuotes(name) + " is none of the scene") +
      ": " + listed(plan.organs, [](const OrganPlan& organ) { return printable(organ.name); }));
}

MapSubject subjectOf(const MapOptions& options)
{
  if (lowered(options.mesh.file.extension().string()) != ".json")
  {
    checkExists(options.mesh);
    checkMap(options.mesh, options.press.tissue.options);
    if (!options.organ.empty())
    {
      throw Error(
        ErrorCode::BadValue, "--pressed: names one of a scene; give the scene's JSON as FILE");
    }
    return subjectOf({ options.mesh }, options.press);
  }
  for (const CLI::Option* option : options.ofPress)
  {
    if (option->count() > 0)
    {
      throw Error(ErrorCode::BadValue,
        option->get_name() +
          ": the scene has tool, tissue and law; leave it out, or edit the scene");
    }
  }
  const ScenePlan plan = readScene(options.mesh.file.string());
  if (plan.organs.empty() && options.organ.empty())
  {
    return subjectOf(plan.meshes, plan.press);
  }
  const std::size_t organ = organIn(plan, options.organ);
  MapSubject subject = subjectOf({ plan.meshes[organ] }, plan.organs[organ].press);
  subject.body.name = plan.organs[organ].name;
  return subject;
}

void makeMap(const MapOptions& options)
{
  const MapRequest request = requestOf(options);
  Outputs outputs;
  OutputFolder& output =
    outputs.open(options.out, { kMapTable, kMapSurface }, options.overwrite, { options.mesh.file });
  const auto& [body, scene] = subjectOf(options);
  for (const std::string& note : body.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  ProgressLine progress("places");
  const StiffnessMap map = pressMap(scene, request,
    [&progress](std::size_t done, std::size_t all)
    {
      progress(done, all);
      return true;
    });
  if (map.pressed() == 0)
  {
    throw Error(ErrorCode::BadValue,
      "the tool gets " + units::inMillimeters(request.depth) +
        " deep nowhere; give less --depth or a smaller --tip");
  }
  writeMap(output.stage(), map, body, true);
  output.publish();
  tell(map, options.out);
}

} // namespace

void addMapCommand(CLI::App& app)
{
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand(
    "map", "Press at places spread evenly over a surface: its stiffness as CSV and as colors");
  options->mesh.addTo(*command);
  command->add_option(
    "--pressed", options->organ, "Which one where FILE is a scene of several organs");
  const std::size_t others = command->get_options().size();
  options->press.addTo(*command);
  addStiffness(*command, options->mesh.stiffness);
  const std::vector<const CLI::Option*> all = std::as_const(*command).get_options();
  options->ofPress.assign(all.begin() + static_cast<std::ptrdiff_t>(others), all.end());
  addParsed(*command, "--depth", "How deep, at each place",
    quantityText(options->request.depth, Quantity::Length),
    [options = options.get()](const std::string& text)
    { options->request.depth = parsePressDepth(text); });
  addParsed(*command, "--spacing", "From each place to the next, at least",
    quantityText(options->request.spacing, Quantity::Length),
    [options = options.get()](const std::string& text)
    { options->request.spacing = parseLength(text, "--spacing"); });
  addParsed(*command, "--around", "Only places about x,y,z in mm; with --radius", "",
    [options = options.get()](const std::string& text)
    { options->center = parsePlace(text, "--around").position; })
    ->type_name("X,Y,Z");
  addParsed(*command, "--radius", "How far about --around", "",
    [options = options.get()](const std::string& text)
    { options->radius = parseLength(text, "--radius"); });
  command
    ->add_option("--out", options->out, "Directory for stiffness_map.csv and stiffness_map.vtp")
    ->required();
  addOverwrite(*command, options->overwrite);
  command->footer(
    "Each place is pressed as by palp run --at at its deepest; the stiffness is dF/ddepth there. "
    "Of\ntissue that relaxes both are those at once, before it does. Where the tool does not get "
    "as deep, force and stiffness are empty.\n"
    "Examples:\n"
    "  palp map --out map                                  the bundled liver, 5 mm deep\n"
    "  palp map liver.stl --depth 3mm --spacing 5mm --tip sphere:6mm --law corrected --out map\n"
    "  palp map organs/scene.json --pressed spleen --out map  of a scene, by its tool and tissue");
  command->callback([options] { makeMap(*options); });
}

} // namespace palp
