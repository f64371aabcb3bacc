// palp-read FILE [LEVEL]: reads a surface for the program that started it. Readers of other
// people's files may crash or run away, and here they do it alone.
#include "pipeline/child_process.h"
#include "pipeline/surface_formats.h"

#include <SMP/Common/vtkSMPToolsAPI.h> // vtkSMPTools.h itself is no C++20
#include <cstdlib>
#include <system_error>

int main(int argc, char** argv)
{
  // the limit of time counts all threads, and one reads as fast
  vtk::detail::smp::vtkSMPToolsAPI::GetInstance().SetBackend("Sequential");
  const std::filesystem::path file = argc > 1 ? argv[1] : "";
  std::optional<double> level;
  if (argc > 2)
  {
    level = std::strtod(argv[2], nullptr);
  }
  std::error_code missing; // which readFile says
  const std::uintmax_t size = std::filesystem::file_size(file, missing);
  // several times what the slowest reader takes for an honest file
  const palp::ChildLimits limits = missing
    ? palp::ChildLimits{ .memory = 4ULL << 30, .time = 10 }
    : palp::ChildLimits{ .memory = (4ULL << 30) + 64 * size, .time = 10 + (size >> 20) };
  palp::answer([&] { return pack(palp::readFile(file, level)); }, limits);
}
