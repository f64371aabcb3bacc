#include "app/input/scene_plan.h"

#include "app/input/quantity.h"
#include "haptics/error.h"

#include <algorithm>
#include <charconv>

namespace palp
{

const std::vector<std::string> kCurveNames{ "force-time", "force-depth", "section", "comparison",
  "extent" };

bool isScripted(const std::string& device)
{
  return device.starts_with("path:") || device.starts_with("replay:");
}

std::filesystem::path scriptFile(const std::string& device)
{
  return device.substr(device.find(':') + 1);
}

ScriptedPath readScript(const std::string& device)
{
  return readPath(scriptFile(device));
}

std::vector<MeshSource> meshesOf(const PressOptions& options)
{
  if (options.file.empty())
  {
    return { { .bundled = "liver" } };
  }
  if (!std::filesystem::exists(options.file))
  {
    throw Error(
      ErrorCode::BadFile, options.file.string() + ": there is no such file; check the path");
  }
  return { { .file = options.file, .part = options.part(), .unit = options.unit } };
}

ImageSize parseSize(const std::string& text, const std::string& what)
{
  ImageSize size;
  const char* end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size.width);
  const bool apart = first == std::errc{} && cross != end && *cross == 'x';
  const auto [rest, second] =
    apart ? std::from_chars(cross + 1, end, size.height) : std::from_chars_result{};
  constexpr int kSmallest = 64;
  constexpr int kLargest = 8192;
  if (!apart || second != std::errc{} || rest != end ||
    std::min(size.width, size.height) < kSmallest || std::max(size.width, size.height) > kLargest)
  {
    throw Error(ErrorCode::BadValue,
      what + ": '" + text + "' is no size; write WIDTHxHEIGHT, each 64 to 8192, like 1280x960");
  }
  return size;
}

} // namespace palp
