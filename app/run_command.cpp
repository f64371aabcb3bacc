#include "app/commands.h"
#include "app/data_files.h"
#include "app/headless.h"
#include "app/ledger.h"
#include "app/program.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace palp
{
namespace
{

struct RunOptions
{
  PressOptions press;
  std::filesystem::path path;
  std::filesystem::path out;
  std::string size = "1280x960";
  bool noPicture = false;
  bool chain = false;
};

void run(const RunOptions& options, const Pictures* pictures)
{
  if (!options.noPicture && !pictures)
  {
    becomeSibling("palp-draw");
  }
  const ImageSize size = parseSize(options.size, "--size");
  const bool bundled = options.press.file.empty();
  if (options.path.empty() && !bundled)
  {
    throw Error(ErrorCode::BadValue,
      "--path: missing; give a CSV time_s,x_mm,y_mm,z_mm[,ax,ay,az] in the frame of the surface");
  }
  const std::filesystem::path path =
    options.path.empty() ? dataFile("paths/liver_press.csv") : options.path;
  ScenePlan plan{ .meshes = meshesOf(options.press),
    .press = options.press,
    .device = "path:" + path.string(),
    .window = false,
    .picture = !options.noPicture,
    .size = size };
  if (options.noPicture)
  {
    plan.curves.clear();
  }
  Ledger silent(false);
  playPlan(plan, options.chain, options.out, pictures, silent);
}

} // namespace

void addRunCommand(CLI::App& app, const Pictures* pictures)
{
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand(
    "run", "Press along a recorded path, without a display: data, picture and curves");
  options->press.addTo(*command);
  command->add_option("--path", options->path,
    "CSV time_s,x_mm,y_mm,z_mm[,ax,ay,az]: the tool's apex in the frame of FILE, and the unit "
    "vector from handle to apex (the inward surface normal where it is missing)");
  command->add_option("--out", options->out, "Directory for samples.csv, deformed.vtp and pictures")
    ->required();
  command->add_option("--size", options->size, "Size of press.png")->capture_default_str();
  command->add_flag("--chain", options->chain,
    "Send the force through the safety chain of the paper's device: 4 N, armed from the start");
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->footer("The path is played in simulated time, one row of samples.csv per millisecond.\n"
                  "Examples:\n"
                  "  palp run --out out                                  the bundled liver\n"
                  "  palp run block.stl --path press.csv --out out --tip cone:45deg:10mm");
  command->callback([options, pictures] { run(*options, pictures); });
}

} // namespace palp
