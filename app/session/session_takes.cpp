// The recordings and presses of a session that have ended.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/program/exec_program.h"
#include "app/scene/scene_text.h"
#include "app/session/session.h"

#include <limits>
#include <numeric>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{

void Session::save(const SceneBody& body, std::optional<Recording> press)
{
  if (autosave_ != nullptr && press)
  {
    ScenePlan plan = planOf(plan_, body, *press);
    plan.allSamples = false;
    keepContact(*press);
    autosave_->save(std::move(plan), *std::move(press));
  }
}

void Session::endRecording(const SceneBody& body)
{
  if (servo_)
  {
    drain(body, [](const Sample&) {});
    save(body, presses_.end(recording_));
  }
  if (recording_.deepest())
  {
    std::vector<Sample> samples = std::exchange(recording_.samples, {});
    earlier_.push_back({ body, recording_, calibration_ });
    earlier_.back().recording.samples = std::move(samples);
  }
  recording_.samples.clear();
  recording_.thinned = 0;
  recording_.interval = Recording{}.interval;
  resting_.reset();
}

// the one that is open, or was the last, where that is the same
SceneBody Session::bodyOf(const std::vector<MeshSource>& meshes) const
{
  const auto text = [](const std::vector<MeshSource>& sources)
  { return sceneText({ .meshes = sources }, "/"); };
  const std::string asked = text(meshes);
  if (text(body_.sources) == asked)
  {
    return body_;
  }
  const bool wasLast = !earlier_.empty() && text(earlier_.back().body.sources) == asked;
  return wasLast ? earlier_.back().body : loadBody(meshes);
}

std::size_t Session::addTake(const ExportFolder& folder)
{
  const ScenePlan& made = folder.plan;
  const ForceLaw law = made.press.tissue.law();
  Take take{
    .body = bodyOf(made.meshes), .recording = {}, .calibration = loadCalibration(made.press, law)
  };
  Recording& recording = take.recording;
  recording.mesh = take.body.name;
  recording.unit = take.body.unit;
  recording.files = take.body.files;
  checkInputs(folder, made, recording);
  recording.command = commandLine();
  recording.rated = made.validity;
  recording.scene = recording_.scene;
  recording.scene.surface = take.body.haptic;
  recording.scene.law = law;
  recording.scene.rule = made.press.contact;
  recording.scene.damping = made.press.damping;
  recording.scene.nodules = feltNodules(take.body, law);
  recording.scene.forceLimit = std::numeric_limits<double>::infinity();
  std::optional<ScriptedPath> path;
  if (!made.presses && !made.recording)
  {
    path = readPath(made.device.file);
  }
  playInto(recording, made, path ? &*path : nullptr);
  const std::size_t found = presses_.keepAll(recording);
  earlier_.push_back(std::move(take));
  return found;
}

void Session::boundEarlier()
{
  const auto samples = [this]
  {
    return std::accumulate(earlier_.begin(), earlier_.end(), recording_.samples.size(),
      [](std::size_t sum, const Take& take) { return sum + take.recording.samples.size(); });
  };
  for (Take& take : earlier_)
  {
    if (samples() > kKeptWhole && take.recording.thinned == 0)
    {
      thin(take.recording);
    }
  }
  while (!earlier_.empty() && samples() > 2 * kKeptWhole)
  {
    earlier_.erase(earlier_.begin());
  }
}

} // namespace palp
