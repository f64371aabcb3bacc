#include "app/commands/commands.h"
#include "app/curves/force_curve.h"
#include "app/folder/export_folder.h"
#include "app/folder/export_option.h"
#include "app/folder/played_plan.h"
#include "app/headless/headless.h"
#include "app/input/option_values.h"
#include "app/places/fiducial_file.h"
#include "app/program/build_trace.h"
#include "app/program/data_files.h"
#include "app/program/exec_program.h"
#include "app/program/output.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>

namespace palp
{
namespace
{

struct RunOptions
{
  MeshSource mesh{ .bundled = "liver" };
  PressOptions press;
  PlaceOptions places;
  std::filesystem::path path;
  std::filesystem::path out;
  ImageSize size;
  std::vector<std::string> plots{ "force-time", "force-depth" };
  std::vector<std::string> plotFiles; // png where none is named
  std::vector<std::string> movies;
  std::vector<std::filesystem::path> references;
  bool refined = false;
  bool noPicture = false;
  bool chain = false;
  bool allSamples = false;
  bool samplesOnly = false;
  bool overwrite = false;
};

// an option without effect is a mistake that nobody would see
void checkUsed(const RunOptions& options, const ScenePlan& plan)
{
  if (!options.references.empty() && !plan.has(PlotKind::Comparison))
  {
    throw Error(ErrorCode::BadValue,
      "--reference: stands in the comparison only; add --plots comparison, or leave it out");
  }
  if (!options.plotFiles.empty() && !plan.has(PlotKind::Comparison) &&
    !plan.has(PlotKind::Section) && !plan.has(PlotKind::Extent))
  {
    throw Error(ErrorCode::BadValue,
      "--plot-files: says how section, comparison and extent are written; add one to --plots, or "
      "leave it out");
  }
}

// the places of --at and of --points, or the path; one of both
void addMotion(ScenePlan& plan, const RunOptions& options)
{
  PlacedPresses presses = options.places.presses;
  if (!options.places.points.empty())
  {
    Fiducials points = readFiducials(options.places.points);
    plan.sources.push_back(options.places.points);
    std::ranges::move(points.places, std::back_inserter(presses.places));
    if (points.unplaced > 0)
    {
      std::cerr << "palp: " << options.places.points.string() << ": "
                << counted(points.unplaced, "point") << " without a place left out\n";
    }
  }
  if (!presses.places.empty())
  {
    plan.presses = presses;
    return;
  }
  if (options.places.isSpoken)
  {
    throw Error(ErrorCode::BadValue,
      "--depth, --speed, --toward: say how --at and --points press; give a place, or leave them "
      "out");
  }
  if (options.mesh.file.extension() == ".json")
  {
    throw Error(ErrorCode::BadValue,
      options.mesh.file.string() +
        ": is a scene, not a surface; give it to palp scene, or its whole folder to palp run");
  }
  if (options.path.empty() && options.mesh.bundled.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--at: nothing says where to press; give --at x,y,z in mm, --points, or --path with a CSV "
      "time_s,x_mm,y_mm,z_mm[,ax,ay,az] in the frame of the surface");
  }
  const std::filesystem::path path =
    options.path.empty() ? dataFile("paths/liver_press.csv") : options.path;
  plan.device = parseDevice("path:" + path.string());
}

// of names that the option has checked
template <typename Kind>
std::vector<Kind> kindsOf(
  const std::vector<std::string>& chosen, const std::vector<std::string>& names)
{
  std::vector<Kind> kinds;
  kinds.reserve(chosen.size());
  for (const std::string& name : chosen)
  {
    kinds.push_back(static_cast<Kind>(std::ranges::find(names, name) - names.begin()));
  }
  return kinds;
}

// an export folder once more
void repeat(const RunOptions& options, const Renderer* pictures)
{
  ExportFolder made = readExport(options.mesh.file);
  made.plan.movies = kindsOf<MovieKind>(options.movies, kMovieNames);
  if (made.plan.window)
  {
    throw Error(ErrorCode::BadValue,
      made.folder.string() + ": its scene opens a window; use palp view, or palp scene");
  }
  if (made.plan.draws() && !pictures)
  {
    execProgram("palp-draw");
  }
  BuildTrace silent(false);
  Outputs outputs;
  OutputFolder& output =
    outputs.open(options.out, exportFiles(), options.overwrite, inputsOf(made.plan));
  playPlan(made.plan, output, pictures, silent, &made);
}

bool draws(const RunOptions& options)
{
  return !options.noPicture && !options.samplesOnly;
}

ScenePlan planOf(const RunOptions& options)
{
  checkExists(options.mesh);
  checkMap(options.mesh, options.press.tissue.options);
  ScenePlan plan{ .meshes = { options.mesh },
    .press = options.press,
    .device = {},
    .chain = options.chain,
    .window = false,
    .plots = {},
    .plotFiles = options.plotFiles.empty() ? std::vector<std::string>{ "png" } : options.plotFiles,
    .allSamples = options.allSamples,
    .refined = options.refined,
    .picture = draws(options),
    .movies = kindsOf<MovieKind>(options.movies, kMovieNames),
    .size = options.size };
  if (options.samplesOnly)
  {
    plan.deformed = false;
    plan.press.dent.surface = DentSurface::None;
  }
  addMotion(plan, options);
  plan.referenceFiles = options.references;
  std::ranges::transform(options.references, std::back_inserter(plan.references), readForceCurve);
  if (draws(options))
  {
    plan.plots = kindsOf<PlotKind>(options.plots, kPlotNames);
  }
  checkUsed(options, plan);
  return plan;
}

void run(const RunOptions& options, const Renderer* pictures)
{
  if (draws(options) && !pictures)
  {
    execProgram("palp-draw");
  }
  const ScenePlan plan = planOf(options);
  BuildTrace silent(false);
  Outputs outputs;
  OutputFolder& output =
    outputs.open(options.out, exportFiles(), options.overwrite, inputsOf(plan));
  playPlan(plan, output, pictures, silent);
}

// what is drawn and kept of a press
void addOutputs(CLI::App& command, RunOptions& options)
{
  command
    .add_option("--plots", options.plots,
      "Curves to draw, like section,comparison: force-time and force-depth; section (a cut through "
      "the deepest contact); comparison (force over depth of the laws, this press, finite elements "
      "and --reference); extent (R_d over depth)")
    ->delimiter(',')
    ->check(CLI::IsMember(kPlotNames))
    ->capture_default_str();
  command
    .add_option("--plot-files", options.plotFiles,
      "Kinds of files for section, comparison and extent: png, svg, pdf, csv; png if none")
    ->delimiter(',')
    ->check(CLI::IsMember({ "png", "svg", "pdf", "csv" }));
  command
    .add_option("--movie", options.movies,
      "Movies to draw, by ffmpeg as .mp4, or where it is missing as .ogv: replay (of the press, as "
      "long as it took), turntable (around its deepest moment)")
    ->delimiter(',')
    ->check(CLI::IsMember(kMovieNames));
  command.add_option("--reference", options.references,
    "CSV with columns depth_mm and force_N for the comparison, from elsewhere or Palp's own (palp "
    "force, samples.csv); several are allowed");
  command.add_flag("--chain", options.chain,
    "Send the force through the safety chain of the paper's device: 4 N, armed from the start");
  command.add_flag(
    "--all-samples", options.allSamples, "Keep in samples.csv also the samples without contact");
  command.add_flag("--refined", options.refined,
    "Divide the triangles of the dent in deformed.vtp until they follow it to 0.01 mm");
  command.add_flag("--no-picture", options.noPicture, "Write the data only")
    ->excludes("--plots")
    ->excludes("--movie");
  command
    .add_flag("--samples-only", options.samplesOnly,
      "Write the samples only: the force, neither dent nor picture, in a tenth of the time")
    ->excludes("--plots")
    ->excludes("--movie")
    ->excludes("--refined");
}

} // namespace

