#include "app/sweep/range_keys.h"

#include "app/input/json_object.h"
#include "app/sweep/sweep.h"
#include "haptics/files/input_text.h"

#include <cmath>

namespace palp
{
namespace
{

NumberText endOf(JsonObject& object, const char* key)
{
  const std::string text = object.number(key, "");
  const auto end = numberText(text);
  if (!end)
  {
    object.refuse(key, inQuotes(text) + " is no number with a unit; write one, as in 10mm");
  }
  return *end;
}

} // namespace

std::size_t countOf(
  JsonObject& object, const char* key, std::size_t least, const std::string& why, std::size_t most)
{
  const auto count = numberText(object.number(key, ""));
  if (!count || !count->unit.empty() || count->number != std::floor(count->number) ||
    count->number < static_cast<double>(least) || count->number > static_cast<double>(most))
  {
    object.refuse(key,
      "must be a whole number, " + std::to_string(least) + " to " + std::to_string(most) + why);
  }
  return static_cast<std::size_t>(count->number);
}

void refuseUnknown(JsonObject& object, std::initializer_list<const char*> keys)
{
  for (const char* key : keys)
  {
    (void)object.has(key);
  }
  object.finish();
}

SweepRange rangeOf(JsonObject& object)
{
  const NumberText from = endOf(object, "from");
  const NumberText to = endOf(object, "to");
  if (from.unit != to.unit)
  {
    object.refuse("to", "has another unit than \"from\"; write both in one");
  }
  SweepRange range{ from.number, to.number, from.unit };
  range.logarithmic =
    object.choice("scale", object.text("scale", "linear"), { "linear", "log" }) == 1;
  if (!(range.to > range.from))
  {
    object.refuse("to", "must be more than \"from\"");
  }
  if (range.logarithmic && range.from <= 0.0)
  {
    object.refuse("from", "must be more than 0 on a log scale");
  }
  return range;
}

std::vector<std::string> rangeValues(JsonObject object)
{
  refuseUnknown(object, { "from", "to", "scale", "count", "step" });
  const SweepRange range = rangeOf(object);
  std::size_t count = 0;
  if (object.has("step") == object.has("count"))
  {
    object.refuse("count", "give the count of values, or the step between them");
  }
  if (object.has("count"))
  {
    count = countOf(object, "count", 2, "; for one value write a list, [value]");
  }
  else
  {
    const NumberText step = endOf(object, "step");
    const double steps = (range.to - range.from) / step.number;
    const double whole = std::round(steps);
    if (step.unit != range.unit || !(whole >= 1.0 && whole < static_cast<double>(kMostCases)) ||
      range.logarithmic || std::abs(steps - whole) > 1e-9 * whole)
    {
      object.refuse("step", R"(must lead from "from" to "to" in whole steps, in their unit)");
    }
    count = static_cast<std::size_t>(whole) + 1;
  }
  return evenly(range, count);
}

} // namespace palp
