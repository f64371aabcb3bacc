#include "app/commands/commands.h"
#include "app/input/law_options.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/press_places.h"
#include "app/input/quantity.h"
#include "app/input/scene_plan.h"
#include "app/map/map_files.h"
#include "app/press/recording.h"
#include "app/program/interrupt.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>

namespace palp
{
namespace
{

struct MapOptions
{
  MeshSource mesh{ .bundled = "liver" };
  PressOptions press;
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

void makeMap(const MapOptions& options)
{
  const MapRequest request = requestOf(options);
  checkExists(options.mesh);
  const auto output =
    openOutput(options.out, { kMapTable, kMapSurface }, options.overwrite, { options.mesh.file });
  const Interrupt interrupt([&output] { output->discard(); });
  Scene scene;
  scene.law = options.press.tissue.law();
  scene.rule = options.press.contact;
  const SceneBody body = loadBody({ options.mesh });
  for (const std::string& note : body.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  scene.surface = body.haptic;
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
  writeMap(output->stage(), map, body, true);
  output->publish();
  tell(map, options.out);
}

} // namespace

void addMapCommand(CLI::App& app)
{
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand(
    "map", "Press at places spread evenly over a surface: its stiffness as CSV and as colors");
  options->mesh.addTo(*command);
  options->press.addTo(*command);
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
    "Each place is pressed at rest, as palp run --at does at its deepest; the stiffness is "
    "dF/ddepth\nthere. Where the tool does not get as deep, force and stiffness are empty.\n"
    "Examples:\n"
    "  palp map --out map                                  the bundled liver, 5 mm deep\n"
    "  palp map liver.stl --depth 3mm --spacing 5mm --tip sphere:6mm --law corrected --out map");
  command->callback([options] { makeMap(*options); });
}

} // namespace palp