void addRunCommand(CLI::App& app, const Renderer* pictures, Work work)
{
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand(
    "run", "Press at places or along a path, without a display: data, picture and curves");
  options->mesh.addTo(*command);
  options->press.addTo(*command);
  addStiffness(*command, options->mesh.stiffness);
  addOrganFile(*command, options->mesh);
  options->places.addTo(*command);
  command
    ->add_option("--path", options->path,
      "CSV time_s,x_mm,y_mm,z_mm[,ax,ay,az]: the tool's apex in the coordinates of FILE (LPS for "
      "NIfTI: x and y of a RAS viewer change sign), and the unit vector from handle to apex (the "
      "inward surface normal where it is missing); or a samples.csv that was exported")
    ->excludes("--at")
    ->excludes("--points");
  command
    ->add_option(
      "--out", options->out, "Directory for scene, samples, presses, deformed mesh and pictures")
    ->required();
  addOverwrite(*command, options->overwrite);
  addParsed(*command, "--size", "Size of press.png", "1280x960",
    [options = options.get()](const std::string& text)
    { options->size = parseSize(text, "--size"); });
  addOutputs(*command, *options);
  command->footer(
    "The tool is moved in simulated time, one row of samples.csv per millisecond.\n"
    "FILE may be a folder that palp run or the window has exported: it is repeated, and "
    "compared to the byte.\n"
    "Examples:\n"
    "  palp run --out out                                  the bundled liver\n"
    "  palp run liver.stl --at -48.5,38.4,39.5 --depth 5mm --out out\n"
    "  palp run out --out again                            the same once more\n"
    "  palp run out --movie replay,turntable --out again   with two movies\n"
    "  palp run block.stl --path press.csv --out out --tip cone:45deg:10mm\n"
    "  palp run --out out --plots section,comparison --plot-files png,csv");
  command->callback(
    [options, pictures, command, work]
    {
      if (work == Work::Check)
      {
        (void)planOf(*options);
        (void)options->press.tissue.law();
        return;
      }
      if (isWholeExport(options->mesh.file))
      {
        refuseBeside(*command, options->mesh.file, { "FILE", "--out", "--overwrite", "--movie" });
        repeat(*options, pictures);
        return;
      }
      run(*options, pictures);
    });
}

} // namespace palp
