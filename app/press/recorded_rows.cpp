#include "app/press/recorded_rows.h"

#include "app/press/sample_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/servo/servo_step.h"
#include "haptics/threads/followed_work.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

namespace palp
{
namespace
{

constexpr std::array kColumns{ "time_s", "tool_x_mm", "tool_y_mm", "tool_z_mm", "axis_x", "axis_y",
  "axis_z", "force_x_N", "force_y_N", "force_z_N", "flags" };

// whatever a double may be, also none; nothing else
double numberOf(std::string_view text)
{
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
  {
    throw Error(ErrorCode::BadValue, inQuotes(text) + " is not a number; write it as -1.25");
  }
  return value;
}

// the value that a conversion shows as this one, to the last bit
template <typename Shown>
double valueOf(double shown, double nearly, Shown show)
{
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double value :
    { nearly, std::nextafter(nearly, -kInfinite), std::nextafter(nearly, kInfinite) })
  {
    if (show(value) == shown)
    {
      return value;
    }
  }
  return nearly;
}

double fromShownMillimeters(double shown)
{
  return valueOf(shown, units::fromMillimeters(shown), units::toMillimeters);
}

// what of a sample only its past tells
constexpr std::array kRemembered{ "force_N", "contact_radius_mm", "stiffness_N_per_mm",
  "friction_x_N", "friction_y_N", "friction_z_N", "surface_depth_mm" };

class RowReader
{
public:
  explicit RowReader(Recording& recording)
    : recording_(recording)
  {
  }

  void read(const std::string& line)
  {
    if (line.starts_with('#'))
    {
      readComment(line);
    }
    else if (columns_.empty())
    {
      readHeader(line);
    }
    else if (!line.empty())
    {
      readRow(split(line, ','));
    }
  }

  void end()
  {
    if (recording_.samples.empty())
    {
      throw Error(ErrorCode::BadValue, "no row; give a samples.csv that Palp has exported");
    }
    const auto isOld = [this](const Sample& sample) { return sample.time < thinnedUntil_; };
    const auto old = std::ranges::count_if(recording_.samples, isOld);
    const bool all = recording_.samples.back().time == thinnedUntil_;
    recording_.thinned = all ? recording_.samples.size() : static_cast<std::size_t>(old);
    if (recording_.second)
    {
      recording_.second->interval = recording_.interval;
      recording_.second->thinned =
        static_cast<std::size_t>(std::ranges::count_if(recording_.second->samples, isOld));
    }
  }

private:
  void readComment(const std::string& line)
  {
    recording_.contactOnly = recording_.contactOnly || line == kContactOnly;
    if (line.starts_with(kSecondDevice))
    {
      recording_.second.emplace().device = line.substr(kSecondDevice.size());
    }
    if (line.starts_with(kThinned))
    {
      const std::string_view rest = std::string_view(line).substr(kThinned.size());
      const std::size_t middle = std::min(rest.find(kThinnedTo), rest.size());
      thinnedUntil_ = numberOf(rest.substr(0, middle));
      const std::string_view interval =
        rest.substr(std::min(middle + kThinnedTo.size(), rest.size()));
      recording_.interval = numberOf(interval.substr(0, interval.find(' ')));
    }
  }

  void readHeader(const std::string& line)
  {
    const std::vector<std::string_view> names = split(line, ',');
    const auto placeOf = [&](std::string_view column) // beyond the last: not there
    { return static_cast<std::size_t>(std::ranges::find(names, column) - names.begin()); };
    for (const char* column : kColumns)
    {
      columns_.push_back(placeOf(column));
      if (columns_.back() == names.size())
      {
        throw Error(ErrorCode::BadValue,
          std::string("no column ") + column + "; give a samples.csv that Palp has exported");
      }
    }
    std::ranges::transform(kRemembered, std::back_inserter(remembered_), placeOf);
    organ_ = placeOf("organ");
    if (organ_ == names.size() && !recording_.organs.empty())
    {
      throw Error(ErrorCode::BadValue,
        "no column organ, though the scene has several; give a samples.csv of this scene");
    }
    hand_ = placeOf("hand");
    width_ = names.size();
  }

  // the samples of the hand that a row tells of
  [[nodiscard]] std::vector<Sample>& samplesOf(const std::vector<std::string_view>& cells)
  {
    if (hand_ == width_ || cells[hand_] == "1")
    {
      return recording_.samples;
    }
    if (cells[hand_] != "2")
    {
      throw Error(ErrorCode::BadValue, inQuotes(cells[hand_]) + " is no hand; give 1 or 2");
    }
    recording_.second ? void() : void(recording_.second.emplace());
    return recording_.second->samples;
  }

