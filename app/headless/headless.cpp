#include "app/headless/headless.h"

#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/folder/repetition.h"
#include "app/headless/renderer.h"
#include "app/press/body.h"
#include "app/press/export.h"
#include "app/press/playback.h"
#include "app/press/presses.h"
#include "app/press/recording.h"
#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/program/progress_line.h"
#include "app/train/score_sheet.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/files/input_text.h"
#include "haptics/files/output_folder.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>

namespace palp
{
namespace
{

// what of the force of the law comes to the device, and why it is not as much; else nothing
std::string sentOf(const Sample& sample)
{
  constexpr double kSame = 0.01; // [-]
  const double sent = sample.force.norm();
  const double law = sample.response.force;
  const double slope = sample.contact.slope;
  if (std::abs(sent - law) <= kSame * law)
  {
    return "";
  }
  const bool isLimited = (sample.flags & static_cast<std::uint32_t>(Flag::Limited)) != 0;
  const bool isByShape = std::abs(sent - slope * law) <= kSame * sent;
  std::ostringstream text;
  text << " (" << sent << " N to the device: ";
  if (!isLimited && isByShape)
  {
    text << "the contact deepens by " << slope << " mm in a mm of the tool's way)";
    return text.str();
  }
  text << (isLimited ? "the force limit)" : "with damping and what pushes the tool aside)");
  return text.str();
}

// names the conditions of the law that are broken where it is pressed deepest, and counts the
// presses that break any
void tellLimits(const Recording& recording, const Sample& deepest)
{
  const std::vector<Validity> validity = validityOf(recording.scene);
  const auto limitsAt = [&](int organ, const Contact& contact)
  {
    return outsideLimits(
      organOf(recording.scene, organ), validity[static_cast<std::size_t>(organ)], contact);
  };
  const std::vector<PressSummary> presses = findPresses(recording);
  std::size_t outside = 0;
  std::string named; // the first of them
  std::string where = "there";
  constexpr std::size_t most = 5;
  for (const PressSummary& press : presses)
  {
    const bool isDeepest = presses.size() > 1 && press.deepest.depth == deepest.contact.depth;
    where = isDeepest && where == "there" ? "in " + printable(press.name) : where;
    if (!limitsAt(press.organ, press.deepest).empty())
    {
      ++outside;
      const std::string next = outside == most + 1 ? ", ..." : ", " + printable(press.name);
      named += outside > most + 1 ? "" : outside == 1 ? printable(press.name) : next;
    }
  }
  if (const std::string broken = limitsAt(deepest.organ, deepest.contact); !broken.empty())
  {
    std::cerr << "palp: warning: " << where << " the law is outside its limits (" << broken
              << "); samples.csv tells it of each sample, broken_rules\n";
  }
  if (presses.size() > 1 && outside > 0)
  {
    std::cerr << "palp: warning: in " << outside << " of " << presses.size() << " presses ("
              << named << ") the law is outside its limits; presses.csv tells of each\n";
  }
}

// which another place than the deepest one may have felt
void tellStrongest(const Recording& recording, const Sample& deepest)
{
  constexpr double kAsStrong = 1.01;
  const Sample& most = *std::ranges::max_element(
    recording.samples, {}, [](const Sample& sample) { return sample.response.force; });
  if (most.response.force > kAsStrong * deepest.response.force)
  {
    std::cerr << "palp: largest force " << most.response.force << " N, "
              << units::toMillimeters(most.contact.depth) << " mm deep, at " << most.time << " s\n";
  }
}

// path: null where places or a recording are pressed
void tell(const Recording& recording, const Calibration* calibration, const ScriptedPath* path)
{
  using units::toMillimeters;
  const Sample* deepest = recording.deepest();
  const bool isFine = path && isFinerThanSamples(*path);
  if (!deepest)
  {
    std::cerr << "palp: warning: the tool never touched the surface; the path may be in another "
                 "frame or unit"
              << (isFine ? ", or touch between whole milliseconds only, as it has rows closer "
                           "than those at which it is pressed"
                         : "")
              << '\n';
    return;
  }
  const std::string organ = recording.organName(deepest->organ);
  std::cerr << "palp: deepest " << toMillimeters(deepest->contact.depth) << " mm"
            << (organ.empty() ? "" : " in " + organ) << ", force " << deepest->response.force
            << " N" << sentOf(*deepest) << ", contact radius of the law "
            << toMillimeters(deepest->response.contactRadius) << " mm";
  calibration = calibration ? &organOf(*calibration, deepest->organ) : nullptr;
  if (calibration)
  {
    std::cerr << ", extent radius " << toMillimeters(calibration->extentRadius(*deepest)) << " mm"
              << (calibration->covers(deepest->contact.depth) ? "" : " (estimated)");
  }
  std::cerr << '\n';
  tellStrongest(recording, *deepest);
  if (isFine)
  {
    std::cerr << "palp: warning: the path has rows closer than the whole milliseconds at which it "
                 "is pressed: what is between is left out\n";
  }
  if (deepest->pose.axis.dot(deepest->contact.normal) > 0.0)
  {
    std::cerr << "palp: warning: the tool's axis points out of the surface there; it is the way "
                 "from the shaft to the apex, 0,0,-1 for a press from above\n";
  }
  if (calibration && !calibration->fits(deepest->contact))
  {
    std::cerr
      << "palp: the surface is fitted to a flat layer of five tool radii, pressed level; at "
         "the deepest place it may be wrong by more than 3 % of the depth\n";
  }
  if (recording.rated)
  {
    tellLimits(recording, *deepest);
  }
}

Scene sceneOf(const ScenePlan& plan)
{
  Scene scene;
  scene.law = plan.press.tissue.law();
  scene.rule = plan.press.contact;
  scene.damping = plan.press.damping;
  scene.forceLimit = plan.chain ? scene.forceLimit : std::numeric_limits<double>::infinity();
  setTissues(scene, plan.organs);
  return scene;
}

void explainOmissions(const ScenePlan& plan, BuildTrace& trace)
{
  const bool corrected = plan.press.tissue.options.mode == LawMode::Corrected;
  trace.skip("window, Qt", "\"window\" is false");
  trace.skip("device, USB", "what moves the tool is known");
  trace.skip("servo thread", "a path without a window is pressed in simulated time");
  trace.skip("live sample ring", "no servo thread fills it");
  trace.skip("OpenGL", "no picture and no plot is asked for", !plan.draws());
  trace.skip("overlays", "no picture shows them", !plan.picture);
  trace.skip("plots", "none is named", plan.plots.empty());
  trace.skip("calibration, dent", "\"dent\" is none", !plan.dents());
  trace.skip("large-strain table", "the law is not corrected and no sample is rated",
    !plan.validity && !corrected);
}

// what is pressed, and what there is to tell of it
SceneBody loadTold(const ScenePlan& plan, std::string_view path, BuildTrace& trace)
{
  const bool shown =
    plan.deformed || plan.picture || !plan.movies.empty() || plan.has(PlotKind::Section);
  SceneBody body = trace.build("surface", shown ? "felt and shown" : "felt, not shown",
    [&] { return loadBodies(plan, shown); });
  for (const std::string& note : body.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  if (const std::string other = noteOfPath(path, body.files); !other.empty())
  {
    std::cerr << "palp: " << other << '\n';
  }
  return body;
}

struct GivenPath
{
  std::string text; // empty: there is none
  std::optional<ScriptedPath> path;
};

// before the work, and once, as it may be a pipe
GivenPath readGiven(const ScenePlan& plan, BuildTrace& trace)
{
  GivenPath given;
  if (!plan.presses && !plan.recording)
  {
    const std::filesystem::path& file = plan.device.file;
    given.text = readText(file, "the CSV file");
    given.path =
      trace.build("path", "moves the tool", [&] { return parsePath(given.text, file.string()); });
  }
  return given;
}

struct PlayedPress
{
  const ScenePlan& plan;
  const SceneBody& body;
  const Recording& recording;
  const Calibration* calibration; // null: the surface does not give way
  const std::string& path;        // its text; empty: there is none
};

void writeGrade(const std::filesystem::path& out, const SceneBody& body, const Recording& recording,
  const TrainingPlan& training)
{
  const ScoreSheet sheet = scoreSheetOf(body.name, recording.scene, recording.samples, training);
  std::cerr << "palp: level " << sheet.level.name << ", seed " << training.seed << ": "
            << summaryOf(sheet.grade) << (sheet.grade.isPassed ? "; passed" : "; not passed")
            << '\n';
  writeScore(out, sheet);
}

void writeAll(const PlayedPress& all, const std::filesystem::path& out, const Renderer* pictures,
  BuildTrace& trace)
{
  const double parts = (all.plan.samples ? 1.0 : 0.0) + (all.plan.deformed ? 1.0 : 0.0) +
    (all.plan.draws() ? 1.0 : 0.0);
  double part = 0.0;
  const auto write = [&](const char* what, const std::function<void()>& work)
  {
    trace.build(what, "exported",
      [&]
      {
        ProgressLine progress(std::string("writing ") + what);
        progress(part++ / parts);
        work();
      });
  };
  if (all.plan.samples)
  {
    write("samples.csv",
      [&]
      {
        writeSamples(out / "samples.csv", all.recording, all.calibration);
        writePresses(out / "presses.csv", all.recording);
      });
  }
  if (all.plan.deformed)
  {
    write("deformed.vtp",
      [&]
      {
        writeDeformed(
          out / "deformed.vtp", all.body, all.recording, *all.calibration, all.plan.refined);
      });
  }
  if (all.plan.draws())
  {
    const auto draw = [&]
    { pictures->drawPress(all.body, all.recording, all.calibration, all.plan, out); };
    all.plan.movies.empty() ? write("pictures", draw) // each movie tells of itself
                            : trace.build("pictures", "exported", draw);
  }
  if (all.plan.training)
  {
    trace.build("score", "a search for hidden nodules is graded",
      [&] { writeGrade(out, all.body, all.recording, *all.plan.training); });
  }
  writeScene(out, all.plan, all.path);
  writeProvenance(out, all.plan, all.recording);
}

} // namespace

void playPlan(const ScenePlan& plan, OutputFolder& output, const Renderer* pictures,
  BuildTrace& trace, const ExportFolder* repeated)
{
  Recording recording;
  recording.rated = plan.validity;
  recording.organs = plan.organs;
  recording.scene = trace.build("law", "tissue and tool", [&] { return sceneOf(plan); });
  const GivenPath given = readGiven(plan, trace);
  std::optional<Calibration> calibration;
  if (plan.dents())
  {
    calibration = trace.build("calibration", "how far the surface gives way",
      [&] { return loadCalibration(plan.press, recording.scene); });
  }
  const SceneBody body = loadTold(plan, given.text, trace);
  if (calibration && !calibration->note.empty())
  {
    std::cerr << "palp: " << calibration->note << '\n';
  }
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.files = body.files;
  recording.command = repeated ? repeated->command : commandLine();
  const auto feel = [&] { setFelt(recording.scene, body, plan.organs); };
  body.nodules.empty() ? feel() : trace.build("nodules", "felt", feel);
  calibration ? followTissue(*calibration, recording.scene) : void();
  if (repeated)
  {
    checkInputs(*repeated, plan, recording);
  }
  const ScriptedPath* path = given.path ? &*given.path : nullptr;
  const std::vector<std::string> notes = trace.build("press", "force at every millisecond",
    [&]
    {
      const ProgressLine progress("pressing");
      return playInto(recording, plan, path);
    });
  for (const std::string& note : notes)
  {
    std::cerr << "palp: warning: " << note << '\n';
  }
  recording.device = repeated ? repeated->device : recording.device;
  const Calibration* known = calibration ? &*calibration : nullptr;
  tell(recording, known, path);
  writeAll({ plan, body, recording, known, given.text }, output.stage(), pictures, trace);
  if (repeated)
  {
    tellRepetition(*repeated, output.stage());
  }
  output.publish();
  explainOmissions(plan, trace);
}

} // namespace palp
