#include "app/commands/commands.h"
#include "app/commands/program.h"
#include "app/folder/export_option.h"
#include "app/input/option_values.h"
#include "app/input/quantity.h"
#include "app/program/exec_program.h"
#include "app/stiffness/stiffness_text.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace palp
{

namespace
{

constexpr Bounds kServoRates{ 1000.0, 4000.0, "1kHz to 4kHz" };

// the window of what was exported, with the tool held as the options say
void openExport(ViewOptions& options, const std::filesystem::path& folder)
{
  options.made = readExport(folder);
  if (!options.made->plan.dents())
  {
    throw Error(ErrorCode::BadValue,
      folder.string() + ": its dent is 'none', which leaves nothing to see; name a surface there");
  }
  const ScenePlan given = std::exchange(options.plan, options.made->plan);
  options.plan.device = given.device;
  options.plan.second = given.second;
  options.plan.deadMan = given.deadMan;
  options.plan.placement = given.placement;
  options.plan.servoPeriod = given.servoPeriod;
  options.plan.window = true;
  options.plan.plots = given.plots; // without any, no sample would be kept
  options.plan.presses.reset();
  options.plan.recording.reset();
}

double numberWithin(const std::string& text, const char* option, const Bounds& bounds)
{
  const double number = parseNumber(text, option);
  if (!(number >= bounds.least && number <= bounds.most))
  {
    throw Error(ErrorCode::BadValue,
      std::string(option) + ": '" + text + "' is out of range; give " +
        std::string(bounds.inWords));
  }
  return number;
}

void addDevices(CLI::App& command, ScenePlan& plan)
{
  command
    .add_option_function<std::vector<std::string>>(
      "--device",
      [&plan](const std::vector<std::string>& names)
      {
        if (names.size() > 2)
        {
          throw Error(ErrorCode::BadValue, "--device: a scene has two hands; give one or two");
        }
        plan.device = parseDevice(names.front());
        if (names.size() == 2)
        {
          plan.second = parseDevice(names.back());
          checkHands(plan.device, *plan.second);
        }
      },
      "mouse; hand (a simulated arm that follows the mouse and yields to the force); path:FILE; "
      "replay:FILE (a samples.csv that was exported); spacemouse; spacenavd; gamepad[:PATH]; "
      "falcon[:FIRMWARE]; "
      "wooden:PATH[,ARM.conf]; phd1:PATH; haply[:PORT]; forcedimension[:LIBRARY]; "
      "openigtlink[:ADDRESS:PORT][,TOOL] (see palp devices); given twice: two hands")
    ->default_str(plan.device.name)
    ->allow_extra_args(false);
}

void addPlacement(CLI::App& command, DevicePlacement& placement)
{
  addParsed(command, "--device-scale",
    "Motion of the tool by that of the hand at a device, 0.2 to 5: above 1 a small arm reaches "
    "more "
    "of the body, and less stiff tissue can be felt; a newton stays one",
    "1",
    [&placement](const std::string& text)
    {
      constexpr double kMost = DevicePlacement::kLargestScale;
      placement.scale = numberWithin(text, "--device-scale", { 1.0 / kMost, kMost, "0.2 to 5" });
    });
  addParsed(command, "--clutch",
    "Button of a device, 1 to 32, that holds the tool, without force, while the hand goes "
    "elsewhere; "
    "0: none",
    "2",
    [&placement](const std::string& text)
    {
      const double button = numberWithin(text, "--clutch", { 0.0, 32.0, "0 to 32" });
      placement.clutch = static_cast<int>(button);
      if (placement.clutch != button)
      {
        throw Error(ErrorCode::BadValue, "--clutch: '" + text + "' is no button; give 0 to 32");
      }
    });
}

void checkButtons(const ScenePlan& plan)
{
  if (plan.deadMan && plan.placement.clutch == 1)
  {
    throw Error(ErrorCode::BadValue,
      "--clutch: 1 is the button that --dead-man wants held; give another, or 0");
  }
}

} // namespace

void addViewCommand(CLI::App& app, int (*view)(const ViewOptions&))
{
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("view", "Open the window and press; the default command");
  options->plan.meshes.front().addTo(*command);
  options->plan.press.addTo(*command);
  addStiffness(*command, options->plan.meshes.front().stiffness);
  addOrganFile(*command, options->plan.meshes.front());
  addDevices(*command, options->plan);
  command->add_flag(
    "--dead-man", options->plan.deadMan, "Force only while the first button of the device is held");
  addPlacement(*command, options->plan.placement);
  addParsed(*command, "--rate",
    "Ticks of the servo, 1kHz to 4kHz: stiffer tissue can be felt, for more of a processor", "1kHz",
    [options = options.get()](const std::string& text)
    {
      options->plan.servoPeriod =
        1.0 / parseWithin(text, Quantity::Frequency, kServoRates, "--rate");
    });
  command->footer("Examples:\n"
                  "  palp                                       the bundled liver\n"
                  "  palp liver.obj --unit cm --tip sphere:6mm  your own surface\n"
                  "  palp view palp_export                      an exported folder, where it was");
  command->callback(
    [options, view, command]
    {
      if (const std::filesystem::path folder = options->plan.meshes.front().file;
          isWholeExport(folder))
      {
        refuseBeside(*command, folder, { "FILE", "--device", "--dead-man" });
        openExport(*options, folder);
      }
      // a wrong value is told before a missing display
      checkButtons(options->plan);
      checkMap(options->plan.meshes.front(), options->plan.press.tissue.options);
      (void)options->plan.press.tissue.law();
      checkExists(options->plan.meshes.front());
      if (!view)
      {
        execProgram("palp-view");
      }
      throw CLI::RuntimeError(view(*options));
    });
}

} // namespace palp
