#include "haptics/devices/haply/haply_message.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <optional>

namespace palp
{
namespace
{

using nlohmann::json;

const json kNothing;
const char* const kCentered = "arm_front_centered"; // a preset

const json& at(const json& object, const char* key)
{
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() ? *found : kNothing;
}

std::optional<double> number(const json& object, const char* key)
{
  const json& value = at(object, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::optional<Eigen::Vector3d> vector(const json& object)
{
  const auto x = number(object, "x");
  const auto y = number(object, "y");
  const auto z = number(object, "z");
  constexpr double kFarthest = 1.0; // that an arm on a table reaches [m]
  const Eigen::Vector3d place(x.value_or(0.0), y.value_or(0.0), z.value_or(0.0));
  return x && y && z && place.allFinite() && place.norm() <= kFarthest ? std::optional(place)
                                                                       : std::nullopt;
}

std::optional<Eigen::Quaterniond> quaternion(const json& object)
{
  const auto w = number(object, "w");
  const auto x = number(object, "x");
  const auto y = number(object, "y");
  const auto z = number(object, "z");
  const Eigen::Quaterniond turn(w.value_or(0.0), x.value_or(0.0), y.value_or(0.0), z.value_or(0.0));
  constexpr double kUnit = 0.05; // by which it may miss it
  return w && x && y && z && std::abs(turn.norm() - 1.0) < kUnit ? std::optional(turn.normalized())
                                                                 : std::nullopt;
}

const json* armOf(const json& message, const HaplyState& state)
{
  const json& arms = at(message, "inverse3");
  for (const json& arm : arms) // of what is no array, itself or nothing
  {
    const json& id = at(arm, "device_id");
    const std::string_view known(state.id.data());
    if (id.is_string() && id.get_ref<const std::string&>().size() < state.id.size() &&
      (known.empty() || known == id.get_ref<const std::string&>()))
    {
      return &arm;
    }
  }
  return nullptr;
}

void takeGrip(const json& grips, HaplyState& state)
{
  if (!grips.is_array() || grips.empty())
  {
    return;
  }
  const json& grip = at(grips.front(), "state");
  const auto held = quaternion(at(grip, "orientation"));
  state.orientation = held.value_or(state.orientation);
  state.hasGrip = state.hasGrip || held;
  const auto bit = [](const json& pressed, unsigned place)
  { return pressed.is_boolean() && pressed.get<bool>() ? 1U << place : 0U; };
  const json& wireless = at(grip, "buttons");
  state.buttons = bit(at(grip, "button"), 0) | bit(at(wireless, "a"), 0) |
    bit(at(wireless, "b"), 1) | bit(at(wireless, "c"), 2);
}

} // namespace

bool takeHaplyMessage(std::string_view text, HaplyState& state)
{
  const json message = json::parse(text, nullptr, false);
  const json* arm = armOf(message, state);
  if (arm == nullptr)
  {
    return false;
  }
  const auto position = vector(at(at(*arm, "state"), "cursor_position"));
  if (!position)
  {
    return false;
  }
  if (state.id.front() == 0) // the first of all messages says who speaks
  {
    at(*arm, "device_id").get_ref<const std::string&>().copy(state.id.data(), state.id.size() - 1);
    state.oldWords = at(message, "session_id").is_null();
  }
  state.position = *position;
  const json& config = at(*arm, "config");
  state.centered = config.is_object() ? at(config, "preset") == kCentered : state.centered;
  state.reach = at(config, "type") == "minverse" ? 0.04 : state.reach;
  const json& status = at(*arm, "status");
  if (at(status, "calibrated").is_boolean())
  {
    state.calibrated =
      status["calibrated"].get<bool>() && at(status, "power_supply") != json(false);
  }
  takeGrip(at(message, "verse_grip"), state);
  takeGrip(at(message, "wireless_verse_grip"), state);
  return true;
}

std::string haplyCommand(const HaplyState& arm, const Eigen::Vector3d& force, bool first)
{
  const json vector{ { "x", force.x() }, { "y", force.y() }, { "z", force.z() } };
  const json command{ { arm.oldWords ? "values" : "vector", vector } };
  json message{ { "inverse3",
    json::array({ { { "device_id", arm.id.data() },
      { "commands", { { "set_cursor_force", command } } } } }) } };
  if (first && !arm.oldWords)
  {
    message["session"] = { { "configure", { { "profile", { { "name", "palp" } } } } } };
    message["inverse3"][0]["configure"] = { { "preset", kCentered } };
  }
  return message.dump();
}

ZeroPacket haplyZero(const HaplyState& arm)
{
  constexpr std::size_t kShort = 125; // of a length in one byte
  constexpr std::byte kText{ 0x81 };
  constexpr std::byte kMasked{ 0x80 };
  constexpr std::size_t kKey = 4; // bytes of it
  const std::string text = haplyCommand(arm, Eigen::Vector3d::Zero(), false);
  const bool isShort = text.size() <= kShort;
  ZeroPacket zero;
  zero.bytes[0] = kText;
  zero.bytes[1] = kMasked | static_cast<std::byte>(isShort ? text.size() : kShort + 1);
  if (!isShort)
  {
    zero.bytes[2] = static_cast<std::byte>(text.size() >> 8U);
    zero.bytes[3] = static_cast<std::byte>(text.size());
  }
  const std::size_t front = (isShort ? 2 : 4) + kKey;
  const std::size_t size = std::min(text.size(), ZeroPacket::kLargest - front);
  std::memcpy(&zero.bytes[front], text.data(), size);
  zero.size = front + size;
  return zero;
}

} // namespace palp
