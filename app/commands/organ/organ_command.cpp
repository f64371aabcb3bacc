#include "app/commands/organ/organ_command.h"
#include "app/commands/organ/organ_file.h"
#include "app/commands/organ/organ_place.h"
#include "app/input/mesh_file.h"
#include "app/input/option_values.h"
#include "app/input/press_options.h"
#include "app/input/press_places.h"
#include "app/input/quantity.h"
#include "app/places/fiducial_file.h"
#include "app/places/placed_press.h"
#include "app/press/body.h"
#include "app/program/output.h"
#include "app/stiffness/stiffness_text.h"
#include "app/supports/support_region.h"
#include "app/supports/support_text.h"
#include "calibration/figures/table.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/force/linear/half_space.h"
#include "haptics/surface/ray.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

using namespace units::literals;
using units::toMillimeters;

struct OrganOptions
{
  MeshSource mesh{ .bundled = "liver" };
  Tip tip = SphereTip{ .radius = 10.0_mm };
  double young = 50.0_kPa;
  double poisson = 0.33; // as where it is pressed
  double cell = 4.0_mm;
  std::vector<std::string> supports;
  std::vector<std::string> places;
  std::filesystem::path points;
  Range depths;
  std::filesystem::path out;
  bool overwrite = false;
};

std::vector<Support> supportsOf(const OrganOptions& options, const Surface& surface)
{
  const FindRegion find = readRegions(options.mesh, options.supports);
  std::vector<Support> supports;
  for (const std::string& text : options.supports)
  {
    supports.push_back(parseSupport(text, surface, find));
  }
  return supports;
}

std::vector<PressPlace> placesOf(const OrganOptions& options)
{
  std::vector<PressPlace> places;
  for (const std::string& text : options.places)
  {
    places.push_back(parsePlace(text));
  }
  if (!options.points.empty())
  {
    const std::vector<PressPlace> listed = readFiducials(options.points).places;
    places.insert(places.end(), listed.begin(), listed.end());
  }
  if (places.empty())
  {
    throw Error(ErrorCode::BadValue, "no place to press; give --at x,y,z in mm, or --points LIST");
  }
  return places;
}

// what is pressed, and on what it rests
struct PressedBody
{
  const Surface& surface;
  std::vector<Support> supports;
  OrganModel model;
};

// the law of a linear body that has this shape
Scene sceneOf(const OrganOptions& options, const SceneBody& body)
{
  constexpr double kMost = 1e6; // [N]
  LawSettings settings;
  settings.mode = LawMode::Corrected;
  settings.constitution = ConstitutiveModel::Linear;
  Scene scene;
  scene.surface = body.haptic;
  scene.law = ForceLaw(options.tip, makeMaterial(options.young, options.poisson), settings);
  scene.forceLimit = kMost;
  return scene;
}

// each depth has a remark of its own
SurfacePoint pointAt(const PressPlace& place, const Scene& scene)
{
  constexpr double kLightly = 1e-6; // [m]
  return pressedPoint(place, { .depth = kLightly }, scene);
}

// deeper than a press goes, straight down
ToolPose poseAt(
  const PressPlace& place, const SurfacePoint& point, double depth, const Scene& scene)
{
  const double thickness = rayExit(scene.surface->tree(), point.position, -point.normal).distance;
  return depth > 0.5 * thickness
    ? ToolPose{ .apex = point.position - depth * point.normal, .axis = -point.normal }
    : pressedPose(place, { .depth = depth }, scene);
}

