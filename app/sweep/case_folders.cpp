#include "app/sweep/case_folders.h"

#include "haptics/error.h"

namespace palp
{

bool CaseFolders::isDone(const std::string& name) const
{
  std::error_code why;
  const auto file = std::filesystem::status(result(name) / kCaseFile, why);
  if (file.type() == std::filesystem::file_type::none) // is unknown, not missing
  {
    refuseUnread(results(), why);
  }
  return std::filesystem::is_regular_file(file);
}

void refuseUnread(const std::filesystem::path& place, const std::error_code& why)
{
  throw Error(ErrorCode::BadFile,
    place.string() + ": cannot be read (" + why.message() + "); ask whom it belongs to");
}

} // namespace palp
