#include "app/body.h"
#include "app/commands.h"
#include "app/data_files.h"
#include "app/export.h"
#include "app/pictures.h"
#include "app/playback.h"
#include "app/program.h"
#include "app/quantity.h"
#include "app/recording.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <iostream>
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

ImageSize parseSize(const std::string& text)
{
  ImageSize size;
  const char* end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size.width);
  const bool apart = first == std::errc{} && cross != end && *cross == 'x';
  const auto [rest, second] =
    apart ? std::from_chars(cross + 1, end, size.height) : std::from_chars_result{};
  constexpr int kSmallest = 64;
  constexpr int kLargest = 8192;
  if (!apart || second != std::errc{} || rest != end ||
    std::min(size.width, size.height) < kSmallest || std::max(size.width, size.height) > kLargest)
  {
    throw Error(ErrorCode::BadValue,
      "--size: '" + text + "' is no size; write WIDTHxHEIGHT, each 64 to 8192, like 1280x960");
  }
  return size;
}

void report(const Recording& recording, const Calibration& calibration)
{
  const Sample* deepest = recording.deepest();
  if (!deepest)
  {
    std::cerr
      << "palp: the tool never touched the surface; the path may be in another frame or unit\n";
    return;
  }
  std::cerr << "palp: deepest " << units::toMillimetres(deepest->contact.depth) << " mm, force "
            << deepest->response.force << " N, contact radius "
            << units::toMillimetres(deepest->response.contactRadius) << " mm, extent radius "
            << units::toMillimetres(calibration.extents.extentRadius(deepest->contact.depth))
            << " mm\n";
  if (!calibration.covers(deepest->contact.depth))
  {
    std::cerr << "palp: R_d beyond "
              << units::toMillimetres(calibration.extents.rows().back().depth)
              << " mm is that of its table's last row\n";
  }
}

void run(const RunOptions& options, const Pictures* pictures)
{
  if (!options.noPicture && !pictures)
  {
    becomeSibling("palp-draw");
  }
  // every option is checked before any work
  const ImageSize size = parseSize(options.size);
  Recording recording;
  recording.scene.law = options.press.tissue.law();
  recording.scene.rule = options.press.rule();
  recording.scene.damping = options.press.dampingSi();
  recording.scene.forceLimit =
    options.chain ? Scene{}.forceLimit : std::numeric_limits<double>::infinity();
  const bool bundled = options.press.file.empty();
  if (options.path.empty() && !bundled)
  {
    throw Error(ErrorCode::BadValue,
      "--path: missing; give a CSV time_s,x_mm,y_mm,z_mm[,ax,ay,az] in the frame of the surface");
  }
  const std::filesystem::path path =
    options.path.empty() ? dataFile("paths/liver_press.csv") : options.path;
  const ScriptedPath script = readPath(path);
  const Calibration calibration = loadCalibration(options.press, recording.scene.law);

  const Body body = loadBody(options.press);
  for (const std::string& note : body.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  if (!calibration.note.empty())
  {
    std::cerr << "palp: " << calibration.note << '\n';
  }
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.device = "path:" + path.filename().string();
  recording.scene.surface = body.haptic;
  recording.samples = play(script, recording.scene, options.chain);
  report(recording, calibration);

  exportRecording(options.out, body, recording, calibration);
  if (!options.noPicture)
  {
    pictures->drawPress(body, recording, calibration, options.out, size);
  }
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