  // that which the row tells of; the last one where none is touched
  [[nodiscard]] int organOfRow(std::string_view name, const std::vector<Sample>& before) const
  {
    for (int i = 0; !name.empty() && i < organCount(recording_.scene); ++i)
    {
      if (recording_.organName(i) == name)
      {
        return i;
      }
    }
    if (!name.empty())
    {
      throw Error(ErrorCode::BadValue,
        inQuotes(name) + " is no organ that the scene feels; give a samples.csv of this scene");
    }
    return before.empty() ? 0 : before.back().organ;
  }

  void readRow(const std::vector<std::string_view>& cells)
  {
    if (cells.size() != width_)
    {
      throw Error(ErrorCode::BadValue,
        "a row of " + std::to_string(cells.size()) + " columns below a header of " +
          std::to_string(width_));
    }
    const auto cell = [&](std::size_t column) { return cells[columns_[column]]; };
    const auto triple = [&](std::size_t first)
    {
      return Eigen::Vector3d(
        numberOf(cell(first)), numberOf(cell(first + 1)), numberOf(cell(first + 2)));
    };
    ToolPose pose;
    for (int i = 0; i < 3; ++i)
    {
      pose.apex[i] = fromExactMillimeters(cell(static_cast<std::size_t>(i) + 1));
    }
    pose.axis = triple(4);
    const double flags = numberOf(cell(10));
    if (!(flags >= 0.0 && flags <= std::numeric_limits<std::uint32_t>::max()))
    {
      throw Error(
        ErrorCode::BadValue, "the flags are " + std::string(cell(10)) + "; give 0 or more");
    }
    std::vector<Sample>& samples = samplesOf(cells);
    const int organ = recording_.organs.empty() ? 0 : organOfRow(cells[organ_], samples);
    Sample& sample = samples.emplace_back();
    sample = evaluateContact(organOf(recording_.scene, organ), pose);
    sample.organ = organ;
    sample.time = numberOf(cell(0));
    sample.force = triple(7);
    sample.flags = static_cast<std::uint32_t>(flags);
    if (organOf(recording_.scene, organ).law.rows() != nullptr &&
      std::ranges::max(remembered_) < width_)
    {
      remember(sample, cells);
    }
  }

  // tissue that relaxes or rubs answers by what was done to it before
  void remember(Sample& sample, const std::vector<std::string_view>& cells) const
  {
    const auto number = [&](std::size_t column) { return numberOf(cells[remembered_[column]]); };
    const double elastic = sample.response.force;
    const double stiffness = number(2);
    sample.response = { .force = number(0),
      .contactRadius = fromShownMillimeters(number(1)),
      .stiffness = valueOf(
        stiffness, 1e3 * stiffness, [](double k) { return units::toNewtonsPerMillimeter(k); }) };
    sample.lateral *= elastic > 0.0 ? sample.response.force / elastic : 0.0;
    sample.friction = { number(3), number(4), number(5) };
    sample.surfaceDepth = fromShownMillimeters(number(6));
  }

  Recording& recording_;
  std::vector<std::size_t> columns_;    // in the order of kColumns
  std::vector<std::size_t> remembered_; // of kRemembered; beyond the width: not there
  std::size_t organ_ = 0;               // its column
  std::size_t hand_ = 0;                // likewise; width_: none
  std::size_t width_ = 0;
  double thinnedUntil_ = -std::numeric_limits<double>::infinity(); // [s]
};

} // namespace

void readRows(Recording& recording, const std::filesystem::path& file)
{
  recording.samples.clear();
  recording.second.reset();
  const std::string text = readText(file, "a samples.csv");
  std::istringstream lines(text);
  RowReader reader(recording);
  constexpr int kTold = 1000; // rows, about 20 ms
  int number = 0;
  try
  {
    for (std::string line; std::getline(lines, line);)
    {
      if (++number % kTold == 0)
      {
        tellDone(static_cast<double>(lines.tellg()) / static_cast<double>(text.size()));
      }
      line.erase(line.find_last_not_of('\r') + 1);
      reader.read(line);
    }
    reader.end();
  }
  catch (const Error& error)
  {
    throw Error(
      ErrorCode::BadFile, file.string() + ":" + std::to_string(number) + ": " + error.what());
  }
}

} // namespace palp
