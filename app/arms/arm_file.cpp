#include "app/arms/arm_file.h"

#include "app/input/json_object.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/replace_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace palp
{
namespace
{

using Json = nlohmann::json;

constexpr std::array kAxes{ "x", "y", "z" };

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what)
{
  throw Error(ErrorCode::BadFile,
    file.string() + ": " + what + "; measure the arm again with palp devices --identify");
}

struct Range
{
  double low;
  double high;
};

Json jsonIn(const std::filesystem::path& file)
{
  try
  {
    return parseJson(readText(file.string(), "the arm"), file.string());
  }
  catch (const Error& error)
  {
    throw Error(error.code(),
      error.what() +
        std::string("; measure the arm again with palp devices --identify, which "
                    "tells it in JSON"));
  }
}

double number(
  const std::filesystem::path& file, const Json& from, const char* key, const Range& range)
{
  const auto found = from.find(key);
  if (found == from.end() || !found->is_number())
  {
    refuse(file, std::string(key) + " is missing or no number");
  }
  const auto value = found->get<double>();
  if (!(value >= range.low && value <= range.high))
  {
    refuse(file, std::string(key) + " is beyond what an arm can have");
  }
  return value;
}

} // namespace

std::filesystem::path armFile(const std::string& identity)
{
  const char* config = std::getenv("XDG_CONFIG_HOME"); // NOLINT(concurrency-mt-unsafe): none is set
  const char* home = std::getenv("HOME");              // NOLINT(concurrency-mt-unsafe)
  const std::filesystem::path root = config != nullptr && *config == '/'
    ? std::filesystem::path(config)
    : std::filesystem::path(home != nullptr ? home : "/") / ".config";
  std::string name = identity;
  std::ranges::replace_if(
    name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-'; }, '-');
  return root / "palp/arms" / (name + ".json");
}

void saveArm(const std::filesystem::path& file, const IdentifiedArm& arm)
{
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < arm.axes.size(); ++i)
  {
    json["axes"].push_back({ { "axis", kAxes[i] }, { "mass_kg", arm.axes[i].mass },
      { "damping_N_s_per_m", arm.axes[i].damping }, { "friction_N", arm.axes[i].friction },
      { "agreement", arm.axes[i].agreement } });
  }
  json["delay_s"] = arm.delay;
  json["encoder_step_m"] = arm.encoderStep;
  json["scale"] = arm.scale;
  std::error_code ignored; // writing tells
  std::filesystem::create_directories(file.parent_path(), ignored);
  replaceFile(file, json.dump(2) + '\n');
}

std::optional<IdentifiedArm> loadArm(const std::filesystem::path& file)
{
  if (std::error_code none; !std::filesystem::exists(file, none))
  {
    return std::nullopt;
  }
  const Json json = jsonIn(file);
  if (!json.is_object() || !json.contains("axes") || !json["axes"].is_array() ||
    json["axes"].size() != kAxes.size())
  {
    refuse(file, "not three axes of an arm in JSON");
  }
  IdentifiedArm arm;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
  {
    const Json& axis = json["axes"][i];
    if (!axis.is_object() || axis.value("axis", Json()) != kAxes[i])
    {
      refuse(file, "its axes are not x, y and z");
    }
    arm.axes[i] = { .mass = number(file, axis, "mass_kg", { 0.0, 20.0 }),
      .damping = number(file, axis, "damping_N_s_per_m", { 0.0, 100.0 }),
      .friction = number(file, axis, "friction_N", { 0.0, 20.0 }),
      .agreement = number(file, axis, "agreement", { -1.0, 1.0 }) };
  }
  arm.delay = number(file, json, "delay_s", { 0.0, 0.1 });
  arm.encoderStep = number(file, json, "encoder_step_m", { 1e-9, 0.01 });
  arm.scale = number(file, json, "scale", { 0.05, 20.0 });
  for (const ArmAxis& axis : arm.axes)
  {
    if (arm.agrees() && axis.mass < IdentifiedArm::kLeastMass)
    {
      refuse(file, "mass_kg is beyond what an arm can have");
    }
  }
  return arm;
}

} // namespace palp
