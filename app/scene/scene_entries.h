#pragma once

#include "app/input/json_object.h"
#include "app/input/option_values.h"
#include "app/input/organ_plan.h"
#include "app/input/quantity.h"

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

// What reader and writer of scenes share.

namespace palp
{

extern const Words kOverlays;                                  ///< Overlay
extern const Words kExports;                                   ///< of a scene without window
constexpr Bounds kSceneReach{ -10.0, 10.0, "-10m to 10m" };    ///< as far as a path [m]
constexpr Bounds kCameraReach{ -1e3, 1e3, "-1000m to 1000m" }; ///< [m]

/// A color as in #8c3328, and its text.
/// @throws Error  BadValue
[[nodiscard]] OrganColor parseColor(const std::string& text);
[[nodiscard]] std::string colorText(const OrganColor& color);

/// Runs a check and tells the message of an option, "--young: what", of a place in the document
/// instead; a place that ends in a slash goes on with the option's name.
/// @throws Error  BadFile
void checkAt(const JsonObject& object, std::string path, const std::function<void()>& check);

/// Passes what stands under a key, if anything does, through the parser of its option.
void parseAt(JsonObject& object, const char* key,
  const std::function<void(const std::string&)>& parse,
  std::string (JsonObject::*read)(const char*, const std::string&) = &JsonObject::text);

/// Three quantities along or about x, y and z; zero where there are none [SI].
[[nodiscard]] Eigen::Vector3d triple(
  JsonObject& object, const char* key, Quantity quantity, const Bounds& bounds);

/// One word for a value of an enumeration.
template <typename Enum>
void readChoice(JsonObject& object, const char* key, const Words& words, Enum& value)
{
  if (object.has(key))
  {
    value = static_cast<Enum>(object.choice(key, object.text(key, ""), words));
  }
}

/// Words of a list as what they stand for.
template <typename Kind>
[[nodiscard]] std::vector<Kind> kinds(JsonObject& object, const char* key, const Words& words)
{
  std::vector<Kind> list;
  for (const std::string& word : object.texts(key, {}))
  {
    list.push_back(static_cast<Kind>(object.choice(key, word, words)));
  }
  return list;
}

} // namespace palp