void addRows(const OrganOptions& options, const PressedBody& pressed, const Scene& scene,
  const PressPlace& at, figures::Table& table)
{
  const SurfacePoint point = pointAt(at, scene);
  (void)poseAt(at, point, options.depths.si.back(), scene); // says best why a place is none
  const OrganPlace place(pressed.model, pressed.supports, scene, point);
  const HalfSpace law(options.tip);
  std::vector<std::vector<figures::Cell>> rows; // all of the place, or none
  for (const double depth : options.depths.si)
  {
    if (depth > 0.0)
    {
      const OrganPlace::Answer answer = place.at(poseAt(at, point, depth, place.scene()));
      rows.push_back({ toMillimeters(point.position.x()), toMillimeters(point.position.y()),
        toMillimeters(point.position.z()), answer.body.constant, answer.body.slope,
        toMillimeters(depth), answer.force, pressed.model.contactModulus() * law(depth).force,
        toMillimeters(answer.local), answer.remark });
    }
  }
  std::ranges::move(rows, std::back_inserter(table.rows));
}

// a place without an answer does not keep the others from theirs
void tell(const OrganOptions& options, const PressedBody& pressed, const Scene& scene,
  const std::vector<PressPlace>& places)
{
  figures::Table table{ .name = "organ",
    .caption = "A body in series with the contact",
    .columns = { "x_mm", "y_mm", "z_mm", "constant_per_m", "slope_per_m2", "depth_mm", "force_N",
      "half_space_N", "local_depth_mm", "remark" } };
  std::optional<Error> unanswered;
  for (const PressPlace& place : places)
  {
    try
    {
      addRows(options, pressed, scene, place, table);
    }
    catch (const Error& error)
    {
      unanswered ? void(std::cerr << "palp: " << unanswered->what() << '\n') : void();
      unanswered = error;
    }
  }
  constexpr int kShown = 5; // digits
  table.rows.empty() ? void() : void(std::cout << figures::csv(table, kShown));
  if (unanswered)
  {
    throw Error(*unanswered);
  }
}

void runOrgan(const OrganOptions& options)
{
  const bool isFile = !options.out.empty();
  const std::vector<PressPlace> places = isFile ? std::vector<PressPlace>{} : placesOf(options);
  if (constexpr double most = 0.4999; options.poisson > most)
  {
    throw Error(ErrorCode::BadValue, "--poisson: no element of 0.5 gives way; give at most 0.4999");
  }
  if (!isFile && options.mesh.stiffness.isGiven())
  {
    throw Error(ErrorCode::BadValue,
      "--stiffness: give --out, and press the file by palp run, which feels the map beside it");
  }
  checkExists(options.mesh);
  std::optional<Interrupt> interrupt;
  if (isFile)
  {
    interrupt.emplace(); // before readers have threads
    interrupt->endWhatDoesNotStop(kNoPlaceYet);
  }
  const SceneBody body = loadBody({ options.mesh });
  std::vector<std::string> notes = body.notes;
  noteAxes(options.supports, spaceOf(body.files), notes);
  for (const std::string& note : notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  if (isFile)
  {
    makeOrganFile({ .out = options.out,
                    .supports = options.supports,
                    .young = options.young,
                    .poisson = options.poisson,
                    .cell = options.cell,
                    .overwrite = options.overwrite },
      body, supportsOf(options, *body.haptic), *interrupt);
    return;
  }
  const Scene scene = sceneOf(options, body);
  for (const PressPlace& place : places)
  {
    (void)pointAt(place, scene); // before any work
  }
  const std::vector<Support> supports = supportsOf(options, *body.haptic);
  const PressedBody pressed{ *body.haptic, supports,
    { *body.haptic, options.cell, options.young, options.poisson, supports } };
  std::cerr << "palp: " << inWords(pressed.model) << '\n';
  tell(options, pressed, scene, places);
}

Range parseDepths(const std::string& text)
{
  Range depths = parseRange(text, Quantity::Length, "--depth");
  if (depths.si.front() < 0.0)
  {
    throw Error(ErrorCode::BadValue,
      "--depth: '" + text + "' begins above the surface; give depths of 0 or more");
  }
  return depths;
}

constexpr const char* kFooter =
  "What palp run --organ --law corrected --material linear feels, solved around places only:\n"
  "the contact in series with the body's own compliance, by finite elements in cubes that its\n"
  "surface cuts: linear, frictionless. constant and slope: E* of --young times what the body\n"
  "adds. By cubes of 4 mm bonded slabs of 20 to 50 mm come out within 1.2 %\n"
  "of the exact layer, lobes and edges 8 mm away within 4 %. remark: on a support; too deep\n"
  "beyond half of the thickness; contact too wide where its radius is more than the distance to\n"
  "an edge or half of what is below, or the body leans its pressure by a third of that aside;\n"
  "cells too large where what is below is less than two, or than 3.5 with nothing to hold it\n"
  "behind; edge where one is nearer than two cells; else the names of the rules that a press\n"
  "breaks there, as in samples.csv. With --out the same everywhere, at a thousand places or\n"
  "more, some minutes.\n"
  "Examples:\n"
  "  palp organ --support posterior --cell 6mm --out liver.organ\n"
  "  palp organ --support ligaments --support hilum --cell 6mm --out hanging.organ\n"
  "  palp organ liver.stl --support bonded:direction:0,1,0:60deg --at -48.5,38.4,39.5\n"
  "  palp organ lobe.stl --support bonded:box:30,-60,-40:40,60,10 --at 0,0,0 --depth 1:6:1mm\n"
  "  palp organ ct.nii.gz --label 5 --support bonded:label:10 --out liver.organ";

} // namespace

