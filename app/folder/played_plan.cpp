#include "app/folder/played_plan.h"

#include "app/input/mesh_file.h"
#include "app/input/tip_text.h"
#include "app/places/met_organ.h"
#include "app/places/placed_press.h"
#include "app/press/playback.h"
#include "app/press/presses.h"
#include "app/press/recorded_rows.h"
#include "app/supports/support_text.h"
#include "haptics/files/csv_text.h"

#include <algorithm>
#include <iterator>

namespace palp
{

namespace
{

// @return  notes on those that met another organ than that of their place
std::vector<std::string> pressPlaces(
  Recording& recording, const PlacedPresses& presses, bool isChained)
{
  const Scene& scene = recording.scene;
  const std::vector<ScriptedPath> paths = pathsOf(presses, scene);
  std::vector<int> asked;
  for (const PressPlace& place : presses.places)
  {
    recording.names.push_back(place.name.empty() ? pressName(asked.size()) : place.name);
    const ToolPose start = paths[asked.size()].poseAt(0.0, -Eigen::Vector3d::UnitZ());
    asked.push_back(organAt(place, presses, scene));
    checkStart(place, asked.back(), start, recording);
  }
  std::vector<std::string> notes;
  std::size_t next = 0;
  recording.samples = playEach(paths, scene, isChained,
    [&](std::span<const Sample> samples)
    {
      const std::size_t i = next++;
      const Sample* deepest = deepestOf(samples);
      const int met = deepest != nullptr ? deepest->organ : asked[i];
      notes.push_back(
        noteOfOrgan(presses.places[i], recording.organName(asked[i]), recording.organName(met)));
    });
  std::erase(notes, "");
  return notes;
}

// on tissues that have another Poisson's ratio than their organ file
std::vector<std::string> otherPoissons(const Recording& recording)
{
  std::vector<std::string> notes;
  for (int i = 0; i < organCount(recording.scene); ++i)
  {
    const Scene& organ = organOf(recording.scene, i);
    if (organ.series != nullptr &&
      organ.series->otherPoisson(organ.law) > SeriesBody::kOtherPoisson)
    {
      const std::string name = recording.organName(i);
      const std::string told = shortest(organ.series->field->poissonRatio());
      notes.push_back((name.empty() ? "" : name + ": ") +
        "the organ file is of a Poisson's ratio of " + told + ", and the tissue of " +
        shortest(organ.law.material().poissonRatio) +
        ", by which forces are off by some percent; give --poisson " + told +
        ", or make the file of the other by palp organ --poisson");
    }
  }
  return notes;
}

} // namespace

std::vector<std::string> playInto(
  Recording& recording, const ScenePlan& plan, const ScriptedPath* path)
{
  std::vector<std::string> notes = otherPoissons(recording);
  const std::string& device = plan.device.name;
  if (plan.recording)
  {
    recording.device = plan.recording->device;
    recording.names = plan.recording->names;
    readRows(recording, plan.recording->file);
  }
  else if (plan.presses)
  {
    recording.device = "given places";
    std::ranges::move(pressPlaces(recording, *plan.presses, plan.chain), std::back_inserter(notes));
  }
  else if (path)
  {
    recording.device =
      device.substr(0, device.find(':') + 1) + plan.device.file.filename().string();
    recording.samples = play(*path, recording.scene, plan.chain);
  }
  if (!plan.allSamples)
  {
    keepContact(recording);
  }
  return notes;
}

std::vector<std::filesystem::path> inputsOf(const ScenePlan& plan)
{
  std::vector<std::filesystem::path> inputs = plan.sources;
  std::ranges::copy(plan.referenceFiles, std::back_inserter(inputs));
  for (const MeshSource& mesh : plan.meshes)
  {
    std::ranges::copy(filesBehind(mesh.file), std::back_inserter(inputs));
    inputs.push_back(mesh.haptic);
    std::ranges::copy(filesBehind(mesh.stiffness.file), std::back_inserter(inputs));
    inputs.push_back(mesh.organ);
    std::ranges::transform(mesh.supports, std::back_inserter(inputs), pointsOfSupport);
  }
  inputs.push_back(plan.device.file);
  inputs.push_back(plan.recording ? plan.recording->file : std::filesystem::path());
  inputs.push_back(plan.press.dent.table);
  inputs.push_back(fileOf(plan.press.tissue.tip));
  std::erase(inputs, std::filesystem::path());
  return inputs;
}

ScenePlan planOf(const ScenePlan& opened, const SceneBody& body, const Recording& recording)
{
  ScenePlan plan = opened;
  plan.meshes = body.sources;
  plan.organs = recording.organs;
  plan.press.tissue = optionsOf(recording.scene.law, recording.rated);
  plan.press.contact = recording.scene.rule;
  plan.press.damping = recording.scene.damping;
  plan.validity = recording.rated;
  plan.training = body.training;
  plan.device = {};
  plan.second.reset();
  plan.recording = RecordedPress{ .device = recording.device, .names = recording.names };
  plan.chain = false;
  plan.window = false;
  plan.samples = plan.deformed = plan.picture = true; // a window's scene says none of them
  return plan;
}

} // namespace palp
