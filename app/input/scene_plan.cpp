#include "app/input/scene_plan.h"

#include "app/input/quantity.h"
#include "haptics/error.h"

#include <algorithm>
#include <charconv>

namespace palp
{

const std::vector<std::string> kPlotNames{ "force-time", "force-depth", "section", "comparison",
  "extent" };
const std::vector<std::string> kMovieNames{ "replay", "turntable" };
const std::vector<std::string> kOrganRoles{ "press", "through", "show", "hide" };
const std::vector<std::string> kPlotEndings{ "png", "svg", "pdf", "csv" };

DeviceChoice parseDevice(const std::string& name)
{
  using enum DeviceChoice::Kind;
  const bool script = name.starts_with("path:") || name.starts_with("replay:");
  return { .kind = name == "mouse" ? Mouse
      : name == "hand"             ? Hand
      : script                     ? Script
                                   : Driver,
    .name = name,
    .file = script ? name.substr(name.find(':') + 1) : "" };
}

void checkHands(const DeviceChoice& first, const DeviceChoice& second)
{
  if (second.kind == DeviceChoice::Kind::Mouse || second.kind == DeviceChoice::Kind::Hand)
  {
    throw Error(ErrorCode::BadValue,
      "--device: '" + second.name +
        "' follows the pointer, which leads the first hand; give it first, or another device");
  }
  if (second.kind == DeviceChoice::Kind::Driver && second.name == first.name)
  {
    throw Error(ErrorCode::BadValue,
      "--device: two hands cannot share '" + second.name + "'; name another device");
  }
}

void checkExists(const MeshSource& mesh)
{
  if (mesh.bundled.empty() && !std::filesystem::exists(mesh.file))
  {
    throw Error(ErrorCode::BadFile, mesh.file.string() + ": there is no such file; check the path");
  }
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