void addOrganCommand(CLI::App& app)
{
  auto options = std::make_shared<OrganOptions>();
  OrganOptions* all = options.get();
  CLI::App* command = app.add_subcommand(
    "organ", "Tell the force where the whole body gives way: edges, lobes and what it rests on");
  options->mesh.addTo(*command);
  command
    ->add_option("--support", options->supports,
      "Where it rests, may be given again: bonded:box:X0,Y0,Z0:X1,Y1,Z1 in mm, "
      "bonded:direction:X,Y,Z:30deg where the surface faces so with nothing of the body before it, "
      "bonded:label:7 where it touches another label of its image, or bonded:points:FILE where it "
      "was painted, x_mm,y_mm,z_mm in its frame; sliding holds across it only. Of a liver in LPS "
      "also posterior (faces the back "
      "within 60deg), ligaments (back and head, 30deg), hilum (20 mm around the middle of what "
      "faces the feet), bonded or sliding:posterior")
    ->required()
    ->allow_extra_args(false);
  const auto add = [&](const char* name, const char* what, const char* usual, auto take)
  { return addParsed(*command, name, what, usual, take); };
  CLI::Option* out = command->add_option("--out", options->out,
    "Write what the body gives way all over its surface to this file, for --organ of run, view and "
    "scenes; goes on where it was interrupted");
  addOverwrite(*command, options->overwrite);
  command->add_option("--at", options->places, "A place x,y,z in mm; may be given again")
    ->allow_extra_args(false)
    ->excludes(out);
  command->add_option("--points", options->points, "More places: a list of 3D Slicer")
    ->excludes(out);
  addTip(*command, options->tip, "sphere:10mm");
  const auto depths = [all](const std::string& text) { all->depths = parseDepths(text); };
  depths("1:5:1mm");
  add("--depth", "Depths A:B:STEP of the contact, below the even surface there; both ends included",
    "1:5:1mm", depths);
  add("--young", "Young's modulus E", "50kPa",
    [all](const std::string& text) {
      all->young = parseWithin(text, Quantity::Pressure, { 1.0, 1e12, "1Pa to 1TPa" }, "--young");
    });
  addPoisson(*command, options->poisson);
  addStiffness(*command, options->mesh.stiffness);
  add("--cell", "Side of the cells of the body; twice this is as near as an edge is known", "4mm",
    [all](const std::string& text) {
      all->cell = parseWithin(text, Quantity::Length, { 0.1_mm, 0.1, "0.1mm to 100mm" }, "--cell");
    });
  command->footer(kFooter);
  command->callback([options] { runOrgan(*options); });
}

} // namespace palp
