#include "app/program/data_files.h"

#include "haptics/error.h"
#include "haptics/files/listed.h"
#include "haptics/files/prefix.h"

#include <cstdlib>
#include <set>
#include <string>
#include <system_error>

namespace palp
{
namespace
{

// of the files of the same kind, in order
std::string namesBeside(const std::filesystem::path& file)
{
  std::set<std::string> names;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path(), failure))
  {
    if (entry.path().extension() == file.extension() &&
      entry.path().stem().extension() != ".schema")
    {
      names.insert(entry.path().stem().string());
    }
  }
  return listed(names);
}

} // namespace

std::filesystem::path dataFile(const std::filesystem::path& name)
{
  const char* chosen = std::getenv("PALP_DATA"); // NOLINT(concurrency-mt-unsafe): nobody sets it
  const std::filesystem::path directory =
    chosen ? std::filesystem::path(chosen) : prefix() / "share/palp";
  std::filesystem::path file = directory / name;
  if (!std::filesystem::exists(file))
  {
    const std::string others = namesBeside(file);
    throw Error(ErrorCode::BadFile,
      file.string() + ": not found; " +
        (others.empty() ? "build or install the data, or name its folder in PALP_DATA"
                        : "there are " + others));
  }
  return file;
}

} // namespace palp
