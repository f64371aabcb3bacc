#include "haptics/files/output_folder.h"

#include "haptics/error.h"
#include "haptics/files/replace_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace palp
{
namespace
{

namespace fs = std::filesystem;

Descriptor openFolder(const fs::path& folder)
{
  return Descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

bool isSame(const struct stat& a, const struct stat& b)
{
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool isThere(const fs::path& file)
{
  std::error_code unknown;
  return fs::exists(fs::symlink_status(file, unknown));
}

bool isFolder(const fs::path& file)
{
  std::error_code unknown;
  return fs::is_directory(fs::symlink_status(file, unknown));
}

std::vector<std::string> namesIn(const fs::path& folder)
{
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
  {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

// in a stage that is complete: the names of files that go without another in their place
constexpr const char* kDropped = ".dropped";

// @return  0, or the reason
int renameAll(const fs::path& stage, const fs::path& folder)
{
  for (const std::string& name : namesIn(stage))
  {
    if (name != kDropped && rename((stage / name).c_str(), (folder / name).c_str()) != 0)
    {
      return errno;
    }
  }
  return 0;
}

// a complete stage of this user, whose run was killed while it put its files into the folder
void finishStage(const fs::path& stage, const fs::path& folder)
{
  struct stat is = {};
  std::ifstream dropped(stage / kDropped);
  if (!dropped || lstat(stage.c_str(), &is) != 0 || !S_ISDIR(is.st_mode) || is.st_uid != geteuid())
  {
    return;
  }
  for (std::string name; std::getline(dropped, name);)
  {
    unlink((folder / fs::path(name).filename()).c_str()); // nowhere else
  }
  (void)renameAll(stage, folder);
}

// what killed runs left in a folder; only who holds the lock may ask
void clearHidden(const fs::path& folder, const std::string& start)
{
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
  {
    if (isHidden(entry.path().filename().string(), start))
    {
      finishStage(entry.path(), folder);
      fs::remove_all(entry.path(), ignored);
    }
  }
}

std::vector<fs::path> missingFolders(const fs::path& folder)
{
  std::vector<fs::path> missing;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !isThere(at); at = at.parent_path())
  {
    missing.push_back(at);
  }
  return missing;
}

// anew where another run exchanged or removed the folder in between
Descriptor lockFolder(const fs::path& folder)
{
  for (;;)
  {
    std::error_code failed;
    fs::create_directories(folder, failed);
    Descriptor lock = openFolder(folder);
    if (!lock)
    {
      refuseFile(folder, failed ? failed.value() : errno);
    }
    // a file system without locks goes without
    if (flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    {
      throw Error(ErrorCode::BadFile,
        folder.string() +
          ": another palp is writing there; wait until it is done, or choose another folder");
    }
    struct stat mine = {};
    struct stat now = {};
    if (fstat(lock.get(), &mine) == 0 && stat(folder.c_str(), &now) == 0 && isSame(mine, now))
    {
      return lock;
    }
  }
}

// whether a new folder can stand for this one: nothing else in it, nothing special about it
bool isPlain(const fs::path& folder, const fs::path& stage, const std::vector<std::string>& gone)
{
  struct stat is = {};
  struct stat fresh = {};
  struct stat here = {};
  return stat(folder.c_str(), &is) == 0 && stat(stage.c_str(), &fresh) == 0 &&
    is.st_uid == fresh.st_uid && is.st_gid == fresh.st_gid &&
    !(stat(".", &here) == 0 && isSame(is, here)) &&
    getxattr(folder.c_str(), "system.posix_acl_access", nullptr, 0) <= 0 &&
    getxattr(folder.c_str(), "system.posix_acl_default", nullptr, 0) <= 0 &&
    namesIn(folder).size() == gone.size() + 1 && chmod(stage.c_str(), is.st_mode & 07777U) == 0;
}

// empties the folder that was exchanged, but for what somebody has just put there
void clear(const fs::path& old, const fs::path& folder, const std::vector<std::string>& gone)
{
  for (const std::string& name : gone)
  {
    unlink((old / name).c_str());
  }
  for (const std::string& name : namesIn(old))
  {
    renameat2(AT_FDCWD, (old / name).c_str(), AT_FDCWD, (folder / name).c_str(), RENAME_NOREPLACE);
  }
  rmdir(old.c_str());
}

} // namespace

OutputFolder::OutputFolder(fs::path folder, std::vector<std::string> own, Earlier earlier)
  : shown_(std::move(folder))
  , own_(std::move(own))
  , earlier_(earlier)
  , made_(missingFolders(shown_))
{
  std::ranges::sort(own_);
  lock_ = lockFolder(shown_);
  folder_ = fs::canonical(shown_);
  clearAbandoned(folder_);
  clearHidden(folder_, hiddenStart());
  clearHidden(folder_.parent_path(), hiddenStart(folder_.filename()));
  for (const std::string& name : own_)
  {
    if (isFolder(folder_ / name))
    {
      refuseFile(shown_ / name, EISDIR);
    }
    if (isThere(folder_ / name))
    {
      found_.append(found_.empty() ? "" : ", ").append(name);
    }
  }
  try
  {
    if (earlier_ == Earlier::Refuse && !found_.empty())
    {
      throw Error(ErrorCode::BadFile,
        shown_.string() + ": holds " + found_ +
          " of an earlier run; pass --overwrite to replace that, or choose another folder");
    }
    (void)stage(); // tells before any work whether anything may be written
  }
  catch (...)
  {
    discard();
    throw;
  }
}

OutputFolder::~OutputFolder()
{
  discard();
}

fs::path OutputFolder::stage()
{
  const std::lock_guard guard(mutex_);
  if (stage_.empty())
  {
    stage_ = makeHidden(folder_);
    if (stage_.empty())
    {
      refuseFile(shown_, errno);
    }
  }
  return stage_;
}

void OutputFolder::publish()
{
  const std::lock_guard guard(mutex_);
  const std::vector<std::string> staged =
    stage_.empty() ? std::vector<std::string>{} : namesIn(stage_);
  std::vector<std::string> gone;
  std::ranges::set_union(own_, staged, std::back_inserter(gone));
  std::erase_if(gone, [&](const std::string& name) { return !isThere(folder_ / name); });
  for (const std::string& name : gone)
  {
    if (earlier_ == Earlier::Refuse || isFolder(folder_ / name))
    {
      refuseFile(shown_ / name, EEXIST);
    }
  }
  for (const std::string& name : staged)
  {
    if (const int failed = syncToDisk(stage_ / name))
    {
      refuseFile(shown_ / name, failed);
    }
  }
  if (earlier_ == Earlier::Keep || !exchange(gone))
  {
    renameInto(earlier_ == Earlier::Keep ? std::vector<std::string>{} : gone);
  }
  std::error_code ignored;
  fs::remove_all(stage_, ignored);
  stage_.clear();
  made_.clear();
  earlier_ = Earlier::Keep;
}

bool OutputFolder::exchange(const std::vector<std::string>& gone)
{
  if (!isPlain(folder_, stage_, gone))
  {
    return false;
  }
  syncToDisk(stage_);
  const std::string random = stage_.filename().string().substr(hiddenStart().size());
  const fs::path sibling = folder_.parent_path() / (hiddenStart(folder_.filename()) + random);
  if (rename(stage_.c_str(), sibling.c_str()) != 0)
  {
    return false;
  }
  Descriptor lock = openFolder(sibling);
  if (!lock || (flock(lock.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) ||
    renameat2(AT_FDCWD, sibling.c_str(), AT_FDCWD, folder_.c_str(), RENAME_EXCHANGE) != 0)
  {
    rename(sibling.c_str(), stage_.c_str());
    return false;
  }
  syncToDisk(folder_.parent_path());
  lock_ = std::move(lock); // that of the earlier folder ends
  clear(sibling, folder_, gone);
  return true;
}

// old files go before the first new one comes, so that no two runs are seen together
void OutputFolder::renameInto(const std::vector<std::string>& gone) const
{
  std::string dropped;
  for (const std::string& name : gone)
  {
    dropped += isThere(stage_ / name) ? "" : name + '\n';
  }
  replaceFile(stage_ / kDropped, dropped); // from here on the next run would finish this
  for (const std::string& name : gone)
  {
    unlink((folder_ / name).c_str());
  }
  if (const int failed = renameAll(stage_, folder_))
  {
    refuseFile(shown_, failed);
  }
  syncToDisk(folder_);
}

void OutputFolder::discard() noexcept
{
  const std::lock_guard guard(mutex_);
  std::error_code ignored;
  if (!stage_.empty())
  {
    fs::remove_all(stage_, ignored);
    stage_.clear();
  }
  for (const fs::path& folder : made_)
  {
    rmdir(folder.c_str());
  }
}

} // namespace palp
