#include "app/commands/commands.h"
#include "app/commands/program.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/headless/headless.h"
#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/program/output.h"
#include "app/scene/scene_file.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace palp
{
namespace
{

struct SceneOptions
{
  std::string file;
  std::filesystem::path out = "out";
  bool explain = false;
  bool overwrite = false;
};

void run(const SceneOptions& options, const Renderer* pictures, int (*view)(const ViewOptions&))
{
  const ScenePlan plan = readScene(options.file);
  if (plan.window)
  {
    if (!view)
    {
      execProgram("palp-view");
    }
    throw CLI::RuntimeError(view({ .plan = plan, .explain = options.explain }));
  }
  if (plan.draws() && !pictures)
  {
    execProgram("palp-draw");
  }
  BuildTrace trace(options.explain);
  {
    Outputs outputs;
    OutputFolder& output =
      outputs.open(options.out, exportFiles(), options.overwrite, inputsOf(plan));
    playPlan(plan, output, pictures, trace);
  }
  if (options.explain)
  {
    trace.write(std::cout);
  }
}

} // namespace

void addSceneCommand(CLI::App& app, const Renderer* pictures, int (*view)(const ViewOptions&))
{
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command =
    app.add_subcommand("scene", "A press described by one file, built of what the file names");
  command->add_option("FILE", options->file, "Scene (JSON), or the name of a shipped one")
    ->required();
  command->add_option("--out", options->out, "Directory for the exports of a scene without window")
    ->capture_default_str();
  addOverwrite(*command, options->overwrite);
  command->add_flag("--explain", options->explain,
    "Build it, tell what was built and what left out, with cost and reason, and end");
  command->footer("data/scenes/scene.schema.json describes the file.\n"
                  "Examples:\n"
                  "  palp scene liver_mouse\n"
                  "  palp scene paper_block --out block\n"
                  "  palp scene my_scene.json --explain");
  command->callback([options, pictures, view] { run(*options, pictures, view); });
}

} // namespace palp
