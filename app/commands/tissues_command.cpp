#include "app/commands/commands.h"
#include "app/input/press_options.h"
#include "app/input/tissue_presets.h"
#include "calibration/figures/table.h"
#include "haptics/units.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <limits>

namespace palp
{
namespace
{

// no number where there is none
double kilopascals(const std::optional<double>& modulus)
{
  return units::toKilopascals(modulus.value_or(std::numeric_limits<double>::quiet_NaN()));
}

figures::Table tissueTable(std::span<const TissuePreset> tissues)
{
  figures::Table table{ .name = "tissues",
    .caption = "Measured tissues",
    .columns = { "name", "young_kPa", "low_kPa", "high_kPa", "range_is", "poisson", "title",
      "method", "source", "note" } };
  for (const TissuePreset& tissue : tissues)
  {
    table.rows.push_back({ tissue.name, kilopascals(tissue.material.youngModulus),
      kilopascals(tissue.low), kilopascals(tissue.high), tissue.spread,
      tissue.material.poissonRatio, tissue.title, tissue.method, tissue.source, tissue.note });
  }
  return table;
}

void printTissues()
{
  const std::vector<TissuePreset> tissues = shippedTissues();
  const double standard = TissueOptions{}.young;
  const double healthy = tissueNamed("healthy_liver", tissues, "tissues").material.youngModulus;
  constexpr int kDigits = 6; // more come of conversion only
  std::cout
    << "# palp takes " << units::toKilopascals(standard)
    << " kPa where no tissue is named: the modulus of a tumor, "
    << figures::textOf(standard / healthy, 2) << " times that of healthy liver\n"
    << "# young_kPa is 3 times a measured shear modulus, since tissue hardly changes its volume: "
       "for poisson 0.49 stands, whatever the source\n"
    << figures::csv(tissueTable(tissues), kDigits);
}

} // namespace

void addTissuesCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand(
    "tissues", "Print the tissues that --tissue takes: modulus, range and source as CSV");
  command->footer("low_kPa and high_kPa: the range of young_kPa, which range_is tells; empty where "
                  "none is known.\nExamples:\n"
                  "  palp tissues > tissues.csv\n"
                  "  palp force --tissue hcc --depth 0:5:1mm\n"
                  "  palp force --tissue healthy_liver --young 5kPa     nu of the tissue, own E");
  command->callback(printTissues);
}

} // namespace palp
