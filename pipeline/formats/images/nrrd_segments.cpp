#include "pipeline/formats/images/nrrd_segments.h"

#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "pipeline/formats/meshes/refuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace palp
{
namespace
{

// of red, green and blue from 0 to 1; empty: no such
std::string colorOf(const std::vector<double>& parts)
{
  if (parts.size() != 3 ||
    !std::ranges::all_of(parts, [](double part) { return part >= 0.0 && part <= 1.0; }))
  {
    return {};
  }
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x",
    static_cast<unsigned>(std::lround(255.0 * parts[0])),
    static_cast<unsigned>(std::lround(255.0 * parts[1])),
    static_cast<unsigned>(std::lround(255.0 * parts[2])));
  return text.data();
}

Segment segmentOf(const std::filesystem::path& file, const NrrdFields& fields, int i, int layers)
{
  const std::string key = "Segment" + std::to_string(i) + "_";
  Segment segment{ .name = fieldOf(fields, key + "Name"),
    .color = colorOf(numbersIn(fieldOf(fields, key + "Color"))) };
  const auto number = [&](const char* field, double otherwise)
  {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return fields.contains(key + field) ? numberOf(fieldOf(fields, key + field), kNone) : otherwise;
  };
  const auto wrong = [&](const char* field, const std::string& which)
  {
    refuse(file,
      "its segment " + inQuotes(segment.name) + " has the " + field + " " +
        inQuotes(fieldOf(fields, key + field)) + ", " + which + "; export it again");
  };
  segment.value = number("LabelValue", 1.0);
  std::isfinite(segment.value) ? void() : wrong("LabelValue", "which is no number");
  const double layer = number("Layer", layers > 1 ? i : 0.0);
  const bool isThere = layer >= 0.0 && layer < layers && layer == std::trunc(layer);
  isThere ? void() : wrong("Layer", "none of " + std::to_string(layers) + " counted from 0");
  segment.layer = static_cast<int>(layer);
  return segment;
}

} // namespace

std::vector<Segment> nrrdSegments(
  const std::filesystem::path& file, const NrrdFields& fields, int layers)
{
  std::vector<Segment> segments;
  for (int i = 0; fields.contains("Segment" + std::to_string(i) + "_Name"); ++i)
  {
    Segment segment = segmentOf(file, fields, i, layers);
    const auto isSame = [&](const Segment& other)
    { return other.layer == segment.layer && other.value == segment.value; };
    if (std::ranges::any_of(segments, isSame))
    {
      refuse(file,
        "two of its segments have the value " + shortest(segment.value) +
          " in one layer; export it again");
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

} // namespace palp
