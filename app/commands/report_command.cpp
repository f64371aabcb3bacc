#include "app/commands/commands.h"
#include "app/commands/program.h"
#include "app/headless/renderer.h"
#include "app/program/exec_program.h"
#include "app/program/interrupt.h"
#include "app/program/machine.h"
#include "app/program/output.h"
#include "app/program/progress_line.h"
#include "app/report/folder.h"
#include "app/report/html_page.h"
#include "app/report/organ/organ_error.h"
#include "app/report/parts.h"
#include "app/report/tissue/tissue_error.h"
#include "haptics/error.h"

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

namespace palp
{
namespace
{

using namespace report;
using Clock = std::chrono::steady_clock;

struct Part
{
  const char* name;
  const char* title;
  Section (*make)(const Effort&);
};

constexpr std::array kParts{
  Part{ "force_error", "Error of the force against run time", forceAgainstTime },
  Part{ "surface_error", "Error of the surface against run time", surfaceAgainstTime },
  Part{
    "tissue_error", "Nodules and maps: error of the force against run time", tissueAgainstTime },
  Part{ "organ_error", "Bodies that give way: error of the force against the time of an organ file",
    organAgainstTime },
  Part{ "curvature", "Fig. 3: curved bodies against the flat block", curvature },
  Part{ "inclination", "Eq. (7): the inclined tool", inclination },
  Part{ "profiles", "Fig. 7: surface profiles", profiles },
  Part{ "extents", "Fig. 8: the radius of the deformed region", extents },
  Part{ "dynamics", "Fig. 12: finite elements and springs stepped in time", dynamics },
  Part{ "scaling", "Table 1, Figs. 13 and 14: scaling with the number of vertices", scaling },
  Part{ "forces", "Figs. 15 and 16: forces against finite elements", forces },
  Part{ "stability", "Stability of the closed loop", stability },
  Part{ "servo", "Punctuality of the servo thread", servo },
};

struct ReportOptions
{
  std::filesystem::path out;
  std::vector<std::string> parts; // names; empty: all
  bool quick = false;
  bool resume = false;
  bool overwrite = false;
};

std::vector<std::string> namesOfParts()
{
  std::vector<std::string> names;
  std::ranges::transform(kParts, std::back_inserter(names), &Part::name);
  return names;
}

bool isAsked(const Part& part, const ReportOptions& options)
{
  return options.parts.empty() ||
    std::ranges::find(options.parts, part.name) != options.parts.end();
}

// the parts that are finished, in their order; the rest is left where the user stops it
std::vector<Section> makeParts(
  Folder& folder, const ReportOptions& options, const Interrupt& interrupt)
{
  std::vector<Section> sections;
  for (std::size_t i = 0; i < kParts.size(); ++i)
  {
    if (auto before = folder.finished(kParts[i].name))
    {
      sections.push_back(std::move(*before));
      continue;
    }
    if (interrupt.token().stop_requested() || !isAsked(kParts[i], options))
    {
      continue;
    }
    const std::string part = "part " + std::to_string(i + 1) + " of " +
      std::to_string(kParts.size()) + ", " + kParts[i].title;
    const Clock::time_point start = Clock::now();
    ProgressLine progress(part);
    try
    {
      Section section = kParts[i].make({ .quick = options.quick,
        .stop = interrupt.token(),
        .tell = [&](double fraction) { progress(fraction); } });
      section.name = kParts[i].name;
      section.title = kParts[i].title;
      folder.keep(section);
      sections.push_back(std::move(section));
      const std::chrono::duration<double> spent = Clock::now() - start;
      progress.tell(part + ": " + std::to_string(std::lround(spent.count())) + " s");
    }
    catch (const Interrupted&) // goes on to the page
    {
      continue;
    }
    catch (const Error& error) // the other parts stand without it
    {
      progress.tell(error.what());
    }
  }
  return sections;
}

// what all parts say about the paper, in one table
Section claimByClaim(const std::vector<Section>& sections)
{
  Table table{ .name = "claims",
    .caption = "What the paper says, what came out here, and why they differ where they do.",
    .columns = { "paper", "says", "here", "verdict" } };
  for (const Section& section : sections)
  {
    for (const Claim& claim : section.claims)
    {
      table.rows.push_back({ claim.of, claim.paper, claim.here, claim.verdict });
    }
  }
  Section all{ .name = "claims", .title = "The paper, claim by claim" };
  all.tables.push_back(std::move(table));
  return all;
}

std::vector<std::string> unfinishedOf(
  const std::vector<Section>& sections, const ReportOptions& options)
{
  std::vector<std::string> titles;
  for (const Part& part : kParts)
  {
    if (isAsked(part, options) &&
      std::ranges::find(sections, part.name, &Section::name) == sections.end())
    {
      titles.emplace_back(part.title);
    }
  }
  return titles;
}

void makeReport(const ReportOptions& options, const Renderer* pictures)
{
  if (!pictures)
  {
    execProgram("palp-draw");
  }
  const Interrupt interrupt;
  Folder folder(options.out, options.quick, describeMachine(),
    options.resume        ? Before::Resume
      : options.overwrite ? Before::Replace
                          : Before::Refuse);
  std::vector<Section> sections = makeParts(folder, options, interrupt);
  if (sections.empty())
  {
    throw Error(ErrorCode::NoSolution,
      options.out.string() + ": no part is finished; what was there is as it was");
  }
  const std::vector<std::string> unfinished = unfinishedOf(sections, options);
  const Section claims = claimByClaim(sections);
  folder.keep(claims);
  // after the errors, before what it refers to
  sections.insert(
    sections.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, sections.size())),
    claims);
  for (const Section& section : sections)
  {
    pictures->drawFigures(
      section.figures, section.tables, figures::Layout::OnPage, folder.output().stage());
  }
  folder.output().publish();
  writePage(folder.output().path(), folder.machine(), sections, unfinished);
  const std::string page = (folder.output().path() / "report.html").string();
  if (!unfinished.empty())
  {
    const auto asked = static_cast<std::size_t>(
      std::ranges::count_if(kParts, [&](const Part& part) { return isAsked(part, options); }));
    throw Error(ErrorCode::NoSolution,
      page + ": " + std::to_string(asked - unfinished.size()) + " of " + std::to_string(asked) +
        " parts are finished; --resume goes on from here");
  }
  std::cerr << "palp: " << page << '\n';
}

} // namespace

void addReportCommand(CLI::App& app, const Renderer* pictures)
{
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand("report",
    "Measure error against run time and the paper's claims here; one page, with its data");
  command->add_option("--out", options->out, "Folder for report.html, CSV and JSON")->required();
  command->add_flag("--quick", options->quick, "Two minutes, not half an hour");
  command->add_option("NAME", options->parts, "Which parts; all if none")
    ->check(CLI::IsMember(namesOfParts()));
  command->add_flag("--resume", options->resume, "Go on with what --out holds of this report");
  addOverwrite(*command, options->overwrite);
  command->footer(
    "Ctrl-C leaves a page of the finished parts. Let nothing else run meanwhile: times are taken.\n"
    "Examples:\n"
    "  palp report --quick --out report\n"
    "  palp report profiles servo --out report\n"
    "  palp report --out report            and, after an interruption:\n"
    "  palp report --out report --resume");
  command->callback([options, pictures] { makeReport(*options, pictures); });
}

} // namespace palp
