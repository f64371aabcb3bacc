#include "app/train/curriculum.h"

#include "app/input/json_object.h"
#include "app/input/quantity.h"
#include "app/program/data_files.h"
#include "app/train/training_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>

namespace palp
{
namespace
{

using namespace units::literals;
using Span = TrainingLevel::Span;

constexpr Bounds kRadius{ 1.0_mm, 8.0_mm, "1mm to 8mm, as far as nodules are known" };
constexpr Bounds kCover{ 2.0_mm, 50.0_mm,
  "2mm to 50mm, as nodules nearer to the surface are not known" };
constexpr Bounds kLength{ 1.0_mm, 100.0_mm, "1mm to 100mm" };
constexpr Bounds kForce{ 0.1, 100.0, "0.1N to 100N" };

// a value that is refused under its key
template <typename Value>
Value valueAt(JsonObject& object, const char* key, const std::function<Value()>& parse)
{
  try
  {
    return parse();
  }
  catch (const Error& error)
  {
    object.refuse(key, error.what());
  }
}

double quantityAt(JsonObject& object, const char* key, Quantity kind, const Bounds& bounds)
{
  return valueAt<double>(
    object, key, [&] { return parseWithin(object.text(key, ""), kind, bounds, key); });
}

double numberAt(JsonObject& object, const char* key, const Bounds& bounds)
{
  const auto value =
    valueAt<double>(object, key, [&] { return parseNumber(object.number(key, ""), key); });
  if (!(value >= bounds.least && value <= bounds.most))
  {
    object.refuse(key, "is out of range; give " + std::string(bounds.inWords));
  }
  return value;
}

Span spanAt(
  JsonObject& object, const char* key, const std::function<double(const std::string&)>& parse)
{
  const std::vector<std::string> ends = object.texts(key, {});
  if (ends.size() != 2)
  {
    object.refuse(key, R"(give the least and the most, as in ["2mm", "4mm"])");
  }
  const auto span = valueAt<Span>(object, key,
    [&] {
      return Span{ parse(ends[0]), parse(ends[1]) };
    });
  if (span.low > span.high)
  {
    object.refuse(key, "is not from low to high; swap them");
  }
  return span;
}

TrainingLevel readLevel(JsonObject object)
{
  const auto length = [](const char* key, const Bounds& bounds)
  {
    return [=](const std::string& text)
    { return parseWithin(text, Quantity::Length, bounds, key); };
  };
  const auto ratio = [](const std::string& text)
  {
    const double value = parseNumber(text, "ratio");
    if (!(value >= 0.2 && value <= 50.0))
    {
      throw Error(ErrorCode::BadValue, "ratio: is out of range; give 0.2 to 50");
    }
    return value;
  };
  TrainingLevel level{ .name = object.text("name", ""),
    .title = object.text("title", ""),
    .nodules = valueAt<int>(
      object, "nodules", [&] { return parseNoduleCount(object.number("nodules", ""), "nodules"); }),
    .radius = spanAt(object, "radius", length("radius", kRadius)),
    .cover = spanAt(object, "cover", length("cover", kCover)),
    .ratio = spanAt(object, "ratio", ratio),
    .depth = quantityAt(object, "depth", Quantity::Length, kLength),
    .contrast = numberAt(object, "contrast", { 0.01, 10.0, "0.01 to 10" }) };
  object.finish();
  return level;
}

} // namespace

const TrainingLevel& Curriculum::level(const std::string& name, const std::string& what) const
{
  const auto found = std::ranges::find(levels, name, &TrainingLevel::name);
  if (found == levels.end())
  {
    throw Error(ErrorCode::BadValue,
      what + ": " + inQuotes(name) + " is no level; expected one of " +
        listed(levels, &TrainingLevel::name));
  }
  return *found;
}

std::string Curriculum::levelAfter(const std::string& name) const
{
  const auto found = std::ranges::find(levels, name, &TrainingLevel::name);
  return found == levels.end() || std::next(found) == levels.end() ? "" : std::next(found)->name;
}

Curriculum parseCurriculum(const std::string& text, const std::string& file)
{
  const nlohmann::json document = parseJson(text, file);
  JsonObject whole(document, file);
  if (!whole.isNumber("palp_training", 1.0))
  {
    whole.refuse("palp_training", "must be 1, the version of levels that this program reads");
  }
  Curriculum all{ .hitWithin = quantityAt(whole, "hit_within", Quantity::Length, kLength),
    .hardForce = quantityAt(whole, "too_hard", Quantity::Force, kForce),
    .mostFalseMarks =
      static_cast<int>(numberAt(whole, "most_false_marks", { 0.0, 100.0, "0 to 100" })),
    .levels = {} };
  for (const JsonObject& object : whole.objects("levels"))
  {
    all.levels.push_back(readLevel(object));
  }
  whole.finish();
  if (all.levels.empty())
  {
    whole.refuse("levels", "give at least one");
  }
  return all;
}

Curriculum shippedCurriculum()
{
  return parseCurriculum(
    readText(dataFile(kCurriculumFile), "the levels of a training"), kCurriculumFile);
}

} // namespace palp
