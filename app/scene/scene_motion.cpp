#include "app/scene/scene_motion.h"

#include "app/scene/scene_entries.h"
#include "app/train/training_text.h"
#include "haptics/files/input_text.h"

namespace palp
{
namespace
{

PressPlace readPlace(JsonObject object)
{
  PressPlace place{ .name = object.text("name", ""), .position = {} };
  if (!object.has("at"))
  {
    object.refuse("at", R"(missing; give the place, as in ["-45mm", "12.5mm", "30mm"])");
  }
  place.position = triple(object, "at", Quantity::Length, kSceneReach);
  object.finish();
  return place;
}

PlacedPresses readPresses(JsonObject object)
{
  PlacedPresses presses;
  for (const JsonObject& place : object.objects("places"))
  {
    presses.places.push_back(readPlace(place));
  }
  parseAt(object, "depth", [&](const std::string& text) { presses.depth = parsePressDepth(text); });
  parseAt(
    object, "toward", [&](const std::string& text) { presses.toward = parseDirection(text); });
  parseAt(object, "speed", [&](const std::string& text) { presses.speed = parsePressSpeed(text); });
  object.finish();
  if (presses.places.empty())
  {
    object.refuse("places", R"(give at least one, as in [{"at": ["1mm", "2mm", "3mm"]}])");
  }
  return presses;
}

RecordedPress readRecording(JsonObject object, const std::filesystem::path& folder)
{
  RecordedPress recording{ .file = (folder / object.text("file", "samples.csv")).lexically_normal(),
    .device = object.text("device", "mouse"),
    .names = object.texts("names", {}) };
  object.finish();
  return recording;
}

// what moves the tool in the place of a device
void readReplacement(JsonObject& object, ScenePlan& plan, const std::filesystem::path& folder)
{
  if (object.has("presses"))
  {
    plan.presses = readPresses(object.object("presses"));
  }
  if (object.has("recording"))
  {
    plan.recording = readRecording(object.object("recording"), folder);
  }
  if (object.has("device") + object.has("presses") + object.has("recording") > 1)
  {
    object.refuse(
      "device", "one thing moves the tool; give a device, or presses, or a recording, not two");
  }
}

DeviceChoice readDevice(JsonObject& scene, const char* entry, const std::string& name,
  const std::filesystem::path& folder)
{
  const DeviceChoice choice = parseDevice(name);
  if (choice.isScript() && choice.file.empty())
  {
    scene.refuse(entry, inQuotes(name) + " names no file; write " + name + "FILE.csv");
  }
  return choice.isScript() ? parseDevice(name.substr(0, name.find(':') + 1) +
                               (folder / choice.file).lexically_normal().string())
                           : choice;
}

// of another hand
void readSecond(JsonObject& scene, ScenePlan& plan, const std::filesystem::path& folder)
{
  if (const std::string name = scene.text("second_device", ""); !name.empty())
  {
    plan.second = readDevice(scene, "second_device", name, folder);
    checkAt(scene, "second_device", [&] { checkHands(plan.device, *plan.second); });
  }
}

} // namespace

TrainingPlan readTraining(JsonObject object)
{
  TrainingPlan training;
  training.level = object.text("level", training.level);
  parseAt(
    object, "seed", [&](const std::string& text) { training.seed = parseSeed(text); },
    &JsonObject::number);
  parseAt(
    object, "nodules", [&](const std::string& text) { training.nodules = parseNoduleCount(text); },
    &JsonObject::number);
  parseAt(object, "side",
    [&](const std::string& text) { training.side = parseDirection(text, "--side"); });
  if (object.has("marks"))
  {
    training.marks.emplace();
    for (const std::string& text : object.texts("marks", {}))
    {
      checkAt(object, "marks",
        [&]
        {
          training.marks->push_back(
            parseWithin(text, Quantity::Time, { 0.0, 1e9, "0s or more" }, "--marks"));
        });
    }
  }
  object.finish();
  return training;
}

CameraPlace readCamera(JsonObject object)
{
  CameraPlace camera{ .position = triple(object, "position", Quantity::Length, kCameraReach),
    .focus = triple(object, "focus", Quantity::Length, kCameraReach),
    .up = triple(object, "up", Quantity::Length, kCameraReach) };
  object.finish();
  if (camera.up.cross(camera.position - camera.focus).isZero(0.0))
  {
    object.refuse("up", "lies along the line of sight; give another position, focus or up");
  }
  return camera;
}

void readMotion(JsonObject& scene, ScenePlan& plan, const std::filesystem::path& folder)
{
  readReplacement(scene, plan, folder);
  plan.device = readDevice(scene, "device", scene.text("device", "mouse"), folder);
  readSecond(scene, plan, folder);
  plan.deadMan = scene.flag("dead_man", false);
  plan.window = scene.flag("window", !plan.isKnown());
  plan.chain = scene.flag("chain", false);
  if (plan.chain && plan.window)
  {
    scene.refuse("chain", "a window has the chain of its device; leave this out");
  }
  if (plan.second && !plan.window)
  {
    scene.refuse("second_device", "two hands press in a window only; set window to true");
  }
  if (!plan.window && !plan.isKnown())
  {
    scene.refuse("window", inQuotes(plan.device.name) + " moves in a window only; give true");
  }
}

} // namespace palp
