#include "app/commands/commands.h"
#include "app/headless/renderer.h"
#include "app/program/exec_program.h"
#include "app/program/interrupt.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "app/report/organ/organ_error.h"
#include "calibration/experiments/experiments.h"
#include "haptics/error.h"
#include "haptics/files/replace_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
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
  std::array<const char*, 3> figures; // as they are named in it
  fem::Experiment (*run)(fem::Resolution, const std::stop_token&);
};

constexpr std::array kExperiments{
  Named{ "curvature", "Fig. 3: elastic spheres against the block",
    { "curvature_sphere", "curvature_cone" }, fem::curvature },
  Named{ "inclination", "Eq. (7): angles at which inclination is felt", { "inclination" },
    [](fem::Resolution, const std::stop_token&) { return fem::inclination(); } },
  Named{ "extents", "Fig. 8: R_d over the depth", { "extents" }, fem::extents },
  Named{
    "profiles", "Fig. 7: surface profiles", { "profiles_sphere", "profiles_cone" }, fem::profiles },
  Named{ "forces", "Figs. 15 and 16: laws against finite elements",
    { "forces_sphere", "forces_cone", "force_difference" }, fem::forces },
  Named{ "organ", "Bodies that give way as a whole, by cells of 8 to 3 mm, against fine elements",
    { "organ" },
    [](fem::Resolution resolution, const std::stop_token& stop)
    { return report::organExperiment(resolution, stop); } },
};

struct ExperimentOptions
{
  std::vector<std::string> names;
  std::filesystem::path out = "experiments";
  bool quick = false;
  bool overwrite = false;
  bool noPicture = false;
};

std::vector<Named> wantedOf(const std::vector<std::string>& names)
{
  std::vector<Named> wanted;
  std::ranges::copy_if(kExperiments, std::back_inserter(wanted),
    [&](const Named& named)
    { return names.empty() || std::ranges::find(names, named.name) != names.end(); });
  return wanted;
}

std::vector<std::string> filesOf(const std::vector<Named>& wanted)
{
  std::vector<std::string> names;
  for (const Named& named : wanted)
  {
    names.push_back(std::string(named.name) + ".csv");
    for (const char* figure : named.figures)
    {
      if (figure != nullptr)
      {
        names.push_back(std::string(figure) + ".png");
      }
    }
  }
  return names;
}

// What is finished is kept; where earlier files would be replaced by some of the new ones only,
// nothing. Says so.
std::string endEarly(const char* name, OutputFolder& output)
{
  const bool fresh = output.found().empty();
  const bool some = fresh && !std::filesystem::is_empty(output.stage());
  some ? output.publish() : output.discard();
  return std::string(name) + ": interrupted; " +
    (some       ? output.path().string() + " holds what was finished before it"
        : fresh ? "nothing was finished before it"
                : output.path().string() + " is as it was");
}

void runExperiments(const ExperimentOptions& options, const Renderer* pictures)
{
  if (!options.noPicture && !pictures)
  {
    execProgram("palp-draw");
  }
  const std::vector<Named> wanted = wantedOf(options.names);
  Interrupt interrupt; // before there is a folder to put in order
  const auto output = openOutput(options.out, filesOf(wanted), options.overwrite);
  for (const Named& named : wanted)
  {
    std::cerr << "palp: " << named.what << '\n';
    const fem::Experiment experiment = [&]
    {
      interrupt.endBy([&] { return endEarly(named.name, *output); });
      const ProgressLine progress(named.name);
      return named.run(
        options.quick ? fem::Resolution::Quick : fem::Resolution::Full, interrupt.token());
    }();
    interrupt.endBy({});
    if (interrupt.token().stop_requested())
    {
      throw Error(ErrorCode::NoSolution, endEarly(named.name, *output));
    }
    replaceFile(output->stage() / (experiment.numbers.name + ".csv"), fem::csv(experiment));
    if (!options.noPicture)
    {
      pictures->drawFigures(
        experiment.figures, experiment.points, figures::Layout::Alone, output->stage());
    }
    std::cerr << experiment.finding << '\n';
  }
  output->publish();
}

} // namespace

void addExperimentCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<ExperimentOptions>();
  CLI::App* command = app.add_subcommand("experiment",
    "Do an experiment again, of the paper or of bodies that give way, and say what came out");
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
  addOverwrite(*command, options->overwrite);
  command->add_flag("--quick", options->quick, "Coarser, in seconds, for a first look");
  command->add_flag("--no-picture", options->noPicture, "Write the data only");
  command->footer(list + "Example:\n  palp experiment inclination forces --out experiments");
  command->callback([options, pictures] { runExperiments(*options, pictures); });
}

} // namespace palp
