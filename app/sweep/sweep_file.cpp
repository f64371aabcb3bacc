#include "app/sweep/sweep_file.h"

#include "app/input/json_object.h"
#include "app/program/data_files.h"
#include "app/sweep/range_keys.h"
#include "app/sweep/sweep_range.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <set>

namespace palp
{
namespace
{

using nlohmann::json;

constexpr std::size_t kMostSeed = 1ULL << 53U; // that every program writes as it is

const std::vector<std::string> kKinds{ "calibrate", "force", "run" };

// a value as an option takes it; a flag is true or false
std::string valueText(const JsonObject& at, const std::string& key, const json& value)
{
  if (value.is_boolean())
  {
    return value.get<bool>() ? "true" : "false";
  }
  if (value.is_number())
  {
    return shortest(value.get<double>());
  }
  if (!value.is_string())
  {
    at.refuse(key, "must be a value: a text with its unit, a number, true or false");
  }
  std::string text = value.get<std::string>();
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  if (text.empty() || text != printable(text))
  {
    at.refuse(key, "is empty or has control characters; write the value as on the command line");
  }
  for (std::size_t open = text.find('{'); open != text.npos; open = text.find('{', open))
  {
    const bool isBrace = text.substr(open, 2) == "{{";
    const std::size_t end = isBrace ? open + 1 : text.find('}', open);
    if (end == text.npos)
    {
      at.refuse(key, inQuotes(text) + " has { without }; write {name}, or {{ for a brace");
    }
    open = end + 1;
  }
  return text;
}

std::vector<std::string> valueList(const JsonObject& at, const std::string& key, const json& list)
{
  std::vector<std::string> values;
  for (const json& value : list)
  {
    values.push_back(valueText(at, key, value));
  }
  if (values.empty())
  {
    at.refuse(key, "is an empty list; give one value or more");
  }
  return values;
}

std::vector<std::string> valuesOf(const JsonObject& at, const std::string& path,
  const std::string& key, const json& value, const std::string& file)
{
  if (value.is_array())
  {
    return valueList(at, key, value);
  }
  if (value.is_object())
  {
    return rangeValues({ value, file, path + "/" + key });
  }
  at.refuse(key, R"(must be a list of values, or a range {"from": .., "to": .., "count": ..})");
}

// the parts of a sweep, and whether a name stands in two of them
class Reader
{
public:
  Reader(const json& document, std::string file)
    : document_(document)
    , file_(std::move(file))
  {
  }

  void readFixed(Sweep& sweep)
  {
    forEach("fixed",
      [&](const JsonObject& at, const std::string& key, const json& value)
      { sweep.fixed[key] = valueText(at, key, value); });
  }

  void readGrid(Sweep& sweep)
  {
    forEach("grid",
      [&](const JsonObject& at, const std::string& key, const json& value)
      {
        SweepAxis& axis = sweep.axes.emplace_back(SweepAxis{ { key }, {} });
        for (const std::string& one : valuesOf(at, "/grid", key, value, file_))
        {
          axis.rows.push_back({ one });
        }
      });
  }

  void readZip(Sweep& sweep)
  {
    SweepAxis axis;
    forEach("zip",
      [&](const JsonObject& at, const std::string& key, const json& value)
      {
        const auto values = valuesOf(at, "/zip", key, value, file_);
        if (!axis.names.empty() && values.size() != axis.rows.size())
        {
          at.refuse(key,
            "has " + std::to_string(values.size()) + " values and '" + axis.names.front() + "' " +
              std::to_string(axis.rows.size()) + "; what is zipped has as many of each");
        }
        axis.names.push_back(key);
        axis.rows.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          axis.rows[i].push_back(values[i]);
        }
      });
    keep(sweep, std::move(axis));
  }

  void readHypercube(Sweep& sweep)
  {
    if (!document_.contains("latin_hypercube"))
    {
      return;
    }
    const char* path = "/latin_hypercube";
    JsonObject object(document_["latin_hypercube"], file_, path);
    refuseUnknown(object, { "count", "seed", "ranges" });
    const std::size_t count = countOf(object, "count", 1, ", of the samples");
    const std::size_t seed =
      countOf(object, "seed", 0, "; each gives other samples, and always the same ones", kMostSeed);
    (void)object.object("ranges");
    SweepAxis axis;
    std::vector<SweepRange> ranges;
    const json& parts = document_["latin_hypercube"].value("ranges", json::object());
    for (const auto& [key, value] : parts.items())
    {
      once(object, key);
      JsonObject range(value, file_, std::string(path) + "/ranges/" + key);
      refuseUnknown(range, { "from", "to", "scale" });
      ranges.push_back(rangeOf(range));
      axis.names.push_back(key);
    }
    axis.rows = latinHypercube(ranges, axis.names.empty() ? 0 : count, seed);
    keep(sweep, std::move(axis));
  }

private:
  template <typename Take>
  void forEach(const char* part, Take take)
  {
    if (document_.contains(part))
    {
      const JsonObject at(document_[part], file_, "/" + std::string(part));
      for (const auto& [key, value] : document_[part].items())
      {
        once(at, key);
        take(at, key, value);
      }
    }
  }

