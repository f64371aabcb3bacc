#include "app/folder/played_plan.h"

#include "app/input/mesh_file.h"
#include "app/input/tip_text.h"
#include "app/places/placed_press.h"
#include "app/press/playback.h"
#include "app/press/recorded_rows.h"

#include <algorithm>
#include <iterator>

namespace palp
{

void playInto(Recording& recording, const ScenePlan& plan, const ScriptedPath* path)
{
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
    for (const PressPlace& place : plan.presses->places)
    {
      recording.names.push_back(place.name);
    }
    recording.samples =
      playEach(pathsOf(*plan.presses, recording.scene), recording.scene, plan.chain);
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
  plan.recording = RecordedPress{ .device = recording.device, .names = recording.names };
  plan.chain = false;
  plan.window = false;
  return plan;
}

} // namespace palp
