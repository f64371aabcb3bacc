#include "app/commands/train/train_command.h"

#include "app/folder/export_folder.h"
#include "app/folder/export_option.h"
#include "app/folder/played_plan.h"
#include "app/folder/view_options.h"
#include "app/headless/headless.h"
#include "app/input/option_values.h"
#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/program/output.h"
#include "app/scene/scene_file.h"
#include "app/train/curriculum.h"
#include "app/train/training_text.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/number_table.h"

#include <CLI/CLI.hpp>

#include <array>
#include <memory>
#include <random>

namespace palp
{
namespace
{

struct TrainOptions
{
  MeshSource mesh{ .bundled = "liver" };
  PressOptions press;
  TrainingPlan training;
  DeviceChoice device;
  std::filesystem::path path;
  std::filesystem::path marks;
  std::filesystem::path out;
  bool overwrite = false;
};

// @param end  of the path [s]
std::vector<double> readMarks(const std::filesystem::path& file, double end)
{
  std::vector<double> marks;
  for (const auto& [values, line] : NumberTable::readColumns(file, std::array{ "time_s" }).rows)
  {
    if (!(values[0] >= 0.0 && values[0] <= end))
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + "a mark is not within the path, from 0 to " + shortest(end) +
          " s; give its seconds");
    }
    marks.push_back(values[0]);
  }
  return marks;
}

ScenePlan planOf(const TrainOptions& options)
{
  const bool isScene = options.mesh.file.extension() == ".json";
  ScenePlan plan = isScene
    ? readScene(options.mesh.file.string())
    : ScenePlan{ .meshes = { options.mesh }, .press = options.press, .device = options.device };
  checkExists(plan.meshes.front());
  if (!plan.organs.empty())
  {
    throw Error(ErrorCode::BadValue,
      options.mesh.file.string() +
        ": is a scene of organs; a training hides nodules in one body: give one with meshes");
  }
  plan.training = options.training;
  if (options.path.empty())
  {
    plan.window = true;
    plan.plots = plan.records() ? plan.plots : ScenePlan{}.plots; // whose samples are graded
    plan.presses.reset();
    plan.recording.reset();
    return plan;
  }
  plan.device = parseDevice("path:" + options.path.string());
  plan.samples = true;
  plan.window = plan.validity = plan.deformed = plan.picture = false;
  plan.plots.clear();
  plan.sources.push_back(options.marks);
  plan.training->marks = readMarks(options.marks, readPath(options.path).duration());
  return plan;
}

void checkTogether(const TrainOptions& options)
{
  const bool isHeadless = !options.path.empty();
  if (isHeadless != !options.marks.empty() || isHeadless != !options.out.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--path, --marks, --out: grade a search that was recorded; give all three, or none to search "
      "in the window");
  }
  (void)shippedCurriculum().level(options.training.level);
}

void play(const ScenePlan& plan, const TrainOptions& options, const Renderer* pictures,
  const ExportFolder* made)
{
  if (plan.draws() && !pictures)
  {
    execProgram("palp-draw");
  }
  BuildTrace silent(false);
  Outputs outputs;
  OutputFolder& output =
    outputs.open(options.out, exportFiles(), options.overwrite, inputsOf(plan));
  playPlan(plan, output, pictures, silent, made);
}

void repeat(const TrainOptions& options, const Renderer* pictures)
{
  const ExportFolder made = readExport(options.mesh.file);
  if (!made.plan.training || !made.plan.training->marks)
  {
    throw Error(ErrorCode::BadValue,
      made.folder.string() + ": holds no training that was graded; use palp run, or palp view");
  }
  if (options.out.empty())
  {
    throw Error(ErrorCode::BadValue, "--out: missing; give the folder for the repetition");
  }
  play(made.plan, options, pictures, &made);
}

void addSearch(CLI::App& command, TrainOptions& options)
{
  TrainingPlan& training = options.training;
  command
    .add_option("--difficulty", training.level,
      "Level: easy, medium, hard or expert; from large, shallow, hard nodules to small, deep, soft")
    ->capture_default_str();
  addParsed(command, "--seed",
    "From which the places of the nodules follow, 0 to 4294967295; any in the window", "1",
    [&](const std::string& text) { training.seed = parseSeed(text); });
  addParsed(command, "--nodules", "How many, 1 to 12; as many as the level has if none", "",
    [&](const std::string& text) { training.nodules = parseNoduleCount(text); });
  addParsed(command, "--side",
    "x,y,z: outward, of what is searched, within 60 degrees; that which the window shows at first",
    "-0.35,-1,0.75",
    [&](const std::string& text) { training.side = parseDirection(text, "--side"); });
  addParsed(command, "--device", "That searches in the window, as in palp view", "mouse",
    [&](const std::string& text) { options.device = parseDevice(text); });
  command.add_option("--path", options.path,
    "CSV of a search without a window: time_s,x_mm,y_mm,z_mm[,ax,ay,az], as in palp run");
  command.add_option("--marks", options.marks,
    "CSV with a column time_s: when the place that was touched last was marked");
  command.add_option("--out", options.out,
    "Folder for score.json, score.csv, score.html and all that repeats the search");
  addOverwrite(command, options.overwrite);
}

void run(const CLI::App& command, TrainOptions& options, const Renderer* pictures,
  int (*view)(const ViewOptions&))
{
  if (isWholeExport(options.mesh.file))
  {
    refuseBeside(command, options.mesh.file, { "FILE", "--out", "--overwrite" });
    repeat(options, pictures);
    return;
  }
  checkTogether(options);
  if (options.path.empty() && command.count("--seed") == 0)
  {
    options.training.seed = std::random_device()(); // the same nodules were found once
  }
  if (command.count("--tissue") + command.count("--young") == 0)
  {
    const double poisson = options.press.tissue.poisson;
    options.press.tissue.take("healthy_liver");
    options.press.tissue.poisson =
      command.count("--poisson") > 0 ? poisson : options.press.tissue.poisson;
  }
  const ScenePlan plan = planOf(options);
  (void)plan.press.tissue.law();
  if (!plan.window)
  {
    play(plan, options, pictures, nullptr);
    return;
  }
  if (!view)
  {
    execProgram("palp-view");
  }
  throw CLI::RuntimeError(view({ .plan = plan }));
}

} // namespace

void addTrainCommand(CLI::App& app, const Renderer* pictures, int (*view)(const ViewOptions&))
{
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command =
    app.add_subcommand("train", "Find hidden nodules by touch alone, and be graded");
  options->mesh.addTo(*command);
  options->press.addTo(*command);
  options->press.tissue.options.offerCorrectedAlone(*command);
  command->get_option("--young")
    ->description("Young's modulus E, 1Pa to 10GPa")
    ->default_str("that of healthy_liver");
  addSearch(*command, *options);
  command->footer(
    "Press, feel or read where the force rises, mark with M; Finish grades and shows the nodules.\n"
    "The tissue is healthy liver where none is named. FILE may also be a scene with one body, or\n"
    "the folder of a graded search, which is repeated and compared to the byte.\n"
    "Examples:\n"
    "  palp train                                       the bundled liver, level easy\n"
    "  palp train --difficulty hard --seed 42\n"
    "  palp train --path scan.csv --marks marks.csv --out graded\n"
    "  palp train graded --out again");
  command->callback(
    [options, pictures, view, command] { run(*command, *options, pictures, view); });
}

} // namespace palp
