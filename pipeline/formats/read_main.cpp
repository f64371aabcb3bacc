// palp-read FILE [series=PLACE] [name=VALUE:NAME...] [level=VALUE | label=VALUE-OR-NAME...]: reads
// a surface for the program that started it. Readers of other people's files may crash or run away,
// and here they do it alone.
#include "pipeline/formats/read_limits.h"
#include "pipeline/formats/surface_formats.h"
#include "pipeline/process/child_process.h"

#include <SMP/Common/vtkSMPToolsAPI.h> // vtkSMPTools.h itself is no C++20
#include <cstdlib>
#include <string_view>

int main(int argc, char** argv)
{
  // the limit of time counts all threads, and one reads as fast
  vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
  const std::filesystem::path file = argc > 1 ? argv[1] : "";
  palp::ImagePart part;
  for (int i = 2; i < argc; ++i)
  {
    const std::string_view word = argv[i];
    const std::string_view value = word.substr(std::min(word.find('=') + 1, word.size()));
    if (word.starts_with("level="))
    {
      part.level = std::strtod(value.data(), nullptr);
    }
    else if (word.starts_with("name="))
    {
      const std::size_t colon = std::min(value.find(':'), value.size() - 1);
      part.names.push_back(
        { std::strtod(value.data(), nullptr), std::string(value.substr(colon + 1)) });
    }
    else if (word.starts_with("series="))
    {
      part.series = value;
    }
    else
    {
      part.labels.emplace_back(value);
    }
  }
  palp::answer([&] { return pack(palp::readFile(file, part)); }, palp::readLimits(file),
    palp::neededFiles(file));
}
