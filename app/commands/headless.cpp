#include "app/commands/headless.h"

#include "app/commands/renderer.h"
#include "app/press/body.h"
#include "app/press/export.h"
#include "app/press/playback.h"
#include "app/press/recording.h"
#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/program/interrupt.h"
#include "app/program/progress_line.h"
#include "haptics/contact/contact_geometry_of.h"
#include "haptics/files/input_text.h"
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
    brokenNames(Validity(law)(contactGeometryOf(contact), contact.edgeDistance));
  if (!broken.empty())
  {
    std::cerr << "palp: warning: there the law is outside its limits (" << broken
              << "); samples.csv tells it of each sample, broken_rules\n";
  }
}

void tell(const Recording& recording, const Calibration* calibration)
{
  using units::toMillimeters;
  const Sample* deepest = recording.deepest();
  if (!deepest)
  {
    std::cerr << "palp: warning: the tool never touched the surface; the path may be in another "
                 "frame or unit\n";
    return;
  }
  std::cerr << "palp: deepest " << toMillimeters(deepest->contact.depth) << " mm, force "
            << deepest->response.force << " N";
  if (!isWhole(*deepest)) // damped or limited
  {
    std::cerr << " (" << deepest->force.norm() << " N to the device)";
  }
  std::cerr << ", contact radius of the law " << toMillimeters(deepest->response.contactRadius)
            << " mm";
  if (calibration)
  {
    std::cerr << ", extent radius "
              << toMillimeters(calibration->extents.extentRadius(deepest->contact.depth)) << " mm"
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
  scene.rule = plan.press.contact;
  scene.damping = plan.press.damping;
  scene.forceLimit = chained ? scene.forceLimit : std::numeric_limits<double>::infinity();
  return scene;
}

void explainOmissions(const ScenePlan& plan, BuildTrace& trace)
{
  const bool corrected = plan.press.tissue.options.mode == LawMode::Corrected;
  trace.skip("window, Qt", "\"window\" is false");
  trace.skip("device, USB", "the tool follows a path");
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
  const bool shown = plan.deformed || plan.picture || plan.has(PlotKind::Section);
  SceneBody body = trace.build("surface", shown ? "felt and shown" : "felt, not shown",
    [&] { return loadBody(plan.meshes, shown); });
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

void playPlan(const ScenePlan& plan, bool chained, OutputFolder& output, const Renderer* pictures,
  BuildTrace& trace)
{
  const Interrupt interrupt([&output] { output.discard(); });
  const std::filesystem::path out = output.stage();
  Recording recording;
  recording.rated = plan.validity;
  recording.scene = trace.build("law", "tissue and tool", [&] { return sceneOf(plan, chained); });
  const std::filesystem::path& file = plan.device.file;
  const std::string text = readText(file, "the CSV file"); // once: it may be a pipe
  const ScriptedPath path =
    trace.build("path", "moves the tool", [&] { return parsePath(text, file.string()); });
  const std::string& device = plan.device.name;
  recording.device = device.substr(0, device.find(':') + 1) + file.filename().string();
  std::optional<Calibration> calibration;
  if (plan.dents())
  {
    calibration = trace.build("calibration", "how far the surface gives way",
      [&] { return loadCalibration(plan.press, recording.scene.law); });
  }
  const SceneBody body = loadTold(plan, text, trace);
  if (calibration && !calibration->note.empty())
  {
    std::cerr << "palp: " << calibration->note << '\n';
  }
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.files = body.files;
  recording.command = commandLine();
  recording.scene.surface = body.haptic;

  recording.samples = trace.build("press", "force at every millisecond",
    [&]
    {
      const ProgressLine progress("pressing along the path");
      return play(path, recording.scene, chained);
    });
  const Calibration* known = calibration ? &*calibration : nullptr;
  tell(recording, known);
  const ProgressLine progress("writing");
  if (plan.samples)
  {
    trace.build(
      "samples.csv", "exported", [&] { writeSamples(out / "samples.csv", recording, known); });
  }
  if (plan.deformed)
  {
    trace.build("deformed.vtp", "exported",
      [&] { writeDeformed(out / "deformed.vtp", body, recording, *known, plan.refined); });
  }
  if (plan.draws())
  {
    trace.build(
      "pictures", "exported", [&] { pictures->drawPress(body, recording, known, plan, out); });
  }
  output.publish();
  explainOmissions(plan, trace);
}

} // namespace palp
