#include "app/places/met_organ.h"

#include "app/places/placed_press.h"
#include "app/press/playback.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

namespace palp
{

std::string noteOfOrgan(
  const PressPlace& place, const PlacedPresses& presses, const Recording& recording)
{
  const Scene& scene = recording.scene;
  if (scene.others.empty())
  {
    return {};
  }
  PlacedPresses one = presses;
  one.places = { place };
  const std::vector<Sample> samples = playEach(pathsOf(one, scene), scene);
  const std::string asked = printable(recording.organName(organAt(place, presses, scene)));
  const std::string start = "the place " + inWords(place) + " is on " + asked + ", but ";
  if (const Sample& first = samples.front(); first.contact.touching())
  {
    const std::string covering = printable(recording.organName(first.organ));
    throw Error(ErrorCode::BadValue,
      start + "a tool comes to it through " + covering + " only; give a place on " + covering +
        ", or give that a role other than press");
  }
  const Sample* deepest = deepestOf(samples);
  const std::string met = deepest ? printable(recording.organName(deepest->organ)) : asked;
  return met == asked ? ""
                      : start + "the tool meets " + met + " first and presses that; give " + met +
      " a role other than press, or take a smaller tool";
}

} // namespace palp
