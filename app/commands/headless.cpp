#include "app/commands/headless.h"

#include "app/commands/pictures.h"
#include "app/press/body.h"
#include "app/press/export.h"
#include "app/press/playback.h"
#include "app/press/recording.h"
#include "app/program/interrupt.h"
#include "app/program/ledger.h"
#include "app/program/sibling.h"
#include "haptics/contact/indentation_of.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/output_folder.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"

#include <cmath>
#include <iostream>
#include <limits>

namespace palp
{
namespace
{

// whether the device got the force of the law
bool isWhole(const Sample& sample)
{
  constexpr double kSame = 0.01; // [-]
  return std::abs(sample.force.norm() - sample.response.force) <= kSame * sample.response.force;
}

// names the conditions of the law that a contact breaks
void tellLimits(const ForceLaw& law, const Contact& contact)
{
  const std::string broken =
    brokenNames(Validity(law)(indentationOf(contact), contact.edgeDistance));
  if (!broken.empty())
  {
    std::cerr << "palp: warning: there the law is outside its limits (" << broken
              << "); samples.csv tells it of each sample, broken_rules\n";
  }
}

void tell(const Recording& recording, const Calibration* calibration)
{
  using units::toMillimetres;
  const Sample* deepest = recording.deepest();
  if (!deepest)
  {
    std::cerr << "palp: warning: the tool never touched the surface; the path may be in another "
                 "frame or unit\n";
    return;
  }
  std::cerr << "palp: deepest " << toMillimetres(deepest->contact.depth) << " mm, force "
            << deepest->response.force << " N";
  if (!isWhole(*deepest)) // damped or limited
  {
    std::cerr << " (" << deepest->force.norm() << " N to the device)";
  }
  std::cerr << ", contact radius " << toMillimetres(deepest->response.contactRadius) << " mm";
  if (calibration)
  {
    std::cerr << ", extent radius "
              << toMillimetres(calibration->extents.extentRadius(deepest->contact.depth)) << " mm"
              << (calibration->covers(deepest->contact.depth) ? "" : " (estimated)");
  }
  std::cerr << '\n';
  if (recording.rated)
  {
    tellLimits(recording.scene.law, deepest->contact);
  }
}

Scene sceneOf(const ScenePlan& plan, bool chained)
{
  Scene scene;
  scene.law = plan.press.tissue.law();
  scene.rule = plan.press.rule();
  scene.damping = plan.press.dampingSi();
  scene.forceLimit = chained ? scene.forceLimit : std::numeric_limits<double>::infinity();
  return scene;
}

void explainOmissions(const ScenePlan& plan, Ledger& ledger)
{
  const bool corrected = plan.press.tissue.options.mode == "corrected";
  ledger.leaveOut("window, Qt", "\"window\" is false");
  ledger.leaveOut("device, USB", "the tool follows a path");
  ledger.leaveOut("servo thread", "a path without a window is pressed in simulated time");
  ledger.leaveOut("live sample ring", "no servo thread fills it");
  ledger.leaveOut("OpenGL", "no picture and no plot is asked for", !plan.draws());
  ledger.leaveOut("overlays", "no picture shows them", !plan.picture);
  ledger.leaveOut("plots", "none is named", plan.curves.empty());
  ledger.leaveOut("calibration, dent", "\"dent\" is none", !plan.dent);
  ledger.leaveOut("large-strain table", "the law is not corrected and no sample is rated",
    !plan.validity && !corrected);
}

} // namespace

std::vector<std::string> pressFiles()
{
  std::vector<std::string> names{ "samples.csv", "deformed.vtp", "press.png", "force_time.png",
    "force_depth.png" };
  for (const std::string plot : { "section", "comparison", "extent" })
  {
    for (const char* ending : { ".png", ".svg", ".pdf", ".csv" })
    {
      names.push_back(plot + ending);
    }
  }
  return names;
}

void playPlan(const ScenePlan& plan, bool chained, OutputFolder& output, const Pictures* pictures,
  Ledger& ledger)
{
  const Interrupt interrupt([&output] { output.discard(); });
  const std::filesystem::path out = output.stage();
  Recording recording;
  recording.rated = plan.validity;
  recording.scene = ledger.build("law", "tissue and tool", [&] { return sceneOf(plan, chained); });
  const ScriptedPath path =
    ledger.build("path", "moves the tool", [&] { return readScript(plan.device); });
  recording.device =
    plan.device.substr(0, plan.device.find(':') + 1) + scriptFile(plan.device).filename().string();
  std::optional<Calibration> calibration;
  if (plan.dent)
  {
    calibration = ledger.build("calibration", "how far the surface gives way",
      [&] { return loadCalibration(plan.press, recording.scene.law); });
  }
  const bool shown = plan.deformed || plan.picture || plan.has(Curve::Section);
  const Body body = ledger.build("surface", shown ? "felt and shown" : "felt, not shown",
    [&] { return loadBody(plan.meshes, shown); });
  for (const std::string& note : body.notes)
  {
    std::cerr << "palp: " << note << '\n';
  }
  if (calibration && !calibration->note.empty())
  {
    std::cerr << "palp: " << calibration->note << '\n';
  }
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.files = body.files;
  recording.command = commandLine();
  recording.scene.surface = body.haptic;

  recording.samples = ledger.build(
    "press", "force at every millisecond", [&] { return play(path, recording.scene, chained); });
  const Calibration* known = calibration ? &*calibration : nullptr;
  tell(recording, known);
  if (plan.samples)
  {
    ledger.build(
      "samples.csv", "exported", [&] { writeSamples(out / "samples.csv", recording, known); });
  }
  if (plan.deformed)
  {
    ledger.build("deformed.vtp", "exported",
      [&] { writeDeformed(out / "deformed.vtp", body, recording, *known, plan.refined); });
  }
  if (plan.draws())
  {
    ledger.build(
      "pictures", "exported", [&] { pictures->drawPress(body, recording, known, plan, out); });
  }
  output.publish();
  explainOmissions(plan, ledger);
}

} // namespace palp
