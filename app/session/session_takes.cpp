// The recordings and presses of a session that have ended.

#include "app/folder/autosave.h"
#include "app/folder/export_folder.h"
#include "app/folder/played_plan.h"
#include "app/program/exec_program.h"
#include "app/scene/scene_text.h"
#include "app/session/live_bodies.h"
#include "app/session/session.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{

void Session::save(const SceneBody& body, std::optional<Recording> press)
{
  if (autosave_ != nullptr && press && !body.training) // hidden until it is graded
  {
    ScenePlan plan = planOf(plan_, body, *press);
    plan.allSamples = false;
    keepContact(*press);
    autosave_->save(std::move(plan), *std::move(press));
    presses_.noteSaved(autosave_->saved());
  }
  else if (body.training)
  {
    presses_.noteSaved(KeptPress::kElsewhere);
  }
}

void Session::endRecording(const SceneBody& body)
{
  if (std::ranges::all_of(hands_, [](const Hand& hand) { return hand.servo != nullptr; }))
  {
    drain(body, [](const Sample&) {});
    save(body, presses_.end(recording()));
  }
  if (recording().isTouched())
  {
    static_assert(std::is_nothrow_move_constructible_v<Take>); // samples stay where they are
    std::vector<Sample> samples = std::exchange(recording_.samples, {});
    std::optional<SecondHand> second = std::exchange(recording_.second, {});
    earlier_.push_back({ body, recording_, calibration_ });
    Recording& ended = earlier_.back().recording;
    ended.samples = std::move(samples);
    ended.second = std::move(second);
  }
  recording_.samples.empty() ? void() : readers_.wait();
  recording_.samples.clear();
  recording_.second.reset();
  recording_.thinned = 0;
  recording_.interval = Recording{}.interval;
  for (Hand& hand : hands_)
  {
    hand.resting.reset();
  }
  if (hasSecond())
  {
    recording_.second.emplace().device = hands_.back().choice.name;
  }
}

// the one that is open, or was the last, where that is the same
std::optional<SceneBody> Session::knownBody(const ScenePlan& plan) const
{
  const auto text = [](const std::vector<MeshSource>& sources)
  { return sceneText({ .meshes = sources }, "/"); };
  const auto isSame = [&, asked = text(plan.meshes)](const SceneBody& body)
  {
    return text(body.sources) == asked && body.organs.size() == plan.organs.size() &&
      body.training == plan.training;
  };
  if (isSame(body_))
  {
    return body_;
  }
  const bool wasLast = !earlier_.empty() && isSame(earlier_.back().body);
  return wasLast ? std::optional(earlier_.back().body) : std::nullopt;
}

std::function<Session::Take()> Session::takeOf(const ExportFolder& folder) const
{
  return [folder, known = knownBody(folder.plan), scene = recording_.scene]
  {
    const ScenePlan& made = folder.plan;
    SceneBody body = known ? *known : loadLiveBodies(made);
    Recording recording;
    recording.mesh = body.name;
    recording.unit = body.unit;
    recording.files = body.files;
    checkInputs(folder, made, recording);
    recording.command = commandLine();
    recording.rated = made.validity;
    recording.organs = made.organs;
    recording.scene = scene;
    recording.scene.law = made.press.tissue.law();
    recording.scene.rule = made.press.contact;
    recording.scene.damping = made.press.damping;
    recording.scene.forceLimit = std::numeric_limits<double>::infinity();
    setTissues(recording.scene, made.organs);
    setFelt(recording.scene, body, made.organs);
    Calibration calibration = loadCalibration(made.press, recording.scene);
    std::optional<ScriptedPath> path;
    if (!made.presses && !made.recording)
    {
      path = readPath(made.device.file);
    }
    playInto(recording, made, path ? &*path : nullptr);
    return Take{ std::move(body), std::move(recording), std::move(calibration), made.camera };
  };
}

void Session::noteSeen(const CameraPlace& place)
{
  for (Take& take : earlier_)
  {
    const bool isOpen = take.body.display == body_.display;
    take.seenFrom = isOpen ? std::nullopt : std::optional(take.seenFrom.value_or(place));
  }
}

std::size_t Session::add(Take take)
{
  const std::size_t found = presses_.keepAll(take.recording);
  presses_.noteSaved(KeptPress::kElsewhere);
  earlier_.push_back(std::move(take));
  return found;
}

// not while somebody copies, which takes less than a second
void Session::boundAll()
{
  constexpr std::size_t kUrgent = kKeptWhole * 7 / 6; // of 1.2 times kKeptWhole that fit
  constexpr std::size_t kAtOnce = 50'000;             // samples, in some milliseconds
  if (readers_.any() && recording_.samples.size() < kUrgent)
  {
    return;
  }
  readers_.wait();
  boundSome(recording_, kAtOnce);
  const auto samples = [this]
  {
    return std::accumulate(earlier_.begin(), earlier_.end(), recording_.sampleCount(),
      [](std::size_t sum, const Take& take) { return sum + take.recording.sampleCount(); });
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
