#include "app/sweep/cases/input_watch.h"

#include "app/input/mesh_file.h"
#include "haptics/error.h"

#include <sys/stat.h>

namespace palp
{

InputWatch::InputWatch(const std::map<std::string, std::string>& hashes)
  : hashes_(hashes)
{
}

InputWatch::Stamp InputWatch::stampOf(const std::string& file)
{
  struct stat is = {};
  (void)stat(file.c_str(), &is); // what is missing is like nothing that was there
  return { is.st_dev, is.st_ino, is.st_size, is.st_mtim.tv_sec, is.st_mtim.tv_nsec,
    is.st_ctim.tv_sec, is.st_ctim.tv_nsec };
}

void InputWatch::check(const std::string& file)
{
  const Stamp now = stampOf(file);
  if (const auto seen = seen_.find(file); seen != seen_.end() && seen->second == now)
  {
    return;
  }
  const auto planned = hashes_.find(file);
  if (planned == hashes_.end() || describeFile(file).sha256 != planned->second)
  {
    throw Error(ErrorCode::BadFile,
      file + ": was edited after planning; plan again, which keeps what is finished");
  }
  seen_[file] = now;
}

bool InputWatch::isTouched(const std::string& file) const
{
  return stampOf(file) != seen_.at(file);
}

} // namespace palp
