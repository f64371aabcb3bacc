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
  CLI::App* command = app.add_subcommand("devices",
    "Say of each family of devices what it needs, which are there, which are not, and why");
  command->add_option("--probe", options->probe,
    "Exchange zero force with one device for a second and say how fast it answers: spacemouse, "
    "spacenavd, gamepad, falcon, falcon:FIRMWARE, wooden:PATH[,ARM], phd1:PATH, haply, "
    "forcedimension, "
    "openigtlink; ARM is v2015, v2019, polhem, aluhaptics or a file");
  CLI::Option* identify = command->add_option("--identify", options->identify,
    "Measure an arm that nobody holds, with at most 0.3 N in a minute: mass, friction, delay, and "
    "whether its motion follows its motors; kept for this user");
  command
    ->add_option("--added", options->added,
      "With --identify of an arm that was measured before: a mass now fixed to its handle, as "
      "100g; "
      "tells how strong a newton is")
    ->needs(identify);
  command->add_option("--home", options->home,
    "Let a PHD1 board move to its zero by itself, as phd1:PATH; nothing may be in its way");
  command->add_flag("--watch", options->watch, "Go on, and say what is plugged in and out");
  command->footer("Exit code: 0 a device can be used, 3 none is there, 6 one is there but cannot "
                  "be used.\nExamples:\n  palp devices\n  palp devices --probe phd1:/dev/hidraw2\n"
                  "  palp devices --identify wooden:/dev/hidraw2,v2019");
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
