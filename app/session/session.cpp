#include "app/session/session.h"

#include "app/program/build_trace.h"
#include "app/program/exec_program.h"
#include "app/session/live_bodies.h"

#include <utility>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// a tool that nobody moves, away from the surface
bool restsAt(const Sample& before, const Sample& now)
{
  constexpr double kLength = 1e-7; // [m], less than any device tells
  constexpr double kAngle = 1e-6;  // [rad]
  const bool touches = before.contact.touching() || now.contact.touching();
  return !touches && before.force.isZero() && now.force.isZero() && before.flags == now.flags &&
    before.state == now.state && (before.pose.apex - now.pose.apex).norm() < kLength &&
    (before.pose.axis - now.pose.axis).norm() < kAngle;
}

// a search alone is not rated, what comes after it is
ScenePlan ratedOnceGraded(ScenePlan plan)
{
  if (plan.training && plan.training->marks)
  {
    plan.validity = plan.press.tissue.options.rated = true;
  }
  return plan;
}

// what is recorded of a press that has not begun
Recording startOf(const ScenePlan& plan, const SceneBody& body, BuildTrace& trace)
{
  Recording recording;
  recording.mesh = body.name;
  recording.unit = body.unit;
  recording.files = body.files;
  recording.command = commandLine();
  recording.rated = plan.validity && !body.training;
  recording.organs = plan.organs;
  recording.scene.rule = plan.press.contact;
  recording.scene.damping = plan.press.damping;
  recording.scene.law =
    trace.build("law", "tissue and tool", [&] { return plan.press.tissue.law(); });
  setTissues(recording.scene, plan.organs);
  setFelt(recording.scene, body, plan.organs);
  return recording;
}

} // namespace

Session::Session(ScenePlan plan, BuildTrace& trace, const std::atomic<bool>* stop)
  : plan_(ratedOnceGraded(std::move(plan)))
  , servoOptions_{ .period = std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::duration<double>(plan_.servoPeriod)),
    .history = plan_.records(),
    .deadMan = plan_.deadMan,
    .stop = stop }
  , body_(trace.build("surface", "felt and shown", [&] { return loadLiveBodies(plan_); }))
  , recording_(startOf(plan_, body_, trace))
  , calibration_(trace.build("calibration", "how far the surface gives way",
      [&] { return loadCalibration(plan_.press, recording_.scene); }))
{
  if (plan_.training && plan_.training->marks) // graded before
  {
    revealNodules(body_);
    recording_.rated = plan_.validity;
  }
  else if (plan_.training)
  {
    calibration_.style.extent = nullptr; // by which a dent would give away what lies below it
  }
  trace.build("device, servo thread", "the window presses live",
    [&]
    {
      useDevice(plan_.device);
      plan_.second ? useSecond(plan_.second) : void();
    });
}

ForceLaw Session::knowing(const ForceLaw& law) const
{
  if (law.settings().mode == LawMode::Corrected)
  {
    return law;
  }
  TissueOptions tissue = optionsOf(law, plan_.validity);
  tissue.options.mode = LawMode::Corrected;
  return tissue.law();
}

void Session::open(SceneBody body, std::vector<OrganPlan> organs)
{
  Scene scene = nextScene();
  if (body.isUneven())
  {
    scene.law = knowing(scene.law);
    for (OrganPlan& organ : organs)
    {
      organ.press.tissue.options.mode = LawMode::Corrected;
    }
  }
  scene.others.clear();
  scene.rule = organs.empty() ? scene.rule : organs.front().press.contact;
  setTissues(scene, organs);
  setFelt(scene, body, organs);
  Calibration calibration = loadCalibration(plan_.press, scene);
  SceneBody old = std::exchange(body_, std::move(body));
  std::vector<std::unique_ptr<Device>> devices;
  try
  {
    for (std::size_t i = 0; i < hands_.size(); ++i)
    {
      devices.push_back(makeDevice(i, DeviceChoice(hands_[i].choice)));
    }
  }
  catch (...)
  {
    body_ = std::move(old);
    keepHolding();
    throw;
  }
  endRecording(old);
  stopServos();
  calibration_ = std::move(calibration);
  recording_.mesh = body_.name;
  recording_.unit = body_.unit;
  recording_.files = body_.files;
  recording_.organs = std::move(organs);
  recording_.rated = plan_.validity;
  recording_.scene = std::move(scene);
  followTissue(calibration_, recording_.scene);
  for (std::size_t i = 0; i < devices.size(); ++i)
  {
    give(i, DeviceChoice(hands_[i].choice), std::move(devices[i]));
  }
  startServos();
}

void Session::update(const std::function<void(const Sample&)>& each)
{
  drain(body_, each);
}

void Session::drain(const SceneBody& body, const std::function<void(const Sample&)>& each)
{
  for (Hand& hand : hands_)
  {
    hand.servo->history().drain(
      [&](const Sample& sample)
      {
        if (isCurrent(sample))
        {
          record(hand, sample, each);
        }
      });
  }
  presses_.isReleased() ? save(body, presses_.keep(recording())) : void();
  disarmAtFault();
  boundAll();
}

// of a rest the first sample and the last, so that curves go level between them
void Session::record(
  Hand& hand, const Sample& sample, const std::function<void(const Sample&)>& each)
{
  const bool isFirst = &hand == &first();
  const auto tell = [&](const Sample& kept) { isFirst ? each(kept) : void(); };
  isFirst ? presses_.follow(sample) : void();
  std::vector<Sample>& kept = isFirst ? recording_.samples : recording_.second->samples;
  if (!kept.empty() && restsAt(kept.back(), sample))
  {
    hand.resting = sample;
    return;
  }
  if (hand.resting)
  {
    kept.push_back(*hand.resting);
    tell(kept.back());
    hand.resting.reset();
  }
  kept.push_back(sample);
  tell(sample);
}

} // namespace palp
