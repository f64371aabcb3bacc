#include "app/commands/organ/organ_file.h"

#include "app/program/progress_line.h"
#include "app/stiffness/stiffness_text.h"
#include "app/supports/organ_seal.h"
#include "app/supports/support_text.h"
#include "calibration/organ/organ_motion_modes.h"
#include "calibration/organ/organ_places.h"
#include "calibration/tables/organ_table.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>
#include <thread>

namespace palp
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr double kTool = 0.01; // radius of one that every map must be felt by [m]
constexpr const char* kStopped =
  "interrupted; what was reached waits beside --out, run the same again to go on from there";

std::filesystem::path begunOf(const std::filesystem::path& out)
{
  std::filesystem::path begun = out;
  begun += ".part";
  return begun;
}

OrganTable emptyTable(const OrganFilePlan& plan, const SceneBody& body, std::size_t places)
{
  OrganTable table;
  table.mesh = identityOf(body.files.front());
  table.supports = describeSupports(plan.supports, plan.out.parent_path());
  if (const StiffnessSource& stiffness = body.sources.front().stiffness; stiffness.isGiven())
  {
    table.stiffness = identityOf(stiffness);
    table.young = stiffness.kind != StiffnessSource::Kind::Random ? plan.young : 0.0;
  }
  table.poisson = plan.poisson;
  table.cell = plan.cell;
  table.spacing = spacingOf(*body.haptic, plan.cell);
  table.count = places;
  return table;
}

// none where there is none, or it is of something else
std::optional<OrganTable> tableIn(const std::filesystem::path& file, const OrganTable& wanted)
{
  if (!std::filesystem::exists(file))
  {
    return std::nullopt;
  }
  checkSeal(file);
  OrganTable found = readOrganTable(file);
  return found.continues(wanted) ? std::optional(std::move(found)) : std::nullopt;
}

// of what is written anew where it cannot be used
std::optional<OrganTable> usableIn(const std::filesystem::path& file, const OrganTable& wanted)
{
  try
  {
    return tableIn(file, wanted);
  }
  catch (const Error&)
  {
    std::cerr << "palp: " << file.string() << ": is damaged; its places are solved for again\n";
    return std::nullopt;
  }
}

std::string described(const OrganTable& table)
{
  constexpr std::array kWhy{ "", "near an edge or another tissue",
    "where it is too thin for its cells", "on a support", "with too little surface around" };
  std::array<std::size_t, kWhy.size()> counts{};
  for (const PlacedCompliance& place : table.places)
  {
    ++counts[static_cast<std::size_t>(place.trust)];
  }
  std::string text;
  for (std::size_t i = 1; i < kWhy.size(); ++i)
  {
    counts[i] > 0 ? addListed(text, std::to_string(counts[i]) + " " + kWhy[i]) : void();
  }
  return text.empty() ? "all answered for" : "cannot answer for " + text;
}

// what no place tells of would be felt as a half-space
void checkThatItTells(
  const OrganTable& table, const std::filesystem::path& out, const std::filesystem::path& begun)
{
  if (std::ranges::all_of(
        table.places, [](const PlacedCompliance& place) { return place.constant == 0.0; }))
  {
    std::filesystem::remove(begun);
    throw Error(ErrorCode::BadValue,
      out.string() + ": is not written, as it " + described(table) +
        ", which is all of the body; give smaller cells by --cell, or supports that hold less");
  }
}

// done, shown in units that are read at a glance
void report(const OrganFilePlan& plan, const OrganTable& table, Clock::duration time)
{
  constexpr double kKilobyte = 1000.0;
  const double seconds = std::chrono::duration<double>(time).count();
  std::cerr << "palp: " << plan.out.string() << ": " << counted(table.places.size(), "place")
            << ", "
            << std::lround(static_cast<double>(std::filesystem::file_size(plan.out)) / kKilobyte)
            << " kB, " << std::lround(seconds) << " s; " << described(table) << '\n';
}

// over a modulus; empty: of a body that is even
ModulusRatio modulusRatio(const SceneBody& body, double young)
{
  return body.stiffness ? [map = body.stiffness, young](const Eigen::Vector3d& place)
  { return map(place, young) / young; }
                        : ModulusRatio{};
}

// refused before it is solved where a press would refuse it
void checkMap(const SceneBody& body, const OrganFilePlan& plan)
{
  if (body.stiffness)
  {
    const ForceLaw law(SphereTip{ kTool }, makeMaterial(plan.young, plan.poisson),
      { .mode = LawMode::Corrected,
        .constitution = ConstitutiveModel::Linear,
        .thickness = false });
    (void)feltStiffness(body, law);
  }
}

} // namespace

std::string inWords(const OrganModel& model)
{
  const long left = std::lround(100.0 * model.leftOut());
  return counted(static_cast<std::size_t>(model.nodes()), "node") +
    (left == 0 ? ""
               : "; " + std::to_string(left) +
          " % of the volume is in pieces that no cells join to the largest, and is left out");
}

void makeOrganFile(const OrganFilePlan& plan, const SceneBody& body,
  std::span<const Support> supports, Interrupt& interrupt)
{
  const auto start = Clock::now();
  const Surface& surface = *body.haptic;
  const std::vector<SurfacePoint> places = organPlaces(surface, spacingOf(surface, plan.cell));
  const OrganTable wanted = emptyTable(plan, body, places.size());
  if (const auto made = plan.overwrite ? usableIn(plan.out, wanted) : tableIn(plan.out, wanted);
      made && made->isComplete())
  {
    std::cerr << "palp: " << plan.out.string() << ": is of this body and these supports already\n";
    return;
  }
  if (std::filesystem::exists(plan.out) && !plan.overwrite)
  {
    throw Error(ErrorCode::BadFile,
      plan.out.string() +
        ": is an organ file of another body, its supports, tissue or cells; give "
        "--overwrite, or another --out");
  }
  const std::filesystem::path begun = begunOf(plan.out);
  OrganTable table = usableIn(begun, wanted).value_or(wanted);
  checkMap(body, plan);
  interrupt.endWhatDoesNotStop(table.places.empty() ? kNoPlaceYet : kStopped);
  ProgressLine progress("places");
  progress(table.places.size(), places.size());
  const OrganModel model(
    surface, plan.cell, plan.young, plan.poisson, supports, modulusRatio(body, plan.young));
  progress.tell(inWords(model));
  auto kept = Clock::now();
  const auto tell = [&](const OrganTable& now)
  {
    progress(now.places.size(), places.size());
    constexpr auto kEvery = std::chrono::seconds(1);
    if (Clock::now() - kept > kEvery && !now.isComplete())
    {
      writeSealed(begun, now);
      interrupt.endWhatDoesNotStop(kStopped);
      kept = Clock::now();
    }
  };
  if (!addPlaces(table, model, surface,
        { .places = places, .supports = supports, .tell = tell, .stop = interrupt.token() }))
  {
    table.places.empty() ? void() : writeSealed(begun, table);
    throw Error(ErrorCode::NoSolution, table.places.empty() ? kNoPlaceYet : kStopped);
  }
  checkThatItTells(table, plan.out, begun);
  writeSealed(begun, table);
  progress.tell("motion of the whole body, to be drawn");
  if (!addMotion(table, model, surface, interrupt.token()))
  {
    throw Error(ErrorCode::NoSolution, kStopped);
  }
  writeSealed(plan.out, table);
  std::filesystem::remove(begun);
  report(plan, table, Clock::now() - start);
}

} // namespace palp
