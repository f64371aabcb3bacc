#include "app/data_files.h"

#include "haptics/error.h"

#include <cstdlib>

namespace palp
{

std::filesystem::path dataFile(const std::filesystem::path& name)
{
  const char* chosen = std::getenv("PALP_DATA"); // NOLINT(concurrency-mt-unsafe): nobody sets it
  const std::filesystem::path directory = chosen
    ? std::filesystem::path(chosen)
    : std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/palp";
  std::filesystem::path file = directory / name;
  if (!std::filesystem::exists(file))
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": not found; build or install the data, or name its folder in PALP_DATA");
  }
  return file;
}

} // namespace palp
