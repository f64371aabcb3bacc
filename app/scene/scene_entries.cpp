#include "app/scene/scene_entries.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "pipeline/model/overlay.h"

#include <charconv>

namespace palp
{

const Words kOverlays{ "force-arrow", "contact-circle", "extent-circle", "displacement-colors",
  "readings", "pressure-colors", "validity-colors", "control-net", "ghost",
  "iso-lines" }; // in the order of Overlay
static_assert(kOverlayCount == 10);
const Words kExports{ "samples", "deformed", "picture", "refined", "all-samples" };

OrganColor parseColor(const std::string& text)
{
  OrganColor color{};
  bool isColor = text.size() == 7 && text.front() == '#';
  for (std::size_t i = 0; isColor && i < color.size(); ++i)
  {
    const char* digits = &text[1 + 2 * i];
    isColor = std::from_chars(digits, digits + 2, color[i], 16).ptr == digits + 2;
  }
  if (!isColor)
  {
    throw Error(ErrorCode::BadValue,
      "--color: " + inQuotes(text) + " is no color; write red, green and blue as in #8c3328");
  }
  return color;
}

std::string colorText(const OrganColor& color)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t part : color)
  {
    text += { kDigits[part / 16U], kDigits[part % 16U] };
  }
  return text;
}

void checkAt(const JsonObject& object, std::string path, const std::function<void()>& check)
{
  try
  {
    check();
  }
  catch (const Error& error)
  {
    const std::string message = error.what();
    const std::size_t end = message.starts_with("--") ? message.find(": ") : 0;
    if (path.ends_with('/'))
    {
      path = end > 0 ? path + message.substr(2, end - 2) : path.substr(0, path.size() - 1);
      for (std::size_t dashes = path.find("--"); dashes != path.npos; dashes = path.find("--"))
      {
        path.erase(dashes, 2); // of each where several are refused at once
      }
    }
    object.refuse(path, message.substr(end > 0 ? end + 2 : 0));
  }
}

void parseAt(JsonObject& object, const char* key,
  const std::function<void(const std::string&)>& parse,
  std::string (JsonObject::*read)(const char*, const std::string&))
{
  if (object.has(key))
  {
    const std::string text = (object.*read)(key, "");
    checkAt(object, key, [&] { parse(text); });
  }
}

Eigen::Vector3d triple(JsonObject& object, const char* key, Quantity quantity, const Bounds& bounds)
{
  const std::vector<std::string> words = object.texts(key, {});
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  if (words.empty())
  {
    return value;
  }
  if (words.size() != 3)
  {
    object.refuse(key, "must be three quantities, along or about x, y and z");
  }
  checkAt(object, key,
    [&]
    {
      for (int i = 0; i < 3; ++i)
      {
        value[i] = parseWithin(words[static_cast<std::size_t>(i)], quantity, bounds, "--entry");
      }
    });
  return value;
}

} // namespace palp