  void once(const JsonObject& at, const std::string& key)
  {
    if (!names_.insert(key).second)
    {
      at.refuse(key, "stands in another part, too; keep one");
    }
  }

  static void keep(Sweep& sweep, SweepAxis axis)
  {
    if (!axis.names.empty())
    {
      sweep.axes.push_back(std::move(axis));
    }
  }

  const json& document_;
  std::string file_;
  std::set<std::string> names_;
};

// of a picture, before its ending
bool isFileName(const std::string& name)
{
  const auto isPlain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && isPlain(name.front()) &&
    std::ranges::all_of(name, [&](char c) { return isPlain(c) || c == '-' || c == '_'; });
}

SweepPlot readPlot(JsonObject object, const json& value)
{
  SweepPlot plot{ .name = object.text("name", ""),
    .title = object.text("title", ""),
    .x = object.text("x", ""),
    .y = object.text("y", ""),
    .curves = object.text("curves", ""),
    .colors = object.text("colors", "") };
  JsonObject where = object.object("where");
  object.finish();
  if (!isFileName(plot.name))
  {
    object.refuse("name",
      inQuotes(plot.name) +
        " names no file; give letters, digits, - and _, a letter or digit first");
  }
  if (plot.x.empty() || plot.y.empty())
  {
    object.refuse(plot.x.empty() ? "x" : "y", "is missing; give a column of the merged table");
  }
  if (!plot.curves.empty() && !plot.colors.empty())
  {
    object.refuse("colors", "a plot has curves or is a map of colors; give one of them");
  }
  const json rows = value.value("where", json::object());
  for (const auto& [key, cell] : rows.items())
  {
    plot.where[key] = valueText(where, key, cell);
  }
  return plot;
}

} // namespace

std::filesystem::path sweepFile(const std::string& name)
{
  const bool shipped = !std::filesystem::exists(name) && name.find_first_of("./") == name.npos;
  return shipped ? dataFile("sweeps/" + name + ".json") : std::filesystem::path(name);
}

Sweep readSweepFile(const std::string& name)
{
  const std::filesystem::path path = sweepFile(name);
  const std::string file = path.filename().string();
  const json document = parseJson(readText(path, "a sweep in JSON"), file);
  if (document.is_array())
  {
    throw Error(ErrorCode::BadFile,
      file +
        ": is a list of cases, as sweeps once were; write {\"palp_sweep\": 1, \"kind\": "
        "\"calibrate\", \"zip\": {...}}, as data/sweeps/sweep.schema.json describes");
  }
  JsonObject object(document, file);
  if (!object.isNumber("palp_sweep", 1.0))
  {
    object.refuse("palp_sweep", "must be 1, the version of sweeps that this program reads");
  }
  (void)object.text("$schema", "");
  Sweep sweep{ .file = file, .title = {}, .kind = {} };
  sweep.title = printable(object.text("title", path.stem().string()));
  sweep.kind = kKinds[object.choice("kind", object.text("kind", ""), kKinds)];
  for (const char* part : { "fixed", "grid", "zip", "latin_hypercube" })
  {
    (void)object.object(part);
  }
  const auto plots = object.objects("plots");
  object.finish();
  Reader reader(document, file);
  reader.readFixed(sweep);
  reader.readGrid(sweep);
  reader.readZip(sweep);
  reader.readHypercube(sweep);
  for (std::size_t i = 0; i < plots.size(); ++i)
  {
    SweepPlot plot = readPlot(plots[i], document["plots"][i]);
    if (std::ranges::find(sweep.plots, plot.name, &SweepPlot::name) != sweep.plots.end())
    {
      plots[i].refuse("name", "is another plot's, too; each has a file of its own");
    }
    sweep.plots.push_back(std::move(plot));
  }
  if (sweep.count() > kMostCases)
  {
    object.refuse(
      "grid", "more than " + std::to_string(kMostCases) + " cases; make several sweeps");
  }
  return sweep;
}

} // namespace palp
