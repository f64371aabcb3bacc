// The recordings and presses of a session that have ended.

#include "app/folder/autosave.h"
#include "app/folder/played_plan.h"
#include "app/program/exec_program.h"
#include "app/session/session.h"

#include <limits>
#include <numeric>
#include <utility>

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

void Session::addTake(const ScenePlan& made)
{
  const ForceLaw law = made.press.tissue.law();
  Take take{ .body = body_, .recording = {}, .calibration = loadCalibration(made.press, law) };
  Recording& recording = take.recording;
  recording.mesh = body_.name;
  recording.unit = body_.unit;
  recording.files = body_.files;
  recording.command = commandLine();
  recording.rated = made.validity;
  recording.scene = recording_.scene;
  recording.scene.law = law;
  recording.scene.rule = made.press.contact;
  recording.scene.damping = made.press.damping;
  recording.scene.nodules = feltNodules(body_, law);
  recording.scene.forceLimit = std::numeric_limits<double>::infinity();
  std::optional<ScriptedPath> path;
  if (!made.presses && !made.recording)
  {
    path = readPath(made.device.file);
  }
  playInto(recording, made, path ? &*path : nullptr);
  presses_.keepAll(recording);
  earlier_.push_back(std::move(take));
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
