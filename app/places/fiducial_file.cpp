#include "app/places/fiducial_file.h"

#include "app/input/json_object.h"
#include "app/input/quantity.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/units.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <sstream>

namespace palp
{
namespace
{

[[noreturn]] void refuseFiducials(const std::string& where, const std::string& what)
{
  throw Error(ErrorCode::BadFile, where + ": " + what);
}

// what a coordinate of a list has to be multiplied with
Eigen::Vector3d signsOf(const std::string& axes, const std::string& where)
{
  if (axes == "LPS" || axes == "1")
  {
    return Eigen::Vector3d::Ones();
  }
  if (axes == "RAS" || axes == "0")
  {
    return { -1.0, -1.0, 1.0 };
  }
  refuseFiducials(where, "the axes are " + inQuotes(axes) + "; save the list in LPS or RAS");
}

// the value of a comment "# KEY = VALUE"
std::optional<std::string> valueOf(const std::string& line, const std::string& key)
{
  const std::string start = "# " + key + " = ";
  return line.starts_with(start) ? std::optional(line.substr(start.size())) : std::nullopt;
}

class FcsvReader
{
public:
  explicit FcsvReader(std::string name)
    : name_(std::move(name))
  {
  }

  std::vector<PressPlace> read(const std::string& text)
  {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
    {
      ++line_;
      line.erase(line.find_last_not_of('\r') + 1);
      if (line.starts_with('#'))
      {
        readHeader(line);
      }
      else if (!line.empty())
      {
        places_.push_back(place(csvFields(line)));
      }
    }
    return places_;
  }

private:
  [[nodiscard]] std::string where() const
  {
    return name_ + ":" + std::to_string(line_);
  }

  void readHeader(const std::string& line)
  {
    if (const auto axes = valueOf(line, "CoordinateSystem"))
    {
      signs_ = signsOf(*axes, where());
    }
    if (const auto columns = valueOf(line, "columns"))
    {
      columns_ = csvFields(*columns);
    }
  }

  [[nodiscard]] PressPlace place(const std::vector<std::string>& cells) const
  {
    if (!signs_)
    {
      refuseFiducials(where(),
        "nothing tells the axes; write '# CoordinateSystem = LPS' or RAS above the points");
    }
    const auto cell = [&](const char* column)
    {
      const auto at = std::ranges::find(columns_, column) - columns_.begin();
      return at < std::ssize(cells) ? cells[static_cast<std::size_t>(at)] : "";
    };
    PressPlace place{ .name = cell("label"), .position = {} };
    for (int i = 0; i < 3; ++i)
    {
      constexpr std::array kColumns{ "x", "y", "z" };
      const char* column = kColumns[static_cast<std::size_t>(i)];
      place.position[i] =
        (*signs_)[i] * units::fromMillimeters(parseNumber(cell(column), where() + ": " + column));
    }
    return place;
  }

  std::string name_;
  int line_ = 0;
  std::optional<Eigen::Vector3d> signs_;
  std::vector<std::string> columns_{ "id", "x", "y", "z", "ow", "ox", "oy", "oz", "vis", "sel",
    "lock", "label", "desc", "associatedNodeID" };
  std::vector<PressPlace> places_;
};

using Json = nlohmann::json;

std::string textAt(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json& listAt(const Json& object, const char* key, const std::string& where)
{
  const auto found = object.find(key);
  if (!object.is_object() || found == object.end() || !found->is_array())
  {
    refuseFiducials(where, "no list " + inQuotes(key) + "; give a .mrk.json of 3D Slicer");
  }
  return *found;
}

// mm where none is named; Slicer 5 writes its code, the system of codes and its name
std::string unitOf(const Json& list)
{
  const auto found = list.find("coordinateUnits");
  if (found == list.end())
  {
    return "mm";
  }
  const Json& unit = found->is_array() && !found->empty() ? found->front() : *found;
  return unit.is_string() ? unit.get<std::string>() : unit.dump();
}

void addPoints(Fiducials& points, const Json& list, const std::string& where)
{
  const Eigen::Vector3d signs = signsOf(textAt(list, "coordinateSystem"), where);
  if (const std::string unit = unitOf(list); unit != "mm")
  {
    refuseFiducials(where, "the unit is " + inQuotes(unit) + "; save the list in mm");
  }
  std::size_t index = 0;
  for (const Json& point : listAt(list, "controlPoints", where))
  {
    const std::string status = point.is_object() ? textAt(point, "positionStatus") : "";
    const std::string here = where + "/controlPoints/" + std::to_string(index++);
    if (!status.empty() && status != "defined")
    {
      ++points.unplaced;
      continue;
    }
    const Json& position = listAt(point, "position", here);
    if (position.size() != 3 ||
      !std::ranges::all_of(position, [](const Json& number) { return number.is_number(); }))
    {
      refuseFiducials(here + "/position", "must be three numbers, in mm");
    }
    PressPlace& place = points.places.emplace_back(PressPlace{ .name = textAt(point, "label") });
    for (int i = 0; i < 3; ++i)
    {
      place.position[i] =
        signs[i] * units::fromMillimeters(position[static_cast<std::size_t>(i)].get<double>());
    }
  }
}

Fiducials readMarkups(const std::string& text, const std::string& name)
{
  const Json document = parseJson(text, name);
  Fiducials points;
  int count = 0;
  for (const Json& list : listAt(document, "markups", name))
  {
    const std::string where = name + ": /markups/" + std::to_string(count++);
    if (!list.is_object())
    {
      refuseFiducials(where, "must be an object, { ... }");
    }
    addPoints(points, list, where);
  }
  return points;
}

} // namespace

Fiducials readFiducials(const std::filesystem::path& file)
{
  const std::string name = file.string();
  const bool isJson = name.ends_with(".json");
  if (!isJson && !name.ends_with(".fcsv"))
  {
    refuseFiducials(name, "not a list of points; give .fcsv or .mrk.json of 3D Slicer");
  }
  const std::string text = readText(file, "a list of points");
  Fiducials points =
    isJson ? readMarkups(text, file.filename().string()) : Fiducials{ FcsvReader(name).read(text) };
  if (points.places.empty())
  {
    refuseFiducials(name,
      points.unplaced == 0 ? "no point; give a list with at least one"
                           : "none of its points is placed; place one in 3D Slicer and save again");
  }
  constexpr double kFarthest = 10.0; // [m], as of --at
  for (const PressPlace& place : points.places)
  {
    if (!(place.position.cwiseAbs().maxCoeff() <= kFarthest))
    {
      refuseFiducials(name,
        "the point " + inQuotes(place.name) + " is farther than 10 m from the origin; give mm");
    }
  }
  return points;
}

} // namespace palp
