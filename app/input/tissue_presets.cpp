#include "app/input/tissue_presets.h"

#include "app/input/json_object.h"
#include "app/input/quantity.h"
#include "app/program/data_files.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"
#include "haptics/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{
namespace
{

std::string textAt(JsonObject& object, const char* key)
{
  std::string text = object.text(key, "");
  if (text.empty())
  {
    object.refuse(key, "is missing; give a text, \"...\"");
  }
  return text;
}

double modulusAt(JsonObject& object, const char* key)
{
  const std::string text = textAt(object, key);
  try
  {
    return parseQuantity(text, Quantity::Pressure, "modulus");
  }
  catch (const Error& error)
  {
    object.refuse(key, error.what());
  }
}

Material materialAt(JsonObject& object, double young)
{
  try
  {
    return makeMaterial(young, parseNumber(object.number("poisson", ""), "ratio"));
  }
  catch (const Error& error)
  {
    object.refuse("poisson", error.what());
  }
}

TissuePreset readTissue(JsonObject object)
{
  const bool isShear = object.has("shear");
  const char* key = isShear ? "shear" : "young";
  const double factor = isShear ? kYoungOverShear : 1.0;
  const auto end = [&](const char* name)
  { return object.has(name) ? std::optional(factor * modulusAt(object, name)) : std::nullopt; };
  TissuePreset tissue{ .name = textAt(object, "name"),
    .title = textAt(object, "title"),
    .material = materialAt(object, factor * modulusAt(object, key)),
    .low = end("low"),
    .high = end("high"),
    .spread = textAt(object, "spread"),
    .method = textAt(object, "method"),
    .source = textAt(object, "source"),
    .note = object.text("note", "") };
  object.finish();
  const double young = tissue.material.youngModulus;
  if (tissue.low.value_or(young) > young || tissue.high.value_or(young) < young)
  {
    object.refuse(key, "is not from low to high; mend one of them");
  }
  return tissue;
}

// letters to insert, leave out or replace
std::size_t editsBetween(std::string_view a, std::string_view b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row.back();
}

std::string nearestNames(std::string_view name, std::span<const TissuePreset> tissues)
{
  constexpr std::size_t kNames = 3;
  std::vector<std::string> names;
  std::ranges::transform(tissues, std::back_inserter(names), &TissuePreset::name);
  std::ranges::stable_sort(
    names, {}, [name](const std::string& other) { return editsBetween(name, other); });
  names.resize(std::min(kNames, names.size()));
  return listed(names);
}

} // namespace

std::vector<TissuePreset> parseTissues(const std::string& text, const std::string& file)
{
  const nlohmann::json document = parseJson(text, file);
  JsonObject whole(document, file);
  if (!whole.isNumber("palp_tissues", 1.0))
  {
    whole.refuse("palp_tissues", "must be 1, the version of tissues that this program reads");
  }
  std::vector<TissuePreset> tissues;
  for (JsonObject& object : whole.objects("tissues"))
  {
    tissues.push_back(readTissue(object));
    const std::string& name = tissues.back().name;
    if (std::ranges::count(tissues, name, &TissuePreset::name) > 1)
    {
      object.refuse("name", inQuotes(name) + " stands twice; give each a name of its own");
    }
  }
  whole.finish();
  return tissues;
}

std::vector<TissuePreset> shippedTissues()
{
  const std::filesystem::path file = dataFile("tissues.json");
  return parseTissues(readText(file, "a list of tissues"), file.filename().string());
}

const TissuePreset& tissueNamed(
  std::string_view name, std::span<const TissuePreset> tissues, std::string_view what)
{
  const auto found = std::ranges::find(tissues, name, &TissuePreset::name);
  if (found == tissues.end())
  {
    throw Error(ErrorCode::BadValue,
      std::string(what) + ": " + inQuotes(name) + " is not known; the nearest are " +
        nearestNames(name, tissues) + ", and palp tissues lists all");
  }
  return *found;
}

std::string describeTissue(const TissuePreset& tissue)
{
  const auto kilopascals = [](double value)
  { return shortest(units::toKilopascals(std::round(value))); };
  std::string range;
  if (tissue.low)
  {
    range = tissue.high ? kilopascals(*tissue.low) + " to " + kilopascals(*tissue.high) + " kPa"
                        : "at least " + kilopascals(*tissue.low) + " kPa";
  }
  return "E " + kilopascals(tissue.material.youngModulus) + " kPa" +
    (range.empty() ? "" : " (" + range + ")") + ", " + tissue.spread + ", " + tissue.method + ": " +
    tissue.source;
}

} // namespace palp
