#include "app/export.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/pictures.h"
#include "app/program.h"
#include "calibration/experiments.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <array>
#include <fstream>
#include <iostream>
#include <memory>
#include <string_view>

namespace palp
{
namespace
{

struct Named
{
  const char* name;
  const char* what;
  fem::Experiment (*run)(fem::Resolution, std::stop_token);
};

constexpr std::array kExperiments{
  Named{ "curvature", "Fig. 3: elastic spheres against the block", fem::curvature },
  Named{ "inclination", "Eq. (7): angles at which inclination is felt",
    [](fem::Resolution, std::stop_token) { return fem::inclination(); } },
  Named{ "extents", "Fig. 8: R_d over the depth", fem::extents },
  Named{ "profiles", "Fig. 7: surface profiles", fem::profiles },
  Named{ "forces", "Figs. 15 and 16: laws against finite elements", fem::forces },
};

struct ExperimentOptions
{
  std::vector<std::string> names;
  std::filesystem::path out = "experiments";
  bool quick = false;
  bool noPicture = false;
};

void write(const fem::Experiment& experiment, const std::filesystem::path& directory)
{
  const std::filesystem::path file = directory / (experiment.name + ".csv");
  std::ofstream out(file);
  out << fem::csv(experiment);
  out.close();
  if (!out)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": cannot be written; choose a folder with room where you may write");
  }
}

void runExperiments(const ExperimentOptions& options, const Pictures* pictures)
{
  if (!options.noPicture && !pictures)
  {
    becomeSibling("palp-draw");
  }
  makeDirectory(options.out);
  const Interrupt interrupt;
  for (const Named& named : kExperiments)
  {
    const auto& wanted = options.names;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), named.name) == wanted.end())
    {
      continue;
    }
    std::cerr << "palp: " << named.what << '\n';
    const fem::Experiment experiment =
      named.run(options.quick ? fem::Resolution::Quick : fem::Resolution::Full, interrupt.token());
    if (interrupt.token().stop_requested())
    {
      throw Error(ErrorCode::NoSolution,
        std::string(named.name) + ": interrupted; what was finished before it is in " +
          options.out.string());
    }
    write(experiment, options.out);
    if (!options.noPicture)
    {
      pictures->drawExperiment(experiment, options.out);
    }
    std::cerr << experiment.finding << '\n';
  }
}

} // namespace

void addExperimentCommand(CLI::App& app, const Pictures* pictures)
{
  auto options = std::make_shared<ExperimentOptions>();
  CLI::App* command =
    app.add_subcommand("experiment", "Do an experiment of the paper again, and say what came out");
  std::vector<std::string> names;
  std::string list;
  for (const Named& named : kExperiments)
  {
    names.emplace_back(named.name);
    list.append("  ").append(named.name).append(": ").append(named.what).append("\n");
  }
  command->add_option("NAME", options->names, "Which; all if none")->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "Folder for a CSV and a plot of each")
    ->capture_default_str();
  command->add_flag("--quick", options->quick, "Coarser, in seconds, for a first look");
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->footer(list + "Example:\n  palp experiment inclination forces --out experiments");
  command->callback([options, pictures] { runExperiments(*options, pictures); });
}

} // namespace palp
