#include "app/commands.h"
#include "app/csv.h"
#include "app/press_options.h"
#include "app/quantity.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

namespace palp
{
namespace
{

struct ForceOptions
{
  TissueOptions tissue;
  std::string depth = "0:10:0.5mm";
};

void printForces(const ForceOptions& options)
{
  const ForceLaw law = options.tissue.law();
  const Range depths = parseRange(options.depth, Quantity::Length, "--depth");
  std::cout << "depth_mm,force_N,contact_radius_mm,stiffness_N_per_mm\n";
  for (std::size_t i = 0; i < depths.si.size(); ++i)
  {
    const Response response = law({ .depth = depths.si[i] });
    writeCsvRow(std::cout,
      std::array{ depths.given[i] * units::toMillimetres(depths.unit), response.force,
        units::toMillimetres(response.contactRadius),
        units::toNewtonsPerMillimetre(response.stiffness) });
  }
}

} // namespace

void addForceCommand(CLI::App& app)
{
  auto options = std::make_shared<ForceOptions>();
  CLI::App* command = app.add_subcommand("force", "Print the force law as CSV");
  options->tissue.addTo(*command);
  command->add_option("--depth", options->depth, "Indentation depths A:B:STEP, both ends included")
    ->capture_default_str();
  command->footer("Example:\n"
                  "  palp force --tip cone:45deg:10mm --young 50kPa --poisson 0.33 --depth 0:10:0.5mm");
  command->callback([options] { printForces(*options); });
}

} // namespace palp
