#include "app/places/met_organ.h"

#include "app/places/placed_press.h"
#include "haptics/contact/find_contact.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <utility>

namespace palp
{
namespace
{

std::string whereOf(const PressPlace& place, const std::string& asked)
{
  return "the place " + inWords(place) + " is on " + printable(asked) + ", but ";
}

} // namespace

void checkStart(
  const PressPlace& place, int asked, const ToolPose& start, const Recording& recording)
{
  for (int i = 0; i < organCount(recording.scene); ++i)
  {
    const Scene& organ = organOf(recording.scene, i);
    if (i != asked && findContact(organ, start).touching())
    {
      const std::string covering = printable(recording.organName(i));
      throw Error(ErrorCode::BadValue,
        whereOf(place, recording.organName(asked)) + "a tool comes to it through " + covering +
          " only; give a place on " + covering + ", or give that a role other than press");
    }
  }
}

std::string noteOfOrgan(const PressPlace& place, const std::string& asked, const std::string& met)
{
  const std::string other = printable(met);
  return met == asked ? ""
                      : whereOf(place, asked) + "the tool meets " + other +
      " first and presses that; give " + other + " a role other than press, or take a smaller tool";
}

void AwaitedPress::begin(
  const PlacedPresses& presses, const Recording& recording, const PressLog& log)
{
  place_.reset();
  if (recording.scene.others.empty())
  {
    return;
  }
  const PressPlace& place = presses.places.front();
  const int asked = organAt(place, presses, recording.scene);
  const ScriptedPath path = pathsOf(presses, recording.scene).front();
  checkStart(place, asked, path.poseAt(0.0, -Eigen::Vector3d::UnitZ()), recording);
  place_ = place;
  asked_ = recording.organName(asked);
  before_ = log.presses().empty() ? 0 : log.presses().back().id;
}

std::string AwaitedPress::end(const PressLog& log)
{
  const KeptPress* deepest = nullptr;
  for (const KeptPress& press : log.presses())
  {
    const double depth = deepest != nullptr ? deepest->summary.deepest.depth : 0.0;
    deepest = press.id > before_ && press.summary.deepest.depth > depth ? &press : deepest;
  }
  const std::optional<PressPlace> place = std::exchange(place_, std::nullopt);
  return place && deepest != nullptr ? noteOfOrgan(*place, asked_, deepest->organ) : "";
}

} // namespace palp
