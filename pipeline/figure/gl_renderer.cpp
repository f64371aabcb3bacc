#include "pipeline/figure/gl_renderer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vtkRenderWindow.h>

namespace palp
{

std::string rendererNameOf(vtkRenderWindow& window)
{
  constexpr std::string_view kMark = "renderer string:";
  const char* told = window.ReportCapabilities();
  const std::string_view text = told != nullptr ? told : "";
  const std::size_t mark = text.find(kMark);
  if (mark == text.npos)
  {
    return {};
  }
  std::string_view name = text.substr(mark + kMark.size());
  name = name.substr(0, name.find('\n'));
  name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
  return std::string(name);
}

bool drawsInSoftware(std::string_view renderer)
{
  constexpr std::array<std::string_view, 11> kPrograms{ "llvmpipe", "softpipe", "swrast",
    "lavapipe", "swr (", "swiftshader", "software", "basic render", "gdi generic", "offscreen",
    "mesa x11" };
  std::string name(renderer);
  std::ranges::transform(
    name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.empty() ||
    std::ranges::any_of(
      kPrograms, [&name](std::string_view program) { return name.find(program) != name.npos; });
}

} // namespace palp
