#include "app/commands/commands.h"
#include "app/program/devices_options.h"
#include "app/program/exec_program.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace palp
{

void addDevicesCommand(CLI::App& app, int (*show)(const DevicesOptions&))
{
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command =
    app.add_subcommand("devices", "Say which devices are there, which are not, and why");
  command->add_option("--probe", options->probe,
    "Exchange zero force with one device for a second and say how fast it answers: spacemouse, "
    "falcon, falcon:FIRMWARE, wooden:PATH[,ARM.conf], phd1:PATH");
  command->add_flag("--watch", options->watch, "Go on, and say what is plugged in and out");
  command->footer("Exit code: 0 a device can be used, 3 none is there, 6 one is there but cannot "
                  "be used.\nExamples:\n  palp devices\n  palp devices --probe phd1:/dev/hidraw2");
  command->callback(
    [options, show]
    {
      if (!show)
      {
        execProgram("palp-devices");
      }
      throw CLI::RuntimeError(show(*options));
    });
}

} // namespace palp
